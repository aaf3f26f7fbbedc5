//! Wear by repetitions of the load: worn depth = t0 C1 p^C2 N^C3.

use api::spec::WearLaw;
use solver::scene::{self, LoadRepetition};

use super::power::{
    COURSE_EXPONENT, FACTOR, PRESSURE_EXPONENT, REFERENCE_LENGTH_MM, check_exponents, required,
};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 5] = [
    "law",
    "wear_factor",
    "pressure_exponent",
    "repetition_exponent",
    "reference_length_mm",
];

/// Resolves the law of a specification.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "load_repetition");
    let mut constant = |field, value, range| required(side, (field, value), range, diagnostics);
    let law = LoadRepetition {
        factor: constant("wear_factor", given.wear_factor, &FACTOR),
        pressure_exponent: constant(
            "pressure_exponent",
            given.pressure_exponent,
            &PRESSURE_EXPONENT,
        ),
        repetition_exponent: constant(
            "repetition_exponent",
            given.repetition_exponent,
            &COURSE_EXPONENT,
        ),
        length_mm: constant(
            "reference_length_mm",
            given.reference_length_mm,
            &REFERENCE_LENGTH_MM,
        ),
    };
    let other = (law.repetition_exponent, "`repetition_exponent`");
    check_exponents(side, given.pressure_exponent, other, diagnostics);
    (given.clone(), Some(scene::WearLaw::Power(law.power_law())))
}
