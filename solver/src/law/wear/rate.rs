//! Local state of a contact, and the rate that a wear law returns for it.

use crate::law::pace::Pace;

/// Local state of a contact point over one increment of slip.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LocalState {
    /// Contact pressure p, MPa.
    pub pressure: f64,
    /// Magnitude of the slip |ds| in the increment, mm.
    pub slip: f64,
    /// Worn depth before the increment, mm. The contact solve evaluates laws that depend on it through their dose
    /// (`law::dose`), at the nodes of the surface that wears.
    pub depth: f64,
    /// Pace of the imposed motion. The contact solve takes laws that depend on it as they are during an increment
    /// (`WearLaw::at_pace`).
    pub pace: Pace,
}

impl LocalState {
    /// Representative state for estimates: the mean pressure P/(2 b) under a load in N/mm and a half-width in mm, and a
    /// slip of b/2, about an increment at a tolerance of 2 %, at a pace.
    pub fn mean(load: f64, half_width: f64, pace: Pace) -> Self {
        Self {
            pressure: load / (2.0 * half_width),
            slip: 0.5 * half_width,
            pace,
            ..Self::default()
        }
    }
}

/// Specific wear rate k_D = dh / (p |ds|) and its derivatives: worn depth per pressure and slip. Every law can be
/// written in it, and the contact solve then conserves the worn area for all of them alike.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rate {
    /// k_D, 1/MPa.
    pub value: f64,
    /// Derivative with respect to pressure, 1/MPa^2.
    pub d_pressure: f64,
    /// Derivative with respect to slip, 1/(MPa mm).
    pub d_slip: f64,
}

impl Rate {
    /// A rate that is the same in every state, 1/MPa.
    pub(super) const fn uniform(value: f64) -> Self {
        Self {
            value,
            d_pressure: 0.0,
            d_slip: 0.0,
        }
    }

    /// The mean rate over a dose p |ds| that wears a depth in mm and ends with a rate in 1/MPa.
    pub(super) fn over_dose(pressure: f64, slip: f64, worn: f64, end: f64) -> Self {
        let dose = pressure * slip;
        if dose <= 0.0 {
            return Self::uniform(end);
        }
        let value = worn / dose;
        Self {
            value,
            d_pressure: (end - value) / pressure,
            d_slip: (end - value) / slip,
        }
    }
}
