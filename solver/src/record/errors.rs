//! Estimated errors of a run.

use serde::{Deserialize, Serialize};

use crate::record::Quantity;
use crate::scene::PRESSURE_TOLERANCES;

/// Estimated relative error of a quantity and the parts of it that mesh, increments, cycle jumps and skipped effects cause.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorParts {
    /// The whole error.
    pub relative: f64,
    /// The part of the mesh.
    pub mesh: f64,
    /// The part of the increments.
    pub increments: f64,
    /// The part of the cycle jumps.
    pub jump: f64,
    /// The part of the effects that the plan skips.
    pub effects: f64,
}

/// An error outside of the tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Excess {
    /// The quantity.
    pub quantity: Quantity,
    /// Estimated relative error.
    pub relative: f64,
    /// The error that the tolerance allows.
    pub allowed: f64,
}

/// Estimated errors of a run, each that of the worse side.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Of the largest worn depth.
    pub worn_depth: ErrorParts,
    /// Of half the width of the scar.
    pub scar_half_width: ErrorParts,
    /// Of the worn area.
    pub worn_area: ErrorParts,
    /// Of the highest contact pressure.
    pub peak_pressure: ErrorParts,
    /// Of the resistance of the contact; `None` where it is not computed.
    pub contact_resistance: Option<ErrorParts>,
}

impl Errors {
    /// The errors of each quantity of a run, which may have a resistance of the contact.
    pub(crate) fn of(has_resistance: bool, parts: impl Fn(Quantity) -> ErrorParts) -> Self {
        Self {
            worn_depth: parts(Quantity::WornDepth),
            scar_half_width: parts(Quantity::ScarHalfWidth),
            worn_area: parts(Quantity::WornArea),
            peak_pressure: parts(Quantity::PeakPressure),
            contact_resistance: has_resistance.then(|| parts(Quantity::ContactResistance)),
        }
    }

    /// The error of a quantity; 0 for one that is not computed.
    pub fn parts(&self, quantity: Quantity) -> ErrorParts {
        match quantity {
            Quantity::WornDepth => self.worn_depth,
            Quantity::ScarHalfWidth => self.scar_half_width,
            Quantity::WornArea => self.worn_area,
            Quantity::PeakPressure => self.peak_pressure,
            Quantity::ContactResistance => self.contact_resistance.unwrap_or_default(),
        }
    }

    /// The errors that exceed what a tolerance allows them.
    pub fn outside(&self, tolerance: f64) -> impl Iterator<Item = Excess> {
        let all = Quantity::ALL.into_iter().map(move |quantity| Excess {
            quantity,
            relative: self.parts(quantity).relative,
            allowed: quantity.allowed(tolerance),
        });
        all.filter(|error| error.relative > error.allowed)
    }
}

impl Quantity {
    /// The error that a tolerance allows it.
    pub fn allowed(self, tolerance: f64) -> f64 {
        match self {
            Self::PeakPressure | Self::ContactResistance => PRESSURE_TOLERANCES * tolerance,
            Self::WornDepth | Self::ScarHalfWidth | Self::WornArea => tolerance,
        }
    }
}
