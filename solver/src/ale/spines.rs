//! How much of the bodies is left under the contact.

use crate::contact::{ContactError, Increment, Move};
use crate::cycle::CycleState;
use crate::model::{BodyModel, Interface, Model};

/// A body is worn through when a spine has less than this part of the unworn height left.
pub(crate) const WORN_THROUGH_SHARE: f64 = 0.03;

/// An increment may wear off this part of what is left of a body at a place; a larger one is halved.
const LARGEST_SHARE: f64 = 0.9;

/// Unworn lengths of the spines under the contact nodes, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Spines {
    receptacle: Vec<f64>,
    slider: Vec<f64>,
}

impl Spines {
    /// Those of a model.
    pub fn of(model: &Model) -> Self {
        let lengths = |body: &BodyModel| {
            let length = |x: &f64| (body.mesh.far_y() - body.profile.height(*x)).abs();
            body.contact_x().iter().map(length).collect()
        };
        Self {
            receptacle: lengths(&model.receptacle),
            slider: lengths(&model.slider),
        }
    }

    /// Whether a body is nearly consumed somewhere.
    pub fn are_worn_through(&self, state: &CycleState) -> bool {
        self.with_depths(state)
            .any(|(length, depth)| length - depth < WORN_THROUGH_SHARE * length)
    }

    /// Smallest length that is left in either body, mm.
    pub fn least_left_mm(&self, state: &CycleState) -> f64 {
        self.with_depths(state)
            .map(|(length, depth)| length - depth)
            .fold(f64::INFINITY, f64::min)
    }

    fn with_depths<'a>(&'a self, state: &'a CycleState) -> impl Iterator<Item = (f64, f64)> + 'a {
        let lengths = self.receptacle.iter().chain(&self.slider);
        let depths = state.receptacle_depth.iter().chain(&state.slider_depth);
        lengths.copied().zip(depths.copied())
    }

    /// Refuses an increment that wears off more of a body than is sound to take at once.
    ///
    /// # Errors
    /// [`ContactError::TooMuchWear`].
    pub(crate) fn check_wear(
        &self,
        interface: &Interface,
        state: &CycleState,
        to: Move,
        done: &Increment<'_>,
    ) -> Result<(), ContactError> {
        let below = self.receptacle[done.first..]
            .iter()
            .zip(&state.receptacle_depth[done.first..]);
        let above = self.slider[done.slider_first..]
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
}
