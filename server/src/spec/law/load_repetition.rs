//! Wear by repetitions of the load.

use solver::scene::{self, LoadRepetition};

use super::power::{
    COURSE_EXPONENT, FACTOR, PRESSURE_EXPONENT, REFERENCE_LENGTH_MM, REQUIRED, check_exponents,
};
use crate::spec::law::definition::{
    ByFriction, FieldGroup, LawDefinition, Scaling, State, each, number,
};

const CONSTANTS: FieldGroup = FieldGroup {
    numbers: &[
        number!(wear_factor, "C1", FACTOR, REQUIRED)
            .scaled(Scaling::Power(|law| law.repetition_exponent)),
        number!(pressure_exponent, "C2", PRESSURE_EXPONENT, REQUIRED),
        number!(repetition_exponent, "C3", COURSE_EXPONENT, REQUIRED),
        number!(reference_length_mm, "t0", REFERENCE_LENGTH_MM, REQUIRED),
    ],
    resolve: |numbers, values, diagnostics| {
        each(numbers, values, diagnostics);
        check_exponents(
            values,
            values.law.repetition_exponent,
            "`repetition_exponent`",
            diagnostics,
        );
    },
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "h = t0 C1 p^C2 N^C3 after N repetitions of the load, also where the contact sticks",
    states: &[State::Depth, State::Repetitions],
    friction: ByFriction::Independent,
    groups: &[CONSTANTS],
    choices: &[],
    engine_law: |values| {
        let law = LoadRepetition {
            factor: values.law.wear_factor?,
            pressure_exponent: values.law.pressure_exponent?,
            repetition_exponent: values.law.repetition_exponent?,
            length_mm: values.law.reference_length_mm?,
        };
        Some(scene::WearLaw::Power(law.power_law()))
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""wear_factor":1e-7,"pressure_exponent":1.2,"repetition_exponent":0.8,"reference_length_mm":0.01"#,
};
