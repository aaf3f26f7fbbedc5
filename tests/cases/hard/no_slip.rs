//! Requirement: without slip there is no wear: amplitude 0, and an amplitude far below the elastic displacement of the
//! contact.
//! Source: Cattaneo 1938, Mindlin 1949: slip begins at the edge, its width grows with Q/(mu P).
//! Naive: taking the imposed displacement for the slip (as the thesis does) wears a sticking contact.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::cylinder;

#[test]
fn an_amplitude_of_zero_wears_nothing() {
    let run = solve(&cylinder(
        json!({"motion": {"amplitude_mm": 0}, "cycles": 1000}),
    ));
    hold(&run);
    let last = &run.summary().last;
    assert!(last.cycle == 1000 && run.depth() == 0.0 && last.sliding_distance_mm == 0.0);
    assert!((last.peak_pressure_mpa / run.summary().initial.peak_pressure_mpa - 1.0).abs() < 1e-9);
}

#[test]
fn a_sticking_contact_wears_nothing() {
    let run = solve(&cylinder(
        json!({"motion": {"amplitude_mm": 1e-7}, "cycles": 1000}),
    ));
    hold(&run);
    assert!(run.area_ratio() < 1e-4, "{}", run.area_ratio());
}
