//! Quinn's law of mild oxidational wear.

use std::ops::RangeInclusive;

use solver::scene::{self, Quinn, SpeedLaw};

use super::oxidation::{
    ACTIVATION_ENERGY_J_MOL, ARRHENIUS_CONSTANT, FRACTION, LENGTH_UM, REQUIRED, TEMPERATURE,
    implausible,
};
use crate::spec::law::definition::{
    ByFriction, FieldGroup, LawDefinition, Scaling, State, each, number,
};
use crate::spec::law::wear_coefficient::HARDNESS;

/// kg/m^3, of oxides.
const OXIDE_DENSITY_KG_M3: RangeInclusive<f64> = 1e3..=2e4;

const CONSTANTS: FieldGroup = FieldGroup {
    numbers: &[
        number!(asperity_diameter_um, "d", LENGTH_UM, REQUIRED),
        number!(
            arrhenius_constant_kg2_m4s,
            "Ap",
            ARRHENIUS_CONSTANT,
            REQUIRED
        )
        .scaled(Scaling::Proportional),
        number!(
            activation_energy_j_mol,
            "Qp",
            ACTIVATION_ENERGY_J_MOL,
            REQUIRED
        ),
        number!(critical_film_um, "xi", LENGTH_UM, REQUIRED),
        number!(oxide_density_kg_m3, "rho", OXIDE_DENSITY_KG_M3, REQUIRED),
        number!(oxygen_fraction, "f", FRACTION, REQUIRED),
    ],
    resolve: each,
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh = K p |ds|/H, K = d Ap exp(-Qp/(R T))/(xi^2 rho^2 f^2 v)",
    states: &[State::Speed, State::Temperature],
    friction: ByFriction::Independent,
    groups: &[HARDNESS, TEMPERATURE, CONSTANTS],
    choices: &[],
    engine_law: |values| {
        let law = &values.law;
        Some(scene::WearLaw::OfSpeed(SpeedLaw::Quinn(Quinn {
            asperity_um: law.asperity_diameter_um?,
            arrhenius_kg2_m4s: law.arrhenius_constant_kg2_m4s?,
            activation_j_mol: law.activation_energy_j_mol?,
            film_um: law.critical_film_um?,
            oxide_density_kg_m3: law.oxide_density_kg_m3?,
            oxygen_fraction: law.oxygen_fraction?,
            surface: values.surface()?,
        })))
    },
    outside_range: Some(|law, scene| {
        let scene::WearLaw::OfSpeed(SpeedLaw::Quinn(law)) = law else {
            return None;
        };
        let mean = scene.mean_speed_mm_s();
        implausible(law.coefficient_at(mean), mean)
    }),
    #[cfg(test)]
    example: r#""activation_energy_j_mol":96e3,"critical_film_um":3,"asperity_diameter_um":5,"arrhenius_constant_kg2_m4s":1e2,
        "oxide_density_kg_m3":5200,"oxygen_fraction":0.2885,"hardness_mpa":1700,"contact_temperature_c":400"#,
};
