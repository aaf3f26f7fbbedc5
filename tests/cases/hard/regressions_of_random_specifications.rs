//! Requirement: random specifications for which earlier versions found no contact state are solved.
//! Source: `random_specifications`; each is stored as drawn, in `tests/specs/found`.
//! Naive: statuses chosen from the signs of one iterate cycle: a node that opens when stuck closes when
//! free (dissimilar bodies, mu near 1), one whose wear removes the pressure while it slips sticks again (wear on both
//! sides), one at the block's corner does both. Pivoting on the complementarity problem finds a state. Where round-off
//! alone holds a residual above its tolerance, neither more iterations nor smaller increments help: the result is
//! accepted. In a nearly singular system heights of 1e34 mm made every residual look like round-off, and one of 1e20 mm lost the
//! balance with a spring to round-off: a state without contact under the full load.
//!
//! Of other dimensions: sections that lie to one side of where a tilted line touches were counted twice, or placed nowhere; a ring that turns about
//! its axis was coupled although its sections are alike, which round-off took apart; a sprung ball presses more before its cycle than after it;
//! wear through gold to a base that wears nine times as fast did not converge by mean rates, and left cells behind deeper than all others.

use server::spec;

use super::invariants::{across, hold};
use super::run::solve_part;

#[test]
fn specifications_without_a_contact_state_in_earlier_versions_are_solved() {
    for name in [
        "dissimilar_bodies_settle",
        "height_after_a_singular_system",
        "nearly_singular_without_friction",
        "residual_at_round_off",
        "slip_and_wear_on_both_sides",
        "short_block_under_a_worn_slider",
        "soft_slider_is_loaded",
        "soft_slider_leaves_the_block",
        "soft_worn_slider_turns",
        "spring_off_a_short_block",
    ] {
        let path = tests::spec(&format!("found/{name}.json"));
        let bytes = std::fs::read(path).expect("the specification is kept");
        let scene = spec::read(&bytes).expect("it is accepted").scene;
        hold(&solve_part(scene, usize::MAX));
    }
}

#[test]
fn specifications_that_were_unsound_in_other_dimensions_in_earlier_versions_are_solved() {
    for name in [
        "ball_worn_through_slow_gold",
        "line_tilted_to_its_left_end",
        "line_tilted_to_its_right_end",
        "ring_turned_under_pressure",
        "sprung_ball_worn_within_a_cycle",
    ] {
        let path = tests::spec(&format!("found/{name}.json"));
        let bytes = std::fs::read(path).expect("the specification is kept");
        let scene = spec::read(&bytes).expect("it is accepted").scene;
        across::hold(&solve_part(scene, 5));
    }
}
