//! Limits of the wear in one increment.
//!
//! Explicit schemes, which add dh = k p |ds| to the depths with the pressure of the increment's beginning (thesis, equation 14, whose
//! indices of node and step are exchanged between its two terms), become erratic where an increment wears more than the contact is
//! indented, so that Podra and Andersson (1999) limit it. The implicit solve is stable for any increment and needs no limit: one is an
//! option for comparison with such schemes. Nothing is cut off: an increment beyond it is halved, and a jump whose increments cannot be
//! halved any further is shortened, so that the worn area stays that of the law. Cycles that are extrapolated in a groove are no
//! increments.

use crate::ale::Spines;
use crate::contact::{ContactError, Increment};
use crate::sides::{Side, Sides};

/// Largest wear of an increment at a node over the remaining height there; an increment beyond it is halved.
const LARGEST_SHARE: f64 = 0.9;

/// Checks that an increment leaves part of both bodies, for worn depths in mm, and wears at most a depth in mm.
///
/// # Errors
/// [`ContactError::TooMuchWear`], [`ContactError::BeyondWearLimit`].
pub(crate) fn check(
    spines: &Spines,
    depth: &Sides<Vec<f64>>,
    slider_x: f64,
    done: &Increment<'_>,
    largest_mm: Option<f64>,
) -> Result<(), ContactError> {
    if let Some(limit_mm) = largest_mm {
        let recessions = done
            .recession
            .slider
            .iter()
            .chain(done.recession.receptacle);
        let wear_mm = recessions.fold(0.0, |m: f64, d| m.max(*d));
        if wear_mm > limit_mm {
            return Err(ContactError::BeyondWearLimit {
                slider_x_mm: slider_x,
                wear_mm,
                limit_mm,
            });
        }
    }
    leaves_part(spines, depth, slider_x, (done.first, done.recession))
}

/// Checks that recessions, mm, from a first node of each side on leave part of both bodies.
///
/// # Errors
/// [`ContactError::TooMuchWear`].
pub(crate) fn leaves_part(
    spines: &Spines,
    depth: &Sides<Vec<f64>>,
    slider_x: f64,
    (first, recession): (Sides<usize>, Sides<&[f64]>),
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
