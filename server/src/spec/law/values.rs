//! Values of a wear law while it is resolved.

use api::spec::WearLaw;
use solver::scene::{SurfaceState, Temperature};

use crate::spec::law::wearing_side::WearingSide;

/// Kelvin at 0 °C.
pub(super) const ZERO_CELSIUS_K: f64 = 273.15;

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

    /// Hardness and temperature of the surface.
    pub(super) fn surface(&self) -> Option<SurfaceState> {
        Some(SurfaceState {
            hardness_mpa: self.law.hardness_mpa?,
            temperature: self.temperature(),
        })
    }

    /// The temperature of the contact as given, or that of the surroundings, over which friction and current heat it.
    pub(super) fn temperature(&self) -> Temperature {
        match self.law.contact_temperature_c {
            Some(celsius) => Temperature::OfContact(celsius + ZERO_CELSIUS_K),
            None => Temperature::OfSurroundings(self.side.surroundings_c + ZERO_CELSIUS_K),
        }
    }
}
