//! The tolerance holds: deepest wear and scar width lie within it of the answer at a tolerance of 0.25 %.
//!
//! Four scenes: the scar of a short stroke (McColl), the groove of a long one (fuzz button), a stroke that leaves the
//! contact behind at first and not in the end (a sprung contact on a pad), and partial slip (the cylinder at 120 N/mm
//! and +-3 um, where two thirds of the contact stick).

use crate::keep::solve;
use crate::scenes::{fuzz_button, mccoll};
use solver::history::SideReport;
use solver::scene::{BlockShape, Friction, Motion, Scene, SliderShape, WearLaw};

const TOLERANCES: [f64; 3] = [0.1, 0.02, 0.005];
const REFERENCE: f64 = 0.0025;

fn worn(scene: &Scene, tolerance: f64) -> SideReport {
    let mut scene = scene.clone();
    scene.accuracy.tolerance = tolerance;
    let (summary, _) = solve(&scene).expect("the scene can be solved");
    summary.last.receptacle
}

fn assert_tolerances_hold(name: &str, scene: &Scene) {
    let reference = worn(scene, REFERENCE);
    for tolerance in TOLERANCES {
        let found = worn(scene, tolerance);
        let depth = found.max_depth_mm / reference.max_depth_mm - 1.0;
        let width = found.scar_half_width_mm / reference.scar_half_width_mm - 1.0;
        println!("{name} at {tolerance}: depth off by {depth:+.1e}, scar width by {width:+.1e}");
        assert!(
            depth.abs() < tolerance && width.abs() < tolerance,
            "{tolerance}: {depth} {width}"
        );
    }
}

fn short(mut scene: Scene, cycles: u64) -> Scene {
    scene.cycles = cycles;
    scene.output.snapshots_at_cycles = Vec::new();
    scene
}

#[test]
fn tolerances_hold_for_the_scar_of_a_short_stroke() {
    assert_tolerances_hold("scar", &short(mccoll(), 1_500));
}

#[test]
fn tolerances_hold_for_the_groove_of_a_long_stroke() {
    assert_tolerances_hold("groove", &short(fuzz_button(), 25));
}

#[test]
fn tolerances_hold_for_a_contact_that_grows_over_its_stroke() {
    let mut scene = short(fuzz_button(), 200);
    scene.slider.shape = SliderShape {
        radius_mm: 0.4,
        half_width_mm: 0.3,
        height_mm: 0.4,
    };
    scene.receptacle.shape = BlockShape {
        length_mm: 2.0,
        height_mm: 0.3,
        crown_radius_mm: None,
    };
    scene.friction = Friction::Coulomb { coefficient: 0.3 };
    scene.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 0.004 / 1700.0,
    });
    scene.load_n_per_mm = 0.625;
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.02,
        period_s: 1.0,
    };
    scene.output.stations_mm = Vec::new();
    assert_tolerances_hold("sprung contact", &scene);
}

#[test]
fn tolerances_hold_in_partial_slip() {
    let mut scene = short(mccoll(), 3_000);
    scene.load_n_per_mm = 120.0;
    scene.friction = Friction::Coulomb { coefficient: 0.8 };
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.003,
        period_s: 1.0,
    };
    assert_tolerances_hold("partial slip", &scene);
}
