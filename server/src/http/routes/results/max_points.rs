//! Query parameter `max_points` of curves.

use crate::export::thin::FEWEST_POINTS;
use crate::http::problem::{ProblemType, RouteError};

/// Largest accepted value; without the parameter, all points are returned.
const MAX: usize = 100_000;

/// Error of a `max_points` that is out of range.
#[derive(Debug, thiserror::Error)]
#[error("max_points is {0}; it can be {FEWEST_POINTS} to {MAX}")]
pub(crate) struct MaxPointsError(usize);

impl RouteError for MaxPointsError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Checks the range of `max_points`.
pub(crate) fn check(max_points: Option<usize>) -> Result<(), MaxPointsError> {
    match max_points {
        Some(points) if !(FEWEST_POINTS..=MAX).contains(&points) => Err(MaxPointsError(points)),
        _ => Ok(()),
    }
}
