//! A coefficient of friction that changes, in point contacts.
//!
//! * Points and layers of one coefficient are the constant law, to the bit.
//! * The energy of gross slip is the integral of mu(N) F over the path.
//! * Between two coefficients a contact wears and dissipates between the runs of either.
//! * Partial slip grows to gross slip as the coefficient falls.

use solver::effects;
use solver::record::{CycleReport, Position, Snapshot, Summary};
use solver::scene::{Accuracy, Effect, Layer, Scene, Table};
use solver::sides::Side;

use super::{HIGH, LOW, bits, by_cycle, by_dose, by_layer, constant, with};
use crate::verification::recorder::{Recorder, solve};
use crate::verification::verify_friction_in_jumps::beside_two_runs;
use crate::verification::verify_line_runs::{FORCE, GOLD};
use crate::verification::verify_point_runs::ball;
use crate::verification::verify_resume::resumes_to_the_same_bits;

/// A ball of which both sides wear, with a layer over a base that wears as fast.
pub(super) fn plated(amplitude_mm: f64, cycles: u64, tolerance: f64) -> Scene {
    let mut scene = ball(4.0 * GOLD, 4.0 * GOLD, amplitude_mm, cycles);
    let layer = Layer {
        thickness_mm: 0.03e-3,
        rate_per_mpa: 4.0 * GOLD,
    };
    (scene.slider.plating, scene.receptacle.plating) = (vec![layer], vec![layer]);
    scene.accuracy = Accuracy::from_tolerance(tolerance);
    scene
}

/// Gross and partial slip.
fn contacts(cycles: u64) -> [(&'static str, Scene); 2] {
    let sticking = plated(2e-4, cycles, 0.1);
    assert!(effects::plan(&sticking).simulates(Effect::StickMemory));
    [("gross", plated(0.02, cycles, 0.1)), ("partial", sticking)]
}

fn solved(scene: &Scene) -> (Summary, Recorder) {
    solve(scene).expect("the scene can be solved")
}

fn energy(report: &CycleReport) -> f64 {
    report.extent.expect("a point").dissipated_energy_mj
}

fn real(cycles: u64) -> f64 {
    f64::from(u32::try_from(cycles).expect("few cycles"))
}

#[test]
fn equal_points_of_a_ball_are_the_constant_law_to_the_bit() {
    for (name, mut scene) in contacts(200) {
        // Jumps that do not change are implicit where they can be.
        scene.accuracy.tuning.implicit_jumps = true;
        let expected = bits(&with(&scene, constant(0.4)));
        let laws = [
            by_cycle(&[(0.0, 0.4), (7.0, 0.4), (1e4, 0.4)]),
            by_dose(&[(0.0, 0.4), (1.0, 0.4), (1e6, 0.4)]),
            by_layer(&[0.4; 2], &[0.4; 2]),
            by_layer(&[], &[0.4; 2]),
        ];
        for law in laws {
            let found = bits(&with(&scene, law.clone()));
            assert!(found == expected, "{name}: other bits with {law:?}");
        }
    }
}

/// A dead load: the work is F 4 A N, whatever the shape.
#[test]
fn energy_of_a_ball_is_the_integral_of_the_coefficient_over_the_path() {
    let points = [(0.0, 0.1), (60.0, 0.5), (160.0, 0.2)];
    let table = Table::new(&points);
    let mut scene = plated(0.05, 200, 0.05);
    let (summary, run) = solved(&with(&scene, by_cycle(&points)));
    let mut worst = 0.0_f64;
    for report in run.reports.iter().filter(|report| report.jump > 0) {
        let cycle = real(report.cycle);
        let exact = table.mean(0.0, cycle) * FORCE * 4.0 * 0.05 * cycle;
        worst = worst.max((energy(report) / exact - 1.0).abs());
        let mean = table.mean(cycle - real(report.jump), cycle);
        assert!((report.friction_coefficient / mean - 1.0).abs() < 1e-12);
    }
    println!("ball, friction by cycle: energy {worst:.1e} off the integral over the path");
    assert!(worst < 1e-10, "{worst}");
    assert!(summary.checks.friction_use < 1.0 + 1e-12);
    // Friction does not change what wears in gross slip, but bounds jumps.
    scene.accuracy.tuning.implicit_jumps = false;
    let (even, _) = solved(&with(&scene, constant(0.3)));
    let depth = |summary: &Summary| summary.last.slider.max_depth_mm;
    let off = depth(&summary) / depth(&even) - 1.0;
    let computed = [&summary, &even].map(|summary| summary.resolution.computed_cycles);
    println!("ball, friction by cycle: depth {off:.1e} off in {computed:?} computed cycles");
    assert!(
        off.abs() < 0.02 && computed[0] > computed[1],
        "{off} {computed:?}"
    );
}

/// The loop of the last cycle has the force of its coefficient: F mu, on a spring that keeps its load.
#[test]
fn the_loop_of_a_ball_has_the_force_of_its_cycle() {
    let points = [(0.0, LOW), (100.0, LOW), (101.0, HIGH)];
    let mut scene = with(&plated(0.02, 200, 0.1), by_cycle(&points));
    scene.output.snapshots_at_cycles = vec![50, 100, 200];
    let (_, run) = solved(&scene);
    let forces = run.snapshots.iter().filter(|snapshot| snapshot.cycle > 0);
    let forces: Vec<f64> = forces.map(largest_force).collect();
    for (force, mu) in forces.iter().zip([LOW, LOW, HIGH]) {
        assert!((force / (mu * FORCE) - 1.0).abs() < 1e-9, "{forces:?}");
    }
}

fn largest_force(snapshot: &Snapshot) -> f64 {
    let forces = snapshot.friction_loop.tangential_force_n.iter();
    forces.fold(0.0, |most: f64, force| most.max(force.abs()))
}

/// Single cycles in gross slip: each cell of the middle section is on the cone of the coefficient of the depth before.
#[test]
fn every_cell_of_a_ball_is_on_the_cone_of_its_own_coefficient() {
    let mut scene = plated(0.02, 60, 0.1);
    let thickness = 4e-6;
    scene.slider.plating.clear();
    scene.slider.wear = None;
    scene.receptacle.plating[0].thickness_mm = thickness;
    scene.accuracy.cycle_jump = Some(1);
    scene.output.snapshots_at_cycles = (1..=scene.cycles).collect();
    let dose = thickness / (4.0 * GOLD);
    let film = |depth: f64| LOW + (HIGH - LOW) * (depth / thickness).min(1.0);
    let layer = |depth: f64| if depth >= thickness { HIGH } else { LOW };
    let laws: [(_, &dyn Fn(f64) -> f64); 2] = [
        (by_layer(&[], &[LOW, HIGH]), &layer),
        (by_dose(&[(0.0, LOW), (dose, HIGH)]), &film),
    ];
    for (law, at) in laws {
        let (_, run) = solved(&with(&scene, law));
        let (mut worst, mut mixed) = (0.0_f64, 0);
        for pair in run.snapshots.windows(2).filter(|pair| pair[0].cycle > 0) {
            let field = &pair[1].positions[1];
            assert_eq!(field.position, Position::Rightmost);
            let (before, peak) = (
                &pair[0].area.as_ref().expect("a map").depth.receptacle,
                field,
            );
            let peak = peak.pressure_mpa.iter().fold(0.0, |m: f64, p| m.max(*p));
            let row = |x: f64| before.x_mm.iter().position(|own| (own - x).abs() < 1e-9);
            let width = before.z_mm.len();
            let mut touched = Vec::new();
            for (i, pressure) in field.pressure_mpa.iter().enumerate() {
                let Some(row) = row(field.x_mm[i]) else {
                    continue;
                };
                let mu = at(before.depth_mm[row * width + width / 2]);
                worst = worst.max((field.shear_mpa[i].abs() - mu * pressure).abs() / peak);
                if *pressure > 0.0 {
                    touched.push(mu);
                }
            }
            assert!(touched.len() > 4);
            mixed += usize::from(touched.iter().any(|mu| (mu - touched[0]).abs() > 1e-3));
        }
        println!(
            "cone of each cell: off by {worst:.1e} of the peak, {mixed} contacts of more than one coefficient"
        );
        assert!(worst < 1e-9, "{worst}");
        assert!(mixed > 3, "{mixed}");
    }
}

/// Depth, energy and peak between those of the constants that the coefficient changes between.
#[test]
fn a_coefficient_between_two_others_is_bracketed_by_their_runs() {
    let mut scene = plated(2e-4, 2_000, 0.05);
    for plating in [&mut scene.slider.plating, &mut scene.receptacle.plating] {
        plating[0].thickness_mm = 1e-6;
    }
    let of = |law| {
        let last = solved(&with(&scene, law)).0.last;
        let volume = last.receptacle.worn_volume_mm3.expect("a volume");
        [volume, energy(&last)]
    };
    let (low, high) = (of(constant(0.3)), of(constant(0.6)));
    let dose = 200.0;
    for law in [
        by_cycle(&[(0.0, 0.3), (2_000.0, 0.6)]),
        by_cycle(&[(0.0, 0.6), (2_000.0, 0.3)]),
        by_dose(&[(0.0, 0.3), (dose, 0.6)]),
        by_layer(&[0.3, 0.6], &[0.3, 0.6]),
    ] {
        let found = of(law.clone());
        println!("ball in partial slip: volume and energy {found:?} between {low:?} and {high:?}");
        for (found, (low, high)) in found.iter().zip(low.iter().zip(&high)) {
            let (least, most) = (low.min(*high), low.max(*high));
            assert!(
                least < *found && *found < most,
                "{law:?}: {least} {found} {most}"
            );
        }
    }
}

/// Nothing sticks below the coefficient at which the amplitude is the onset of gross slip; the force is then that of the cone.
#[test]
fn partial_slip_grows_to_gross_slip_as_the_coefficient_falls() {
    let mut scene = ball(GOLD, GOLD, 2e-4, 400);
    scene.accuracy = Accuracy::from_tolerance(0.05);
    let table = [(0.0, 0.6), (100.0, 0.6), (300.0, 0.02)];
    let mut friction = Vec::new();
    scene.output.snapshots_at_cycles = (1..=8).map(|i| 50 * i).collect();
    let (summary, run) = solved(&with(&scene, by_cycle(&table)));
    for snapshot in run.snapshots.iter().filter(|snapshot| snapshot.cycle > 0) {
        let mu = run.at(snapshot.cycle).friction_coefficient;
        let turned = &snapshot.positions[1];
        let cells = turned.pressure_mpa.iter().zip(&turned.shear_mpa);
        let loaded = cells.clone().filter(|(p, _)| **p > 0.0).count();
        let sticking = cells
            .filter(|(p, q)| **p > 0.0 && q.abs() < 0.9 * mu * **p)
            .count();
        friction.push((
            snapshot.cycle,
            sticking,
            loaded,
            largest_force(snapshot) / (mu * FORCE),
        ));
    }
    println!("falling friction: cycle, sticking and loaded cells, force over mu F {friction:.3?}");
    let (first, last) = (friction[0], friction[friction.len() - 1]);
    assert!(first.1 > 0 && first.3 < 0.9, "{first:?}");
    assert!(last.1 == 0 && (last.3 - 1.0).abs() < 0.01, "{last:?}");
    assert!(
        friction.windows(2).all(|pair| pair[1].1 <= pair[0].1),
        "{friction:?}"
    );
    assert!(summary.checks.worn_area < 1e-10, "{:?}", summary.checks);
    // The mean coefficient of the last cycle is that of the end of the table.
    assert!((summary.last.friction_coefficient - 0.02).abs() < 1e-15);
}

#[test]
fn a_step_by_cycle_of_a_ball_is_two_runs() {
    for (name, mut scene) in contacts(600) {
        scene.accuracy = Accuracy::from_tolerance(0.02);
        let off = beside_two_runs(scene, 300, [0.4, 0.6]);
        println!(
            "step of friction by cycle, {name} slip of a ball: depth, area, energy off by {off:?}"
        );
        assert!(off.iter().all(|off| off.abs() < 0.02), "{name}: {off:?}");
    }
}

#[test]
fn balls_with_changing_friction_resume_to_the_same_bits_and_state_their_errors() {
    let layers = [LOW, HIGH];
    let laws = [
        by_cycle(&[(5.0, LOW), (150.0, HIGH)]),
        by_dose(&[(0.0, LOW), (2_000.0, HIGH)]),
        by_layer(&layers, &layers),
    ];
    for (name, mut scene) in contacts(200) {
        for law in &laws {
            resumes_to_the_same_bits(name, &with(&scene, law.clone()), 2);
        }
        scene.accuracy.estimate_errors = true;
        let (summary, _) = solved(&with(&scene, laws[0].clone()));
        let errors = summary.errors.expect("errors are estimated");
        assert!(errors.worn_depth.relative > 0.0, "{errors:?}");
        assert!(summary.last.side(Side::Slider).max_depth_mm > 0.0);
    }
}

/// No friction at first, and none in the end.
#[test]
fn a_coefficient_of_a_ball_may_begin_or_end_at_nothing() {
    for (name, scene) in contacts(60) {
        for law in [
            by_cycle(&[(0.0, 0.0), (60.0, 0.6)]),
            by_cycle(&[(0.0, 0.6), (30.0, 0.0)]),
        ] {
            let (summary, _) = solved(&with(&scene, law));
            assert!(energy(&summary.last) > 0.0, "{name}");
            assert!(summary.checks.friction_use < 1.0 + 1e-12, "{name}");
        }
    }
}

mod long {
    use super::*;

    /// A layer of the base's rate, and a film that lasts the dose of its thickness; and either beside runs of single cycles.
    #[test]
    #[ignore = "long: takes a minute"]
    fn a_film_on_a_ball_is_a_layer_that_lasts_as_long() {
        let scene = plated(0.02, 400, 0.02);
        let dose = 0.03e-3 / (4.0 * GOLD);
        let layers = [LOW, HIGH];
        let mut energies = Vec::new();
        for law in [
            by_layer(&layers, &layers),
            by_dose(&[(0.0, LOW), (dose, LOW), (1.000_001 * dose, HIGH)]),
            by_dose(&[(0.0, LOW), (dose, HIGH)]),
        ] {
            let scene = with(&scene, law);
            let mut single = scene.clone();
            single.accuracy.cycle_jump = Some(1);
            let [found, exact] = [&scene, &single].map(|scene| solved(scene).0);
            let (found_mj, exact_mj) = (energy(&found.last), energy(&exact.last));
            let off = found_mj / exact_mj - 1.0;
            let computed = found.resolution.computed_cycles;
            let share = exact_mj / (FORCE * 4.0 * 0.02 * 400.0);
            println!(
                "jumps of a ball: energy {off:.1e} off in {computed} computed cycles, mean coefficient {share:.3}"
            );
            assert!(off.abs() < 0.02 && computed < 200, "{off} {computed}");
            assert!(share > 1.1 * LOW && share < HIGH, "{share}");
            energies.push(found_mj);
        }
        assert!(
            (energies[1] / energies[0] - 1.0).abs() < 2e-3,
            "{energies:?}"
        );
    }
}
