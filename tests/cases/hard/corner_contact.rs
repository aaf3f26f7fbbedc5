//! Requirement: a slider that reverses exactly over the block's corner stays in balance, its friction within the
//! cone.
//! Source: the base scene with the amplitude of half the block's length.
//! Naive: the corner's normal is undefined; interpolating it makes the load jump between two directions from one
//! increment to the next.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::{cylinder, fuzz_button};

#[test]
fn reversal_over_the_corner_preserves_the_balance() {
    for share in [0.98, 1.0, 1.02] {
        let amplitude = share * 0.5 * 0.084_67;
        let run = solve(&fuzz_button(
            json!({"motion": {"amplitude_mm": amplitude}, "cycles": 10}),
        ));
        hold(&run);
        assert!(run.depth() > 0.0);
    }
}

/// Without wear the corner stays sharp: its pressure is high, the force is unchanged.
#[test]
fn an_unworn_corner_carries_the_load() {
    let run = solve(&cylinder(json!({
        "system": {"flat_length_mm": 1.0, "flat_height_mm": 1.0},
        "interface": {"wear": {"receptacle": null}},
        "motion": {"amplitude_mm": 0.5},
        "cycles": 1,
    })));
    hold(&run);
    let last = run.snapshots.last().expect("the end is kept");
    let peak = |i: usize| {
        last.positions[i]
            .pressure_mpa
            .iter()
            .fold(0.0, |m: f64, p| m.max(*p))
    };
    let turned = (0..3).find(|&i| last.positions[i].slider_x_mm > 0.49);
    let peak = peak(turned.expect("the turning point is kept"));
    assert!(
        peak > 1.2 * run.summary().initial.peak_pressure_mpa,
        "{peak}"
    );
}
