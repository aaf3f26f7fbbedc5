//! Requirement: a scar whose wall is steeper than atan(1/mu) is solved: without wear in the same
//! solve the slider would jam there.
//! Source: the base scene on a longer block with mu = 1.5, whose walls pass 33.7 degrees; engine.md 2.8.
//! The pressure must be smooth, on such walls at the neutral position. At the turning points its leading edge stands in the
//! corner of wall and floor and alternates there by 0 to 0.5 of its peak, from one coefficient between 1.497 and 1.52 to the
//! next.
//! Naive: without wear in the contact solve P/(cos t - mu sin t) has no solution beyond that slope, and the run ends in
//! a singular matrix.

use serde_json::json;

use super::invariants::{hold_on_steep_walls, steepest_wall};
use super::run::solve;
use super::specs::fuzz_button;

#[test]
fn a_wall_steeper_than_the_friction_angle_is_climbed_and_worn() {
    let mu = 1.5;
    let run = solve(&fuzz_button(json!({
        "system": {"pcb_length_mm": 0.2, "pcb_height_mm": 0.1},
        "interface": {"friction": {"law": "coulomb", "coefficient": mu}},
        "cycles": 800,
    })));
    hold_on_steep_walls(&run, mu);
    // Pressures at the turning points are examined up to there.
    let steepest: Vec<f64> = run.snapshots.iter().map(steepest_wall).collect();
    let held = steepest.iter().filter(|slope| mu * *slope < 1.0);
    assert!(held.count() >= 3, "{steepest:?}");
    let last = steepest.last().expect("the end is kept");
    assert!(*last > 1.0 / mu, "steepest wall {last}");
}
