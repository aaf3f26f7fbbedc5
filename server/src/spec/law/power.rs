//! Constants of the laws of which a power of the depth adds; all of them are required from the user.

use std::ops::RangeInclusive;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// Factors, in the units of their exponents: their largest power, the tenth, is a number.
pub(super) const FACTOR: RangeInclusive<f64> = 1e-30..=1e30;
/// Exponents of the pressure, -: below 1 the recession would have no finite derivative where the contact opens.
pub(super) const PRESSURE_EXPONENT: RangeInclusive<f64> = 1.0..=10.0;
/// Exponents of the speed, -.
pub(super) const SPEED_EXPONENT: RangeInclusive<f64> = -10.0..=10.0;
/// Exponents of time and repetitions, -.
pub(super) const COURSE_EXPONENT: RangeInclusive<f64> = 0.1..=10.0;
/// Exponent of the strain, -: from 1 on strain grows without bound in a finite time.
pub(super) const STRAIN_EXPONENT: RangeInclusive<f64> = -9.0..=0.9;
/// K.
pub(super) const ACTIVATION_TEMPERATURE_K: RangeInclusive<f64> = 0.0..=1e6;
/// mm, from below an atom to beyond every part.
pub(super) const REFERENCE_LENGTH_MM: RangeInclusive<f64> = 1e-9..=1e3;

/// A required constant.
pub(super) fn required(
    side: &WearingSide<'_>,
    (field, value): (&str, Option<f64>),
    range: &RangeInclusive<f64>,
    diagnostics: &mut Diagnostics,
) -> f64 {
    let needs = "the law has no default constants, since none are published of contacts";
    diagnostics.required(&side.field(field), value, range, needs)
}

/// Adds a fault where the pressure's exponent is below another one, so that an unworn surface would have no finite derivative where
/// the contact opens.
pub(super) fn check_exponents(
    side: &WearingSide<'_>,
    pressure: Option<f64>,
    (other, name): (f64, &str),
    diagnostics: &mut Diagnostics,
) {
    if let Some(exponent) = pressure.filter(|exponent| *exponent < other) {
        let detail = format!(
            "{exponent} is less than {name}, {other}: the wear at the edge of the contact would have no limit"
        );
        diagnostics.fault(&side.field("pressure_exponent"), detail);
    }
}
