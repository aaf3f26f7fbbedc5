//! A coefficient of friction that changes, along lines, rings and extruded bodies.
//!
//! * Points and layers of one coefficient are the constant law, to the bit.
//! * The energy of gross slip is the integral of mu(N) over the work that slides.
//! * Each node of each section is on the cone of its own coefficient.
//! * Sections that are all alike, under an even top or between held ends, are the plane contact.

use solver::extruded::ExtrudedScene;
use solver::record::{CycleReport, Snapshot, Summary};
use solver::scene::{
    Accuracy, Dimension, Effect, Ends, Extruded, Layer, Line, LineShape, Motion, Scene, Table, Top,
    WearLaw,
};
use solver::sides::Side;
use solver::station::StationScene;

use super::{HIGH, LOW, bits, by_cycle, by_dose, by_layer, constant, with};
use crate::verification::recorder::{Recorder, solve};
use crate::verification::verify_friction_in_jumps::beside_two_runs;
use crate::verification::verify_line_runs::{CROWN, FORCE, GOLD, ring, spring};
use crate::verification::verify_resume::resumes_to_the_same_bits;

const WIDTH: f64 = 0.8;

/// The spring of a memory card with layers that are through after about a hundred cycles of +-5 um, over bases that wear 5 times as fast.
pub(super) fn card(cycles: u64) -> Scene {
    let mut scene = spring(None, (20.0 * GOLD, 20.0 * GOLD), cycles);
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.005,
        period_s: 0.05,
    };
    scene.accuracy = Accuracy::from_tolerance(0.1);
    let layer = Layer {
        thickness_mm: 3e-6,
        rate_per_mpa: 4.0 * GOLD,
    };
    (scene.slider.plating, scene.receptacle.plating) = (vec![layer], vec![layer]);
    scene
}

pub(super) fn as_line(scene: &Scene, crown_radius_mm: Option<f64>, top: Top) -> Scene {
    Scene {
        dimension: Dimension::Line(Line {
            shape: LineShape::Straight {
                width_mm: WIDTH,
                crown_radius_mm,
                tilt_mrad: 0.0,
            },
            top,
            force_n: FORCE,
            stations: None,
        }),
        ..scene.clone()
    }
}

pub(super) fn as_extruded(scene: &Scene, ends: Ends) -> Scene {
    Scene {
        dimension: Dimension::Extruded(Extruded {
            width_mm: WIDTH,
            layers: 2,
            layer_growth: 1.5,
            ends,
        }),
        ..scene.clone()
    }
}

/// A crowned line, a ring and extruded bodies with free ends, in this many cycles, a third of the ring's.
fn contacts(cycles: u64) -> [(&'static str, Scene); 3] {
    let card = card(cycles);
    let mut worn = ring(cycles / 3);
    worn.motion = Motion::Reciprocating {
        amplitude_mm: 0.01,
        period_s: 1.0,
    };
    [
        ("line", as_line(&card, Some(CROWN), Top::Rigid)),
        ("ring", worn),
        ("extruded", as_extruded(&card, Ends::Free)),
    ]
}

fn solved(scene: &Scene) -> (Summary, Recorder) {
    solve(scene).expect("the scene can be solved")
}

fn energy(summary: &Summary) -> f64 {
    summary.last.dissipated_energy_mj_per_mm
}

#[test]
fn equal_points_along_a_line_are_the_constant_law_to_the_bit() {
    for (name, scene) in contacts(60) {
        let expected = bits(&with(&scene, constant(0.4)));
        let layers = |side| [0.4].repeat(scene.plating(side).len() + 1);
        let laws = [
            by_cycle(&[(0.0, 0.4), (7.0, 0.4), (1e4, 0.4)]),
            by_dose(&[(0.0, 0.4), (1.0, 0.4), (1e6, 0.4)]),
            by_layer(&layers(Side::Slider), &layers(Side::Receptacle)),
            by_layer(&[], &layers(Side::Receptacle)),
        ];
        for law in laws {
            let found = bits(&with(&scene, law.clone()));
            assert!(found == expected, "{name}: other bits with {law:?}");
        }
    }
}

/// The work that slides is the energy at a constant coefficient over that coefficient: the volume of bare sides over their rate. Of a table that is
/// linear between its points each jump has the mean of its cycles.
#[test]
fn energy_along_a_line_is_the_integral_of_the_coefficient_over_the_work() {
    let points = [(0.0, 0.1), (60.0, 0.5), (150.0, 0.2)];
    let table = Table::new(&points);
    for (name, mut scene) in contacts(150) {
        (scene.slider.plating, scene.receptacle.plating) = (Vec::new(), Vec::new());
        let (_, run) = solved(&with(&scene, by_cycle(&points)));
        let rate = scene.surface_wear().receptacle.expect("it wears");
        let rate = rate.uniform().expect("one rate");
        let (mut expected, mut before) = (0.0, (0.0, 0.0));
        for report in run.reports.iter().filter(|report| report.jump > 0) {
            let cycle = f64::from(u32::try_from(report.cycle).expect("few cycles"));
            let volume = report.receptacle.worn_volume_mm3.expect("a volume");
            let work = volume / rate;
            expected += table.mean(before.0, cycle) * (work - before.1);
            before = (cycle, work);
        }
        let last = run.reports.last().expect("a report");
        let found = last.extent.expect("a line").dissipated_energy_mj;
        println!(
            "friction by cycle, {name}: energy over that of the worn volume {:.2e}",
            found / expected - 1.0
        );
        assert!((found / expected - 1.0).abs() < 1e-6, "{name}");
        // The column is the mean of the last jump.
        let jump = f64::from(u32::try_from(last.jump).expect("few cycles"));
        let end = f64::from(u32::try_from(last.cycle).expect("few cycles"));
        let mean = table.mean(end - jump, end);
        assert!((last.friction_coefficient / mean - 1.0).abs() < 1e-12);
    }
}

/// Jumps are given, since those of the plane contact are others. An even top gives each section the mean load; held ends are plane strain.
#[test]
fn alike_sections_with_changing_friction_are_the_plane_contact() {
    let mut scene = card(120);
    // The edge of a layer over a softer base amplifies what an iteration leaves.
    let base = Some(WearLaw::Archard {
        k_over_h_per_mpa: 4.0 * GOLD,
    });
    (scene.slider.wear, scene.receptacle.wear) = (base, base);
    scene.accuracy.cycle_jump = Some(3);
    // A line is solved with imposed slip.
    let effects = scene.effects.clone().with(Effect::StickMemory, false);
    scene.effects = effects.with(Effect::Friction, true);
    let plane = Scene {
        dimension: Dimension::PlaneStrain,
        ..scene.clone()
    };
    let layers = [LOW, HIGH];
    for law in [
        by_cycle(&[(0.0, LOW), (80.0, HIGH)]),
        by_dose(&[(0.0, LOW), (2_000.0, HIGH)]),
        by_layer(&layers, &layers),
    ] {
        let (expected, _) = solved(&with(&plane, law.clone()));
        for (name, scene) in [
            ("even line", as_line(&scene, None, Top::Even)),
            ("held ends", as_extruded(&scene, Ends::Held)),
        ] {
            let (found, _) = solved(&with(&scene, law.clone()));
            let of = |report: &CycleReport| {
                [
                    report.receptacle.max_depth_mm,
                    report.slider.max_depth_mm,
                    report.dissipated_energy_mj_per_mm,
                ]
            };
            let coefficient = |summary: &Summary| summary.last.friction_coefficient;
            let of_coefficient = coefficient(&found) / coefficient(&expected) - 1.0;
            let (found, expected) = (of(&found.last), of(&expected.last));
            let off: Vec<f64> = (found.iter().zip(expected))
                .map(|(found, expected)| (found / expected - 1.0).abs())
                .collect();
            println!(
                "{name} beside the plane contact: depths, energy off by {off:?}, coefficient by {of_coefficient:.1e}"
            );
            assert!(off.iter().all(|off| *off < 1e-9), "{name} {law:?}: {off:?}");
            // The plane contact is reported without the skew of its jump.
            assert!(of_coefficient.abs() < 5e-3, "{of_coefficient}");
        }
    }
}

/// Single cycles: coefficients are those of the depths that are reported at the end of the cycle before.
#[test]
fn every_node_along_a_line_is_on_the_cone_of_its_own_coefficient() {
    let thickness = 1e-6;
    // Friction has a part along the line of a ring.
    let contacts = contacts(45).into_iter();
    for (name, mut scene) in contacts.filter(|(name, _)| *name != "ring") {
        scene.slider.plating.clear();
        scene.slider.wear = None;
        scene.receptacle.plating[0].thickness_mm = thickness;
        scene.accuracy.cycle_jump = Some(1);
        scene.output.snapshots_at_cycles = (1..=scene.cycles).collect();
        scene.effects = scene.effects.clone().with(Effect::Friction, true);
        let (summary, run) = solved(&with(&scene, by_layer(&[], &[LOW, HIGH])));
        assert!(summary.checks.friction_use < 1.0 + 1e-12 && summary.checks.friction_cone < 1e-8);
        let (mut worst, mut mixed) = (0.0_f64, 0);
        for pair in run.snapshots.windows(2) {
            for section in 0..pair[0].stations.len() {
                let (off, differs) = off_the_cone(&pair[0], &pair[1], section, thickness);
                worst = worst.max(off);
                mixed += usize::from(differs);
            }
        }
        println!(
            "cone of each node, {name}: off by {worst:.1e} of the peak, {mixed} sections of both coefficients"
        );
        assert!(worst < 1e-10, "{name}: {worst}");
        assert!(mixed > 3, "{name}: {mixed}");
    }
}

/// Largest distance from the cones of a section's nodes over its peak pressure at the neutral position, and `true` if they have both coefficients.
fn off_the_cone(
    before: &Snapshot,
    after: &Snapshot,
    section: usize,
    thickness: f64,
) -> (f64, bool) {
    let (profile, field) = (
        &before.stations[section].receptacle,
        &after.stations[section].positions[0],
    );
    let peak = field
        .pressure_mpa
        .iter()
        .fold(f64::MIN_POSITIVE, |m: f64, p| m.max(*p));
    let first = profile
        .x_mm
        .iter()
        .take_while(|x| **x < field.x_mm[0])
        .count();
    let (mut worst, mut touched) = (0.0_f64, [false; 2]);
    for (i, pressure) in field.pressure_mpa.iter().enumerate() {
        let through = profile.depth_mm[first + i] >= thickness;
        let mu = if through { HIGH } else { LOW };
        worst = worst.max((field.shear_mpa[i].abs() - mu * pressure).abs() / peak);
        touched[usize::from(through)] |= *pressure > 0.0;
    }
    (worst, touched == [true; 2])
}

/// A coefficient that steps from one cycle to the next, beside a run that another one continues.
#[test]
fn a_step_by_cycle_along_a_line_is_two_runs() {
    for (name, scene) in contacts(240) {
        let step = scene.cycles / 2;
        let off = beside_two_runs(scene, step, [0.2, 0.4]);
        println!("step of friction by cycle, {name}: depth, area, energy off by {off:?}");
        assert!(off.iter().all(|off| off.abs() < 0.02), "{name}: {off:?}");
    }
}

#[test]
fn lines_with_changing_friction_resume_to_the_same_bits_and_state_their_errors() {
    let layers = [LOW, HIGH];
    for (name, mut scene) in contacts(120) {
        let law = if name == "ring" {
            by_dose(&[(0.0, LOW), (500.0, HIGH)])
        } else {
            by_layer(&layers, &layers)
        };
        for law in [law, by_cycle(&[(5.0, LOW), (100.0, HIGH)])] {
            resumes_to_the_same_bits(name, &with(&scene, law), 2);
        }
        scene.accuracy.estimate_errors = true;
        let (summary, _) = solved(&with(&scene, by_cycle(&[(5.0, LOW), (100.0, HIGH)])));
        let errors = summary.errors.expect("errors are estimated");
        assert!(
            errors.worn_depth.relative > 0.0 && errors.worn_depth.relative < 0.2,
            "{errors:?}"
        );
    }
}

/// All of a contact along a line slips, whatever the coefficient comes to.
#[test]
fn a_coefficient_under_which_a_line_would_stick_is_refused() {
    let mut scene = card(100);
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 1e-5,
        period_s: 0.05,
    };
    let rising = |to| with(&scene, by_cycle(&[(0.0, 1e-3), (100.0, to)]));
    let line = |to| StationScene::of(&as_line(&rising(to), None, Top::Even)).expect("a line");
    let bodies = |to| ExtrudedScene::of(&as_extruded(&rising(to), Ends::Held)).expect("extruded");
    assert!(line(2e-3).check_all().is_ok() && bodies(2e-3).check_all().is_ok());
    let refused = format!("{:?} {:?}", line(0.9).check_all(), bodies(0.9).check_all());
    assert_eq!(refused.matches("Sticks").count(), 2, "{refused}");
}

/// No friction at first, and none in the end.
#[test]
fn a_coefficient_along_a_line_may_begin_or_end_at_nothing() {
    for (name, scene) in contacts(45) {
        let end = f64::from(u32::try_from(scene.cycles).expect("few cycles"));
        for law in [
            by_cycle(&[(0.0, 0.0), (end, 0.4)]),
            by_cycle(&[(0.0, 0.4), (0.5 * end, 0.0)]),
        ] {
            let (summary, _) = solved(&with(&scene, law));
            assert!(summary.checks.friction_cone < 1e-8, "{name}");
            assert!(energy(&summary) > 0.0, "{name}");
        }
    }
}

mod long;
