//! Limit of the wear in one increment: implicit wear is stable for any increment, but an increment must leave part of both bodies.

use crate::ale::Spines;
use crate::contact::ContactError;
use crate::sides::{Side, Sides};

/// Largest wear of an increment at a node over the remaining height there; an increment beyond it is halved.
const LARGEST_SHARE: f64 = 0.9;

/// Checks that recessions, mm, from a first node of each side on leave part of both bodies.
///
/// # Errors
/// [`ContactError::TooMuchWear`].
pub(crate) fn check(
    spines: &Spines,
    depth: &Sides<Vec<f64>>,
    slider_x: f64,
    first: Sides<usize>,
    recession: Sides<&[f64]>,
) -> Result<(), ContactError> {
    for side in [Side::Receptacle, Side::Slider] {
        let first = *first.of(side);
        let (lengths, depths) = (spines.lengths(), depth.of(side));
        let left = lengths.of(side)[first..].iter().zip(&depths[first..]);
        for ((length, depth), recession) in left.zip(*recession.of(side)) {
            let share = recession / (length - depth);
            if share.is_nan() || share > LARGEST_SHARE {
                return Err(ContactError::TooMuchWear {
                    slider_x_mm: slider_x,
                    share,
                    limit: LARGEST_SHARE,
                });
            }
        }
    }
    Ok(())
}
