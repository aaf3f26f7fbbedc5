//! Remaining height of the bodies under the contact.

use crate::model::{BodyModel, Model};
use crate::sides::{Side, Sides};

/// A body is worn through when a spine has less than this part of its unworn length left.
pub(crate) const WORN_THROUGH_SHARE: f64 = 0.03;

/// Unworn lengths of the spines under the contact nodes, mm.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spines(Sides<Vec<f64>>);

impl Spines {
    /// Spines of a model.
    pub(crate) fn of(model: &Model) -> Self {
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

    /// Returns `true` if a body is nearly consumed somewhere at these worn depths, mm.
    pub(crate) fn are_worn_through(&self, depth: &Sides<Vec<f64>>) -> bool {
        Side::BOTH.into_iter().any(|side| {
            let spines = self.0.of(side).iter().zip(depth.of(side));
            // Counted, since a loop that may end early is not vectorised.
            let consumed = spines
                .map(|(length, depth)| u64::from(length - depth < WORN_THROUGH_SHARE * length));
            consumed.sum::<u64>() > 0
        })
    }

    /// Cycles in which a spine of either body would be consumed at these worn depths, mm, and rates, mm a cycle.
    pub(crate) fn cycles_left(&self, depth: &Sides<Vec<f64>>, rates: Sides<&[f64]>) -> f64 {
        let of_side = |side: Side| {
            let left = self.0.of(side).iter().zip(depth.of(side));
            left.zip(*rates.of(side))
                .filter(|(_, rate)| **rate > 0.0)
                .map(|((length, depth), rate)| (length - depth) / rate)
                .fold(f64::INFINITY, f64::min)
        };
        of_side(Side::Slider).min(of_side(Side::Receptacle))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_spines_that_wear_limit_the_cycles_left() {
        let spines = Spines(Sides {
            slider: vec![0.005, 0.025],
            receptacle: vec![0.06, 0.06],
        });
        let depth = Sides {
            slider: vec![0.0; 2],
            receptacle: vec![0.02, 0.04],
        };
        let cycles = |slider: [f64; 2], receptacle: [f64; 2]| {
            let rates = Sides {
                slider: &slider[..],
                receptacle: &receptacle[..],
            };
            spines.cycles_left(&depth, rates)
        };
        assert!((cycles([0.0; 2], [1e-5, 2e-5]) - 1_000.0).abs() < 1e-9);
        assert!((cycles([0.0, 1e-4], [1e-5, 2e-5]) - 250.0).abs() < 1e-9);
        assert!(cycles([0.0; 2], [0.0; 2]).is_infinite());
    }
}
