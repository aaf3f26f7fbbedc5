//! How much of the bodies is left under the contact.

use crate::cycle::CycleState;
use crate::model::{BodyModel, Model};

/// A body is worn through when a spine has less than this part of the unworn height left.
pub(crate) const WORN_THROUGH_SHARE: f64 = 0.03;

/// Unworn lengths of the spines under the contact nodes, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Spines {
    pub(crate) receptacle: Vec<f64>,
    pub(crate) slider: Vec<f64>,
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
}
