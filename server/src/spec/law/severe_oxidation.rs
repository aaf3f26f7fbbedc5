//! Severe oxidational wear at high speeds.

use std::ops::RangeInclusive;

use solver::scene::{self, SevereOxidation, SpeedLaw};

use super::oxidation::{CONTACT_TEMPERATURE_C, FRACTION, LENGTH_UM, REQUIRED, TEMPERATURE};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::definition::{
    ByFriction, FieldGroup, LawDefinition, Scaling, State, each, number,
};
use crate::spec::law::values::{Values, ZERO_CELSIUS_K};
use crate::spec::law::wear_coefficient::HARDNESS;

/// J/m^3; a metre of ice and of the most refractory oxide are 3e8 and 1e10.
const LATENT_HEAT_J_M3: RangeInclusive<f64> = 1e7..=1e11;
/// W/(m K).
const CONDUCTIVITY_W_MK: RangeInclusive<f64> = 1e-3..=1e3;

pub(super) const CONSTANTS: FieldGroup = FieldGroup {
    numbers: &[
        number!(molten_fraction, "fm", FRACTION, REQUIRED).scaled(Scaling::Proportional),
        number!(latent_heat_j_m3, "L", LATENT_HEAT_J_M3, REQUIRED),
        number!(heat_share, "alpha", FRACTION, REQUIRED),
        number!(oxide_conductivity_w_mk, "K", CONDUCTIVITY_W_MK, REQUIRED),
        number!(
            oxide_melting_temperature_c,
            "Tm",
            CONTACT_TEMPERATURE_C,
            REQUIRED
        ),
        number!(diffusion_distance_um, "lf", LENGTH_UM, REQUIRED),
    ],
    resolve: |numbers, values, diagnostics| {
        each(numbers, values, diagnostics);
        check_melting(values, diagnostics);
    },
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh = (fm/L) [alpha mu - K (Tm - T)/(lf v H)]+ p |ds|",
    states: &[State::Speed, State::Temperature],
    friction: ByFriction::Growing,
    groups: &[HARDNESS, TEMPERATURE, CONSTANTS],
    choices: &[],
    engine_law: |values| {
        let law = SpeedLaw::SevereOxidation(severe_oxidation(values)?);
        Some(scene::WearLaw::OfSpeed(law))
    },
    outside_range: Some(|law, scene| {
        let scene::WearLaw::OfSpeed(SpeedLaw::SevereOxidation(law)) = law else {
            return None;
        };
        let (slowest, fastest) = (law.slowest_mm_s(), scene.fastest_speed_mm_s());
        (fastest <= slowest).then(|| {
            format!(
                "nothing wears: the oxide melts from {slowest:.4} mm/s on, and the motion has {fastest:.4} mm/s at most"
            )
        })
    }),
    #[cfg(test)]
    example: r#""molten_fraction":0.1,"latent_heat_j_m3":2e9,"heat_share":0.5,"oxide_conductivity_w_mk":3.2,
        "oxide_melting_temperature_c":1487,"contact_temperature_c":1400,"diffusion_distance_um":10,"hardness_mpa":1700"#,
};

pub(super) fn severe_oxidation(values: &Values<'_>) -> Option<SevereOxidation> {
    let law = &values.law;
    Some(SevereOxidation {
        molten_fraction: law.molten_fraction?,
        latent_heat_j_m3: law.latent_heat_j_m3?,
        heat_share: law.heat_share?,
        friction: values.friction,
        conductivity_w_mk: law.oxide_conductivity_w_mk?,
        melting_k: law.oxide_melting_temperature_c? + ZERO_CELSIUS_K,
        diffusion_um: law.diffusion_distance_um?,
        surface: values.surface()?,
    })
}

/// Adds a fault for a bulk that is not colder than the molten oxide.
fn check_melting(values: &Values<'_>, diagnostics: &mut Diagnostics) {
    let (given, side) = (values.given, values.side);
    let bulk = given.contact_temperature_c.unwrap_or(side.surroundings_c);
    let melting = given.oxide_melting_temperature_c;
    if let Some(melting) = melting.filter(|melting| *melting <= bulk) {
        let detail = format!("{bulk} is not below the {melting} at which the oxide melts");
        diagnostics.fault(&side.field("contact_temperature_c"), detail);
    }
}
