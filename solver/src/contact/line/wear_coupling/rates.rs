//! Specific wear rates of a node over an increment, and the recession's derivatives in the same unit.
//!
//! For h = n k e with e = p |sigma| the derivatives are dh/dp = n k_p |sigma| and dh/d|sigma| = n k_s p:
//! * a law k(p, |sigma|): k_p = k + p dk/dp, k_s = k + |sigma| dk/d|sigma|,
//! * a law by dose: k the mean over the dose n e, and k_p = k_s the rate with which the increment ends.

use crate::law::dose::DoseCurve;
use crate::law::wear::{LocalState, WearLaw};

/// Rates of a node, 1/MPa.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct NodeRates {
    /// k.
    pub(super) value: f64,
    /// k_p.
    pub(super) per_pressure: f64,
    /// k_s.
    pub(super) per_slip: f64,
}

impl NodeRates {
    /// Rates of a law at a local state.
    pub(super) fn of_law(law: WearLaw, at: LocalState) -> Self {
        let rate = law.rate(at);
        Self {
            value: rate.value,
            per_pressure: rate.value + at.pressure * rate.d_pressure,
            per_slip: rate.value + at.slip * rate.d_slip,
        }
    }

    /// Rates of a law by dose from a depth in mm over a dose in MPa mm.
    pub(super) fn by_dose(curve: &DoseCurve, depth: f64, dose: f64) -> Self {
        let (worn, end) = curve.recession(depth, dose);
        Self {
            value: if dose > 0.0 { worn / dose } else { end },
            per_pressure: end,
            per_slip: end,
        }
    }
}
