//! Constants of the laws of which a power of the depth adds; all of them are required from the user.

use std::ops::RangeInclusive;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::definition::Absent;
use crate::spec::law::values::Values;

/// Factors, in the units of their exponents: their largest power, the tenth, is a number.
pub(super) const FACTOR: RangeInclusive<f64> = 1e-30..=1e30;
/// Exponents of the pressure, -: below 1 the recession would have no finite derivative where the contact opens.
pub(super) const PRESSURE_EXPONENT: RangeInclusive<f64> = 1.0..=10.0;
/// Exponents of time and repetitions, -.
pub(super) const COURSE_EXPONENT: RangeInclusive<f64> = 0.1..=10.0;
/// mm, from below an atom to beyond every part.
pub(super) const REFERENCE_LENGTH_MM: RangeInclusive<f64> = 1e-9..=1e3;

/// A constant without a default.
pub(super) const REQUIRED: Absent =
    Absent::Required("the law has no default constants, since none are published of contacts");

/// Adds a fault where the pressure's exponent is below another one, so that an unworn surface would have no finite derivative where
/// the contact opens.
pub(super) fn check_exponents(
    values: &Values<'_>,
    other: Option<f64>,
    name: &str,
    diagnostics: &mut Diagnostics,
) {
    let Some((exponent, other)) = values.given.pressure_exponent.zip(other) else {
        return;
    };
    if exponent < other {
        let detail = format!(
            "{exponent} is less than {name}, {other}: the wear at the edge of the contact would have no limit"
        );
        let pointer = values.side.field("pressure_exponent");
        diagnostics.fault(&pointer, detail);
    }
}
