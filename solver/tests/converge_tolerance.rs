//! The tolerance holds: deepest wear, scar width and every place of the profile, its steep edges included, lie within it
//! of the solution at a tolerance of 0.25 %. In partial slip the profile meets it in area only: the walls beside the
//! stick zone are so steep that a sideways shift by a fraction of an element is a large error in depth.
//!
//! Four scenes: the scar of a short stroke (McColl), the groove of a long one (fuzz button), a stroke longer than the
//! contact at first and shorter in the end (a sprung contact on a pad), and partial slip (the cylinder at 120 N/mm
//! and +-3 um, where two thirds of the contact stick).

use crate::verification::recorder::{area_between, largest_distance, solve};
use crate::verification::scenes::{groove, partial_slip, scar, sprung_contact};
use solver::record::{DepthProfile, SideReport};
use solver::scene::Scene;

const TOLERANCES: [f64; 3] = [0.1, 0.02, 0.005];
const REFERENCE: f64 = 0.0025;

/// Wear of each side that wears.
fn worn(scene: &Scene, tolerance: f64) -> Vec<(&'static str, SideReport, DepthProfile)> {
    let mut scene = scene.clone();
    scene.accuracy.tolerance = tolerance;
    let (summary, recorder) = solve(&scene).expect("the scene can be solved");
    let last = &recorder.snapshots[recorder.snapshots.len() - 1];
    [
        (
            "receptacle",
            summary.last.receptacle,
            last.receptacle.clone(),
        ),
        ("slider", summary.last.slider, last.slider.clone()),
    ]
    .into_iter()
    .filter(|(_, report, _)| report.max_depth_mm > 0.0)
    .collect()
}

/// Asserts that depth, width and a distance of the profiles of each side lie within the tolerances.
fn assert_tolerances_hold(
    name: &str,
    scene: &Scene,
    distance: fn(&DepthProfile, &DepthProfile) -> f64,
) {
    let references = worn(scene, REFERENCE);
    let mut all_met = true;
    for tolerance in TOLERANCES {
        for ((side, found, profile), (_, exact, converged)) in
            worn(scene, tolerance).iter().zip(&references)
        {
            let depth = found.max_depth_mm / exact.max_depth_mm - 1.0;
            let width = found.scar_half_width_mm / exact.scar_half_width_mm - 1.0;
            let largest = largest_distance(profile, converged);
            let area = area_between(profile, converged);
            println!(
                "{name} at {tolerance}, {side}: depth off by {depth:+.1e}, scar width by {width:+.1e}, profile by \
                 {largest:.1e} at most, {area:.1e} in area"
            );
            let errors = [depth.abs(), width.abs(), distance(profile, converged)];
            all_met &= errors.iter().all(|error| *error < tolerance);
        }
    }
    assert!(all_met, "{name}");
}

#[test]
fn tolerances_hold_for_the_scar_of_a_short_stroke() {
    assert_tolerances_hold("scar", &scar(), largest_distance);
}

#[test]
fn tolerances_hold_for_the_groove_of_a_long_stroke() {
    assert_tolerances_hold("groove", &groove(), largest_distance);
}

#[test]
fn tolerances_hold_for_a_contact_that_outgrows_its_stroke() {
    assert_tolerances_hold("sprung contact", &sprung_contact(), largest_distance);
}

#[test]
fn tolerances_hold_in_partial_slip() {
    assert_tolerances_hold("partial slip", &partial_slip(), area_between);
}
