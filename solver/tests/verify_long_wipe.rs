//! A contact that wipes over a hundred times its width: the surface is divided into zones, each with a mesh that is fine
//! along a part of the travel.
//!
//! * Zones and a single mesh give the same depths and pressures, whichever body wears.
//! * Elements for the flat of the first cycles give the wear of those for the unworn contact, in a fraction of the solves.
//! * Where all of the contact slides over a flat floor, each pass wears k P (as in `verify_moving_line_contact`).

use crate::verification::recorder::{Recorder, largest_distance, solve};
use crate::verification::scenes::sprung_contact;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::model::Layout;
use solver::record::{CycleReport, Summary};
use solver::resolution;
use solver::scene::{Accuracy, Motion, Scene, WearLaw};
use solver::sides::Sides;

pub(crate) const RATE: f64 = 0.004 / 1700.0;
const CYCLES: u32 = 10;
/// From a twentieth of 60 cycles on.
const REPORTED: [u64; 5] = [3, 6, 12, 30, 60];

/// The sprung contact's bodies and a wipe over 0.8 mm, 180 times the contact's width, at a tolerance of 10 %.
pub(crate) fn wipe(rates: Sides<f64>) -> Scene {
    let law = |k: f64| {
        Some(WearLaw::Archard {
            k_over_h_per_mpa: k,
        })
        .filter(|_| k > 0.0)
    };
    let mut scene = sprung_contact();
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.4,
        period_s: 1.0,
    };
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.cycles = u64::from(CYCLES);
    scene.receptacle.wear = law(rates.receptacle);
    scene.slider.wear = law(rates.slider);
    scene
}

/// Shortens the wipe to 0.4 mm.
pub(crate) fn shorten(scene: &mut Scene) {
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.2,
        period_s: 1.0,
    };
}

/// Zones that the contact outgrows.
pub(crate) fn in_narrow_zones(scene: &mut Scene) {
    scene.accuracy.tuning.zone_width = 0.5;
    scene.accuracy.tuning.fewest_zone_nodes = 20.0;
}

/// A scene in zones and on a single mesh.
fn both(scene: &Scene) -> [(Summary, Recorder); 2] {
    let mut single = scene.clone();
    single.accuracy.tuning.zone_width = f64::INFINITY;
    let zones = |scene: &Scene| {
        let layout = Layout::of(scene).expect("it can be meshed");
        layout.bodies.map(|body| body.zones.len())
    };
    println!("zones: {:?}", zones(scene));
    assert!(zones(scene).receptacle > 2);
    assert_eq!(
        zones(&single),
        Sides {
            slider: 1,
            receptacle: 1
        }
    );
    [scene, &single].map(|scene| solve(scene).expect("the wipe is solved"))
}

fn zones_agree_with_a_single_mesh() {
    let rates = |slider, receptacle| Sides { slider, receptacle };
    let crowned = {
        let mut scene = wipe(rates(0.0, RATE));
        scene.receptacle.shape.crown_radius_mm = Some(8.0);
        scene
    };
    let scenes = [
        ("receptacle", wipe(rates(0.0, RATE))),
        ("slider", wipe(rates(RATE, 0.0))),
        ("both", wipe(rates(RATE, RATE))),
        ("crown", crowned),
    ];
    for (name, mut scene) in scenes {
        // Differences of the meshes show late.
        scene.cycles = 20;
        let [(zoned, of_zones), (single, of_one)] = both(&scene);
        let last = |run: &Recorder| run.snapshots[run.snapshots.len() - 1].clone();
        let (a, b) = (last(&of_zones), last(&of_one));
        let mut profiles = 0.0_f64;
        for (rate, a, b) in [
            (scene.receptacle.wear, &a.receptacle, &b.receptacle),
            (scene.slider.wear, &a.slider, &b.slider),
        ] {
            if rate.is_some() {
                profiles = profiles.max(largest_distance(a, b));
            }
        }
        let (mut apart, mut peak) = (0.0_f64, 0.0_f64);
        for (a, b) in a.positions.iter().zip(&b.positions) {
            let at = |field: &solver::record::TractionField, x: f64| {
                solver::interpolation::linear(&field.x_mm, &field.pressure_mpa, x)
            };
            for x in &b.x_mm {
                apart = apart.max((at(a, *x) - at(b, *x)).abs());
                peak = peak.max(at(b, *x));
            }
        }
        let energy =
            zoned.last.dissipated_energy_mj_per_mm / single.last.dissipated_energy_mj_per_mm - 1.0;
        println!(
            "wipe, {name} worn: zones and a single mesh differ by {profiles:.1e} of the depth, {:.1e} of the peak pressure, {energy:+.1e} of the energy",
            apart / peak
        );
        assert!(profiles < 1e-3 && apart < 1e-2 * peak && energy.abs() < 1e-4);
    }
}

#[test]
fn a_floor_under_a_long_wipe_wears_by_each_pass() {
    let scene = wipe(Sides {
        slider: 0.0,
        receptacle: RATE,
    });
    let (summary, run) = solve(&scene).expect("the wipe is solved");
    let expected = 2.0 * f64::from(CYCLES) * RATE * scene.load_n_per_mm;
    let profile = run.last_profile();
    let mut worst = 0.0_f64;
    for (x, depth) in profile.x_mm.iter().zip(&profile.depth_mm) {
        if x.abs() < 0.37 {
            worst = worst.max((depth / expected - 1.0).abs());
        }
    }
    println!("floor of a long wipe: off k P a pass by {worst:.1e} at its worst place");
    assert!(worst < 0.03);
    assert!(summary.checks.worn_area < 1e-12);
}

/// A wipe that wears the slider, with elements for the unworn contact and for the flat of the first cycles.
fn worn_sliders() -> [Scene; 2] {
    let mut fine = wipe(Sides {
        slider: 0.1 * RATE,
        receptacle: 0.01 * RATE,
    });
    fine.cycles = 60;
    fine.motion = Motion::Reciprocating {
        amplitude_mm: 0.25,
        period_s: 1.0,
    };
    fine.output.snapshots_at_cycles = REPORTED.to_vec();
    let mut coarse = fine.clone();
    coarse.accuracy.narrowest_contact_mm = resolution::first_flat(&fine);
    [fine, coarse]
}

#[test]
fn a_run_of_the_first_flat_resumes_to_the_same_bits() {
    let [_, coarse] = worn_sliders();
    assert!(coarse.accuracy.narrowest_contact_mm.is_some());
    resumes_to_the_same_bits("first flat", &coarse, 2);
}

/// A slider's flat follows from its worn area alone, so that a run forgets how its first cycles were resolved.
#[test]
fn elements_for_the_first_flat_give_the_wear_of_those_for_the_unworn_contact() {
    let [fine, coarse] = worn_sliders();
    let [(expected, of_fine), (found, of_coarse)] =
        [&fine, &coarse].map(|scene| solve(scene).expect("the wipe is solved"));
    let apart = |value: fn(&CycleReport) -> f64| {
        let of = |at| (value(of_coarse.at(at)) / value(of_fine.at(at)) - 1.0).abs();
        REPORTED.map(of).into_iter().fold(0.0, f64::max)
    };
    let depth = apart(|report| report.slider.max_depth_mm);
    let area = apart(|report| report.slider.worn_area_mm2);
    let energy = apart(|report| report.dissipated_energy_mj_per_mm);
    let unworn = found.initial.peak_pressure_mpa / expected.initial.peak_pressure_mpa - 1.0;
    let elements = found.resolution.contact_element_mm / expected.resolution.contact_element_mm;
    let [of_unworn, of_flat] = [&expected, &found].map(|run| run.resolution.work.unknowns);
    println!(
        "first flat of a long wipe: elements {elements:.1} times as large, {of_flat} unknowns for {of_unworn}; from a twentieth of the cycles on \
         depth {depth:.1e}, area {area:.1e}, energy {energy:.1e} off; unworn pressure {unworn:+.1e}"
    );
    assert!(elements > 2.0 && 2 * of_flat < of_unworn);
    assert!(depth < 0.02 && area < 1e-3 && energy < 1e-3);
    assert!(unworn.abs() < 0.01);
}

/// The estimate of the contact's width may be wrong; zones then become wider, and the run continues from the same cycle.
#[test]
fn a_contact_that_outgrows_its_zones_gets_wider_ones() {
    let mut scene = wipe(Sides {
        slider: RATE,
        receptacle: 0.0,
    });
    shorten(&mut scene);
    let (expected, _) = solve(&scene).expect("the wipe is solved");
    in_narrow_zones(&mut scene);
    let (found, _) = solve(&scene).expect("the wipe is solved");
    println!(
        "zones of half the contact: {} relocations",
        found.resolution.relocations
    );
    assert!(found.resolution.relocations > expected.resolution.relocations);
    let depth = |run: &Summary| run.last.slider.max_depth_mm;
    assert!((depth(&found) / depth(&expected) - 1.0).abs() < 1e-4);
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 45 s"]
    fn zones_agree_with_a_single_mesh() {
        super::zones_agree_with_a_single_mesh();
    }
}
