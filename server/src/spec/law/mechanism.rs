//! The mechanism of wear by speed and temperature: Archard's law, mild or severe oxidational wear.

use std::ops::RangeInclusive;

use api::spec::Provenance;
use solver::law::wear::speed::SLOWEST_MM_S;
use solver::scene::{self, Mechanism, SpeedLaw};

use super::mild_oxidation::{self, mild_oxidation};
use super::oxidation::{SMALLEST, TEMPERATURE, implausible};
use super::severe_oxidation::{self, severe_oxidation};
use super::wear_coefficient::{HARDNESS, K};
use crate::spec::law::definition::{
    Absent, ByFriction, FieldGroup, LawDefinition, Scaling, State, each, number,
};

/// mm/s, of the transition from Archard's law: from creep to beyond any sliding contact.
const TRANSITION_SPEED_MM_S: RangeInclusive<f64> = 1e-3..=1e6;

const COEFFICIENT: FieldGroup = FieldGroup {
    numbers: &[number!(
        k,
        "k",
        K,
        Absent::Required("write `k`, beside the hardness of the law or of the material")
    )
    .scaled(Scaling::Proportional)],
    resolve: each,
};

const TRANSITION: FieldGroup = FieldGroup {
    numbers: &[number!(
        transition_speed_mm_s,
        "V1",
        TRANSITION_SPEED_MM_S,
        Absent::Default(SLOWEST_MM_S, Provenance::Assumed)
    )],
    resolve: each,
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh of `archard` below the speed V1, of `mild_oxidation` from it on, of `severe_oxidation` where friction melts the oxide",
    states: &[State::Speed, State::Temperature],
    friction: ByFriction::Growing,
    groups: &[
        COEFFICIENT,
        HARDNESS,
        TRANSITION,
        mild_oxidation::CONSTANTS,
        severe_oxidation::CONSTANTS,
        TEMPERATURE,
    ],
    choices: &[],
    engine_law: |values| {
        Some(scene::WearLaw::OfSpeed(SpeedLaw::Mechanism(Mechanism {
            k: values.given.k?,
            transition_mm_s: values.law.transition_speed_mm_s?,
            mild: mild_oxidation(values)?,
            severe: severe_oxidation(values)?,
        })))
    },
    outside_range: Some(|law, scene| {
        let scene::WearLaw::OfSpeed(SpeedLaw::Mechanism(law)) = law else {
            return None;
        };
        let mean = scene.mean_speed_mm_s();
        let coefficient = law.mild.coefficient_at(mean.max(law.transition_mm_s));
        if coefficient < SMALLEST {
            return implausible(coefficient, mean);
        }
        let slowest = law.severe.slowest_mm_s();
        (slowest <= law.transition_mm_s).then(|| {
            format!(
                "the oxide melts from {slowest:.4} mm/s on, below the transition at {:.4} mm/s: mild oxidational wear is never the \
                 mechanism",
                law.transition_mm_s
            )
        })
    }),
    #[cfg(test)]
    example: r#""k":0.002,"hardness_mpa":1700,"oxidation_constant":3.4e-4,"arrhenius_constant_m2_s":1e6,
        "activation_energy_j_mol":138e3,"critical_film_um":10,"molten_fraction":0.1,"latent_heat_j_m3":2e9,"heat_share":0.5,
        "oxide_conductivity_w_mk":3.2,"oxide_melting_temperature_c":1487,"contact_temperature_c":1400,"diffusion_distance_um":10"#,
};
