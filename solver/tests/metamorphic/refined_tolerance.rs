//! Half the tolerance: finer meshes, shorter increments, smaller jumps.
//!
//! Allowed: the sum of both tolerances, because either answer lies within its own of the exact one; three times as much for
//! the peak pressure.

use solver::SolveError;

use super::comparison::{Allowed, Deviation, compare};
use super::{SLIDING, STICKING, TOLERANCE, holds, holds_in_found};
use crate::verification::random_scenes::Drawn;
use crate::verification::recorder::solve;

fn the_same_when_refined(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    let mut refined = drawn.scene.clone();
    refined.accuracy.tolerance = 0.5 * TOLERANCE;
    let (coarse, fine) = (solve(&drawn.scene)?.0, solve(&refined)?.0);
    let allowed = Allowed::within(1.5 * TOLERANCE).or_stated([&coarse, &fine]);
    Ok(Some(compare(&coarse, &fine, allowed)))
}

#[test]
fn refined_tolerances_agree_in_gross_slip() {
    holds("refined tolerance", &SLIDING, the_same_when_refined);
}

#[test]
fn refined_tolerances_agree_in_partial_slip() {
    holds("refined tolerance", &STICKING, the_same_when_refined);
}

/// They differed by up to 9 % of the worn area with coarser layers, fewer increments and more elements.
#[test]
fn refined_tolerances_agree_in_scenes_that_differed() {
    holds_in_found(
        "refined tolerance, differed before",
        &[13, 20, 51, 171],
        the_same_when_refined,
    );
}

/// Peak pressures at the corner of the slider's flat in the groove (44, 70, 95, 100), and at the edge of a worn stick zone, where
/// they have no limit (74); the width of a scar whose outer part is about as shallow as the 2 % of its depth that count as its
/// edge (180); depths and widths in partial slip (61, 168, 170). The answers state it.
fn refined_tolerances_agree_in_the_scenes_found() {
    holds_in_found(
        "refined tolerance, found",
        &[8, 44, 61, 70, 74, 95, 100, 106, 168, 170, 180],
        the_same_when_refined,
    );
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 23 s"]
    fn refined_tolerances_agree_in_the_scenes_found() {
        super::refined_tolerances_agree_in_the_scenes_found();
    }
}
