//! Requirement: where the motion reverses exactly at the end of an increment (it always does) the friction force reverses
//! from mu P to -mu P within the elastic displacement, and never exceeds mu P.
//! Source: Cattaneo-Mindlin: after a reversal the contact sticks until the displacement has reversed the shear of stick.
//! Naive: the direction of friction is taken from the velocity, which is zero there; or from the last increment, which
//! gives the first increment after the reversal the old sign.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::cylinder;

#[test]
fn friction_reverses_with_the_motion_at_any_number_of_increments() {
    let limit = 0.9 * 18.5;
    for increments in [4, 8, 20, 100, 400] {
        let run = solve(&cylinder(json!({
            "interface": {"wear": {"receptacle": null}},
            "cycles": 2,
            "accuracy": {"overrides": {"increments_per_cycle": increments}},
        })));
        hold(&run);
        let turned = run.snapshots.last().expect("the end is kept");
        let forces = &turned.friction_loop.tangential_force_n_per_mm;
        let (low, high) = forces
            .iter()
            .fold((0.0, 0.0), |m: (f64, f64), q| (m.0.min(*q), m.1.max(*q)));
        assert!(
            (high / limit - 1.0).abs() < 1e-9 && (low / limit + 1.0).abs() < 1e-9,
            "{increments}: {low} {high}"
        );
    }
}
