//! Limit of the wear in one increment.

use crate::ale::Spines;
use crate::contact::{ContactError, Displacement, Increment};
use crate::sides::{Side, Sides};

/// Largest wear of an increment at a node over the remaining height there; an increment beyond it is halved.
const LARGEST_SHARE: f64 = 0.9;

/// Checks that an increment leaves part of both bodies, for specific wear rates (1/MPa) and worn depths (mm).
///
/// # Errors
/// [`ContactError::TooMuchWear`].
pub(super) fn check(
    spines: &Spines,
    rate: Sides<f64>,
    depth: &Sides<Vec<f64>>,
    to: Displacement,
    done: &Increment<'_>,
) -> Result<(), ContactError> {
    for side in [Side::Receptacle, Side::Slider] {
        let first = *done.first.of(side);
        let (lengths, depths) = (spines.lengths(), depth.of(side));
        let left = lengths.of(side)[first..].iter().zip(&depths[first..]);
        for ((length, depth), path) in left.zip(*done.path.of(side)) {
            let share = rate.of(side) * to.cycles * path / (length - depth);
            if share.is_nan() || share > LARGEST_SHARE {
                return Err(ContactError::TooMuchWear {
                    slider_x_mm: to.slider_x,
                    share,
                    limit: LARGEST_SHARE,
                });
            }
        }
    }
    Ok(())
}
