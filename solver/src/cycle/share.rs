//! How much of what is left of a body one increment may wear off.

use super::CycleState;
use crate::ale::Spines;
use crate::contact::{ContactError, Increment, Move};
use crate::model::Interface;

/// This part of it at a place; an increment that takes more is halved.
const LARGEST_SHARE: f64 = 0.9;

/// Refuses an increment that wears off more of a body than is sound to take at once.
///
/// # Errors
/// [`ContactError::TooMuchWear`].
pub(super) fn check_wear(
    spines: &Spines,
    interface: &Interface,
    state: &CycleState,
    to: Move,
    done: &Increment<'_>,
) -> Result<(), ContactError> {
    let below = spines.receptacle[done.first..]
        .iter()
        .zip(&state.receptacle_depth[done.first..]);
    let above = spines.slider[done.slider_first..]
        .iter()
        .zip(&state.slider_depth[done.slider_first..]);
    let receptacle = below
        .zip(done.path)
        .map(|at| (interface.receptacle_wear, at));
    let slider = above
        .zip(done.slider_path)
        .map(|at| (interface.slider_wear, at));
    for (k, ((length, depth), path)) in receptacle.chain(slider) {
        let share = k * to.cycles * path / (length - depth);
        if share.is_nan() || share > LARGEST_SHARE {
            return Err(ContactError::TooMuchWear {
                slider_x_mm: to.slider_x,
                share,
                limit: LARGEST_SHARE,
            });
        }
    }
    Ok(())
}
