//! Requirement: the base scene on a fine mesh stays smooth when a computed cycle stands for 1, 10 or 100 cycles.
//! Source: engine.md 2.4: forward Euler needs |ds| < 4 dx / (pi k E*) an increment; copper on copper with 0.1 um
//! elements 0.07 um, which steps of 0.1 um exceed 1.3, 13 and 130 times with jumps of 1, 10 and 100.
//! Naive: wear taken off after each increment turns the pressure into a checkerboard, while the worn area stays exact.

use serde_json::{Value, json};

use super::invariants::{hold, worst_zigzag, zigzag};
use super::naive::explicit_wear;
use super::run::{scene, solve};
use super::specs::fuzz_button;

/// A short stroke, so that fine elements are few.
fn fine(cycles: u64, jump: u64) -> Value {
    fuzz_button(json!({
        "motion": {"amplitude_mm": 0.002},
        "cycles": cycles,
        "accuracy": {"overrides": {"contact_element_mm": 0.0001, "cycle_jump": jump, "increments_per_cycle": 80}},
    }))
}

#[test]
fn implicit_wear_stays_smooth_at_any_jump() {
    for jump in [1, 10, 100] {
        let run = solve(&fine(4 * jump, jump));
        hold(&run);
        let last = run.snapshots.last().expect("the end is kept");
        let zigzag = worst_zigzag(last);
        assert!(zigzag < 0.05, "jump {jump}: {zigzag}");
    }
}

#[test]
fn explicit_wear_turns_into_a_checkerboard() {
    for jump in [10.0, 100.0] {
        // Either the pressure alternates by a large part of its peak, or no contact state is found any more.
        if let Ok(field) = explicit_wear(&scene(&fine(4, 1)), 4, jump, 20) {
            let zigzag = zigzag(&field);
            assert!(zigzag > 0.2, "jump {jump}: {zigzag}");
        }
    }
}
