//! Wear by dissipated energy.

use std::ops::RangeInclusive;

use solver::scene;

use crate::spec::law::definition::{
    Absent, ByFriction, FieldGroup, LawDefinition, Scaling, each, number,
};

/// Worn volume per dissipated energy, mm^3/J: k/H = 1 1/MPa at mu = 1 is 1 000 mm^3/J.
const ENERGY_COEFFICIENT_MM3_PER_J: RangeInclusive<f64> = 0.0..=1e3;

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh = alpha mu p |ds|",
    states: &[],
    friction: ByFriction::Proportional,
    groups: &[FieldGroup {
        numbers: &[number!(
            energy_coefficient_mm3_per_j,
            "alpha",
            ENERGY_COEFFICIENT_MM3_PER_J,
            Absent::Required("`dissipated_energy` needs the worn volume per energy")
        )
        .scaled(Scaling::Proportional)],
        resolve: each,
    }],
    choices: &[],
    engine_law: |values| {
        Some(scene::WearLaw::DissipatedEnergy {
            mm3_per_j: values.given.energy_coefficient_mm3_per_j?,
            friction: values.friction,
        })
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""energy_coefficient_mm3_per_j":2e-3"#,
};
