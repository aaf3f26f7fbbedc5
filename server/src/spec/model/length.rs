//! A length of a model.

use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::Sourced;
use crate::spec::system::LENGTH_MM;
use crate::spec::unit;

/// Resolves a length, mm.
pub(super) fn length(
    pointer: &str,
    given: Option<f64>,
    default: Sourced<f64>,
    diagnostics: &mut Diagnostics,
) -> f64 {
    diagnostics.check_unit(pointer, given, &unit::length_mm(default.value));
    let value = diagnostics.or_default(pointer, given, default);
    diagnostics.check_range(pointer, value, &LENGTH_MM)
}
