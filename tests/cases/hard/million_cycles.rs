//! Requirement: a million cycles end in balance, with the worn area of k P s and the scar of the worn segment.
//! Source: gross-slip cylinder at small stroke: b = (3 R A / 2)^(1/3), depth b^2 / (2 R), as elastic terms fade.
//! Naive: a million increments' round-off, and jumps that grow until they skip the scar's growth.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::{AGREEMENT, cylinder};

#[test]
fn a_million_cycles_wear_the_segment_of_their_worn_area() {
    let run = solve(&cylinder(json!({"cycles": 1_000_000})));
    hold(&run);
    let area = run.summary().last.receptacle.worn_area_mm2;
    let b = (1.5 * 6.0 * area).cbrt();
    let depth = b * b / 12.0;
    assert!(
        (run.depth() / depth - 1.0).abs() < AGREEMENT,
        "{} {depth}",
        run.depth()
    );
    assert!(
        run.area_ratio() > 0.95 && run.area_ratio() < 1.02,
        "{}",
        run.area_ratio()
    );
}
