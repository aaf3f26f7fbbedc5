//! Limit of the wear in one increment.

use crate::ale::Spines;
use crate::contact::{ContactError, Increment};
use crate::sides::{Side, Sides};

/// Largest wear of an increment at a node over the remaining height there; an increment beyond it is halved.
const LARGEST_SHARE: f64 = 0.9;

/// Checks that an increment leaves part of both bodies, for worn depths in mm.
///
/// # Errors
/// [`ContactError::TooMuchWear`].
pub(super) fn check(
    spines: &Spines,
    depth: &Sides<Vec<f64>>,
    slider_x: f64,
    done: &Increment<'_>,
) -> Result<(), ContactError> {
    for side in [Side::Receptacle, Side::Slider] {
        let first = *done.first.of(side);
        let (lengths, depths) = (spines.lengths(), depth.of(side));
        let left = lengths.of(side)[first..].iter().zip(&depths[first..]);
        for ((length, depth), recession) in left.zip(*done.recession.of(side)) {
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
