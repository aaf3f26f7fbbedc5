//! k_D = k (p/p0)^m: a specific wear rate that grows with the pressure, to test a contact solve with a rate that is not
//! the same everywhere. Limiting case: m = 0 is Archard's law.
//! Range: m >= 0; below it the recession per slip is steep without bound where the contact opens.

use super::rate::{LocalState, Rate};

/// Specific wear rate for k in 1/MPa and p0 in MPa; an unloaded point does not wear.
pub(super) fn rate(k: f64, reference: f64, exponent: f64, at: LocalState) -> Rate {
    if at.pressure <= 0.0 {
        return Rate::default();
    }
    let value = k * (at.pressure / reference).powf(exponent);
    Rate {
        value,
        d_pressure: exponent * value / at.pressure,
        d_slip: 0.0,
    }
}
