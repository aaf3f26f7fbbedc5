//! Values of a wear law while it is resolved.

use crate::spec::law::wearing_side::WearingSide;
use api::spec::WearLaw;

/// A law of a side, beside a coefficient of friction.
pub(super) struct Values<'a> {
    pub(super) side: &'a WearingSide<'a>,
    /// The law as given.
    pub(super) given: &'a WearLaw,
    /// The law with what has been resolved so far; the least of a range stands for a required number that is missing.
    pub(super) law: WearLaw,
    pub(super) friction: f64,
}

impl<'a> Values<'a> {
    /// The values of a law as given.
    pub(super) fn new(side: &'a WearingSide<'a>, given: &'a WearLaw, friction: f64) -> Self {
        Self {
            side,
            given,
            law: given.clone(),
            friction,
        }
    }

    /// Wear coefficient over hardness, 1/MPa.
    pub(super) fn k_over_h_per_mpa(&self) -> Option<f64> {
        match (self.law.k, self.law.k_over_h_per_mpa) {
            (Some(k), None) => Some(k / self.law.hardness_mpa?),
            (None, ratio) => ratio,
            (Some(_), Some(_)) => None,
        }
    }
}
