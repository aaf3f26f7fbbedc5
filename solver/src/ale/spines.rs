//! Remaining height of the bodies under the contact.

use crate::model::{BodyModel, Model};
use crate::sides::{Side, Sides};

/// A body is worn through when a spine has less than this part of its unworn length left.
pub(crate) const WORN_THROUGH_SHARE: f64 = 0.03;

/// Unworn lengths of the spines under the contact nodes, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Spines(Sides<Vec<f64>>);

impl Spines {
    /// Those of a model.
    pub fn of(model: &Model) -> Self {
        let lengths = |body: &BodyModel| {
            let length = |x: &f64| (body.layout.far_y - body.layout.profile.height(*x)).abs();
            body.contact_x().iter().map(length).collect()
        };
        Self(model.bodies.as_ref().map(lengths))
    }

    /// Unworn lengths of each side, mm.
    pub(crate) fn lengths(&self) -> Sides<&[f64]> {
        self.0.as_slices()
    }

    /// Whether a body is nearly consumed somewhere at these worn depths, mm.
    pub fn are_worn_through(&self, depth: &Sides<Vec<f64>>) -> bool {
        Side::BOTH.into_iter().any(|side| {
            let spines = self.0.of(side).iter().zip(depth.of(side));
            // Counted, since a loop that may end early is not vectorised.
            let consumed = spines
                .map(|(length, depth)| u64::from(length - depth < WORN_THROUGH_SHARE * length));
            consumed.sum::<u64>() > 0
        })
    }

    /// Smallest remaining length in either body at these worn depths, mm.
    pub fn least_left_mm(&self, depth: &Sides<Vec<f64>>) -> f64 {
        self.with_depths(depth)
            .map(|(length, depth)| length - depth)
            .fold(f64::INFINITY, f64::min)
    }

    fn with_depths<'a>(
        &'a self,
        depth: &'a Sides<Vec<f64>>,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let lengths = self.0.receptacle.iter().chain(&self.0.slider);
        let depths = depth.receptacle.iter().chain(&depth.slider);
        lengths.copied().zip(depths.copied())
    }
}
