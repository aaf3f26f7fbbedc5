//! Wear as creep that hardens by strain.

use std::ops::RangeInclusive;

use solver::scene::{self, StrainHardening};

use super::oxidation::TEMPERATURE;
use super::power::{FACTOR, PRESSURE_EXPONENT, REFERENCE_LENGTH_MM, REQUIRED, check_exponents};
use crate::spec::law::definition::{
    ByFriction, FieldGroup, LawDefinition, Scaling, State, each, number,
};

/// Exponent of the strain, -: from 1 on strain grows without bound in a finite time.
const STRAIN_EXPONENT: RangeInclusive<f64> = -9.0..=0.9;
/// K.
const ACTIVATION_TEMPERATURE_K: RangeInclusive<f64> = 0.0..=1e6;

const CONSTANTS: FieldGroup = FieldGroup {
    numbers: &[
        number!(wear_factor, "C1", FACTOR, REQUIRED).scaled(Scaling::Proportional),
        number!(pressure_exponent, "C2", PRESSURE_EXPONENT, REQUIRED),
        number!(strain_exponent, "C3", STRAIN_EXPONENT, REQUIRED),
        number!(
            activation_temperature_k,
            "C4",
            ACTIVATION_TEMPERATURE_K,
            REQUIRED
        ),
        number!(reference_length_mm, "t0", REFERENCE_LENGTH_MM, REQUIRED),
    ],
    resolve: |numbers, values, diagnostics| {
        each(numbers, values, diagnostics);
        let other = values.law.strain_exponent.map(|strain| 1.0 - strain);
        check_exponents(values, other, "1 - `strain_exponent`", diagnostics);
    },
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "h = t0 e, de/dt = C1 p^C2 e^C3 exp(-C4/T), also where the contact sticks",
    states: &[State::Depth, State::Time, State::Temperature],
    friction: ByFriction::Independent,
    groups: &[TEMPERATURE, CONSTANTS],
    choices: &[],
    engine_law: |values| {
        let law = StrainHardening {
            factor: values.law.wear_factor?,
            pressure_exponent: values.law.pressure_exponent?,
            strain_exponent: values.law.strain_exponent?,
            activation_k: values.law.activation_temperature_k?,
            temperature: values.temperature(),
            length_mm: values.law.reference_length_mm?,
        };
        Some(scene::WearLaw::Power(law.power_law()))
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""wear_factor":2.0,"pressure_exponent":1.6,"strain_exponent":-0.5,"activation_temperature_k":6000,
        "reference_length_mm":0.01"#,
};
