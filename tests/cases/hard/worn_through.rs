//! Requirement: wear deeper than half the block's height is solved; wear of all of it ends the run with the outcome
//! `worn_through`, complete histories and positive elements.
//! Source: the base scene, whose constants remove more than the wire's radius in 2000 cycles.
//! Naive: elements invert when their body is consumed, and the run ends in a negative Jacobian.

use serde_json::json;
use solver::record::Outcome;

use super::invariants::hold;
use super::run::solve;
use super::specs::fuzz_button;

/// The stiffness is rebuilt once half of the height is gone, which is reached after 613 cycles.
#[test]
fn a_block_loses_more_than_half_of_its_height() {
    let run = solve(&fuzz_button(
        json!({"system": {"pcb_height_mm": 0.03}, "cycles": 800, "accuracy": {"preset": "standard"}}),
    ));
    hold(&run);
    assert_eq!(run.summary().outcome, Outcome::Completed);
    assert!(run.depth() > 0.5 * 0.03, "{}", run.depth());
    assert!(run.summary().resolution.relocations >= 1);
}

#[test]
fn a_consumed_block_ends_the_run_with_its_histories() {
    let spec = fuzz_button(json!({"system": {"pcb_height_mm": 0.01}, "cycles": 2000}));
    let consumed = solve(&spec);
    hold(&consumed);
    assert_eq!(consumed.summary().outcome, Outcome::WornThrough);
    assert!(consumed.depth() > 0.97 * 0.01 && consumed.depth() <= 0.01);
    assert!(consumed.reports.len() > 10 && consumed.summary().last.cycle < 2000);
}

/// Eight cycles are enough here; the last one stops where the block is worn through.
#[test]
fn a_block_consumed_within_a_few_cycles_is_reported() {
    let run = solve(&fuzz_button(json!({
        "interface": {"wear": {"receptacle": {"law": "archard", "k_over_h_per_mpa": 0.01}}},
        "cycles": 40,
    })));
    hold(&run);
    assert_eq!(run.summary().outcome, Outcome::WornThrough);
    assert!(
        run.summary().last.cycle < 12 && run.depth() <= 0.0635,
        "{}",
        run.depth()
    );
}
