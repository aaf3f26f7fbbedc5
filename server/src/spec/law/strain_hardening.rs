//! Wear as creep that hardens by strain: de/dt = C1 p^C2 e^C3 exp(-C4/T), worn depth = t0 e.

use api::spec::WearLaw;
use solver::scene::{self, StrainHardening};

use super::oxidation;
use super::power::{
    ACTIVATION_TEMPERATURE_K, FACTOR, PRESSURE_EXPONENT, REFERENCE_LENGTH_MM, STRAIN_EXPONENT,
    check_exponents, required,
};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 7] = [
    "law",
    "wear_factor",
    "pressure_exponent",
    "strain_exponent",
    "activation_temperature_k",
    "contact_temperature_c",
    "reference_length_mm",
];

/// Resolves the law of a specification.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "strain_hardening");
    let temperature = oxidation::temperature(side, given, diagnostics);
    let mut constant = |field, value, range| required(side, (field, value), range, diagnostics);
    let law = StrainHardening {
        factor: constant("wear_factor", given.wear_factor, &FACTOR),
        pressure_exponent: constant(
            "pressure_exponent",
            given.pressure_exponent,
            &PRESSURE_EXPONENT,
        ),
        strain_exponent: constant("strain_exponent", given.strain_exponent, &STRAIN_EXPONENT),
        activation_k: constant(
            "activation_temperature_k",
            given.activation_temperature_k,
            &ACTIVATION_TEMPERATURE_K,
        ),
        temperature,
        length_mm: constant(
            "reference_length_mm",
            given.reference_length_mm,
            &REFERENCE_LENGTH_MM,
        ),
    };
    let other = (1.0 - law.strain_exponent, "1 - `strain_exponent`");
    check_exponents(side, given.pressure_exponent, other, diagnostics);
    (given.clone(), Some(scene::WearLaw::Power(law.power_law())))
}
