//! Mild oxidational wear at moderate speeds.

use std::ops::RangeInclusive;

use solver::scene::{self, MildOxidation, SpeedLaw};

use super::oxidation::{
    ACTIVATION_ENERGY_J_MOL, ARRHENIUS_CONSTANT, LENGTH_UM, REQUIRED, TEMPERATURE, implausible,
};
use crate::spec::law::definition::{
    ByFriction, FieldGroup, LawDefinition, Scaling, State, each, number,
};
use crate::spec::law::values::Values;
use crate::spec::law::wear_coefficient::HARDNESS;

/// The constant C, -.
const CONSTANT: RangeInclusive<f64> = 1e-12..=1e3;

pub(super) const CONSTANTS: FieldGroup = FieldGroup {
    numbers: &[
        number!(oxidation_constant, "C", CONSTANT, REQUIRED),
        number!(arrhenius_constant_m2_s, "A0", ARRHENIUS_CONSTANT, REQUIRED)
            .scaled(Scaling::Proportional),
        number!(
            activation_energy_j_mol,
            "Q0",
            ACTIVATION_ENERGY_J_MOL,
            REQUIRED
        ),
        number!(critical_film_um, "Zc", LENGTH_UM, REQUIRED),
    ],
    resolve: each,
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh = K p |ds|/H, K = C^2 A0 exp(-Q0/(R T))/(Zc v)",
    states: &[State::Speed, State::Temperature],
    friction: ByFriction::Independent,
    groups: &[HARDNESS, TEMPERATURE, CONSTANTS],
    choices: &[],
    engine_law: |values| {
        let law = SpeedLaw::MildOxidation(mild_oxidation(values)?);
        Some(scene::WearLaw::OfSpeed(law))
    },
    outside_range: Some(|law, scene| {
        let scene::WearLaw::OfSpeed(SpeedLaw::MildOxidation(law)) = law else {
            return None;
        };
        let mean = scene.mean_speed_mm_s();
        implausible(law.coefficient_at(mean), mean)
    }),
    #[cfg(test)]
    example: r#""oxidation_constant":3.4e-4,"arrhenius_constant_m2_s":1e6,"activation_energy_j_mol":138e3,"critical_film_um":10,
        "contact_temperature_c":600,"hardness_mpa":1700"#,
};

pub(super) fn mild_oxidation(values: &Values<'_>) -> Option<MildOxidation> {
    let law = &values.law;
    Some(MildOxidation {
        constant: law.oxidation_constant?,
        arrhenius_m2_s: law.arrhenius_constant_m2_s?,
        activation_j_mol: law.activation_energy_j_mol?,
        film_um: law.critical_film_um?,
        surface: values.surface()?,
    })
}
