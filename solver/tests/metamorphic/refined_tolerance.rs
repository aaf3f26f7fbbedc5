//! Half the tolerance: finer meshes, shorter increments, smaller jumps.
//!
//! Allowed: the sum of both tolerances, because either answer lies within its own of the exact one; three times as much for
//! the peak pressure.

use solver::SolveError;

use super::comparison::{Allowed, Deviation, compare};
use super::{SLIDING, STICKING, TOLERANCE, holds, holds_in_found};
use crate::random_scenes::Drawn;
use crate::recorder::solve;

fn the_same_when_refined(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    let mut refined = drawn.scene.clone();
    refined.accuracy.tolerance = 0.5 * TOLERANCE;
    let (coarse, fine) = (solve(&drawn.scene)?.0, solve(&refined)?.0);
    Ok(Some(compare(
        &coarse,
        &fine,
        Allowed::within(1.5 * TOLERANCE),
    )))
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

#[test]
#[ignore = "peak pressures off by up to 16 %: the corner of the slider's flat in the groove"]
fn refined_tolerances_agree_in_the_scenes_found_in_gross_slip() {
    holds_in_found(
        "refined tolerance, found in gross slip",
        &[44, 70, 95, 100],
        the_same_when_refined,
    );
}

#[test]
#[ignore = "the width of a scar with a shallow outer part depends on the 2 % of its depth that count as its edge"]
fn refined_tolerances_agree_in_the_scenes_found_in_partial_slip() {
    holds_in_found(
        "refined tolerance, found in partial slip",
        &[180],
        the_same_when_refined,
    );
}
