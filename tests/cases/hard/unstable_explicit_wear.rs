//! Requirement: the base scene on a fine mesh stays smooth when a computed cycle stands for 1, 10 or 100 cycles.
//! Source: engine.md 2.4: forward Euler needs |ds| < 4 dx / (pi k E*) an increment; copper on copper with 0.1 um
//! elements 0.07 um, which steps of 0.1 um exceed 1.3, 13 and 130 times with jumps of 1, 10 and 100.
//! Naive: wear applied after each increment concentrates the pressure on single nodes, while the worn area stays exact.

use serde_json::{Value, json};

use solver::record::TractionField;

use super::invariants::{hold, worst_zigzag};
use super::naive::explicit_wear;
use super::run::{scene, solve};
use super::specs::fuzz_button;

/// A short stroke, so that few fine elements are needed.
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
        // No four neighbours alternate at all.
        assert!(zigzag < 0.01, "jump {jump}: {zigzag}");
    }
}

/// Nodes without pressure between the first and the last one that have some, over all of these.
fn broken(field: &TractionField) -> f64 {
    let pressed = |p: &f64| *p > 0.0;
    let p = &field.pressure_mpa;
    let first = p.iter().position(pressed).expect("there is a contact");
    let last = p.iter().rposition(pressed).expect("there is a contact");
    let inside = &p[first..=last];
    let count = |n: usize| f64::from(u32::try_from(n).expect("some hundred nodes"));
    count(inside.iter().filter(|p| !pressed(p)).count()) / count(inside.len())
}

fn peak(field: &TractionField) -> f64 {
    field.pressure_mpa.iter().fold(0.0, |m, p| m.max(*p))
}

#[test]
fn explicit_wear_concentrates_pressure_on_single_nodes() {
    for jump in [10, 100] {
        let run = solve(&fine(4 * jump, jump));
        let last = run.snapshots.last().expect("the end is kept");
        let implicit = last.positions.iter().map(broken).fold(0.0, f64::max);
        assert!(implicit == 0.0, "jump {jump}: {implicit}");
        // Either single nodes carry the load (0.53 and 0.8 of those between them nothing, at 3 and 130 times the peak), or no
        // contact state is found.
        if let Ok(field) = explicit_wear(&scene(&fine(4, 1)), 4, real(jump), 20) {
            let implicit = last.positions.iter().map(peak).fold(0.0, f64::max);
            let (broken, times) = (broken(&field), peak(&field) / implicit);
            assert!(broken > 0.3 && times > 2.0, "jump {jump}: {broken} {times}");
        }
    }
}

fn real(jump: u64) -> f64 {
    f64::from(u32::try_from(jump).expect("a small count"))
}
