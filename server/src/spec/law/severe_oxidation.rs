//! Severe oxidational wear at high speeds.

use api::spec::WearLaw;
use solver::scene::{self, SevereOxidation, SpeedLaw, SurfaceState};

use super::oxidation::{
    CONDUCTIVITY_W_MK, CONTACT_TEMPERATURE_C, FRACTION, LATENT_HEAT_J_M3, LENGTH_UM,
    ZERO_CELSIUS_K, required, surface,
};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// The constants of the law.
pub(super) const CONSTANTS: [&str; 6] = [
    "molten_fraction",
    "latent_heat_j_m3",
    "heat_share",
    "oxide_conductivity_w_mk",
    "oxide_melting_temperature_c",
    "diffusion_distance_um",
];

/// Resolves the law of a specification beside a coefficient of friction.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    let own = ["law", "hardness_mpa", "contact_temperature_c"];
    let fields: Vec<&str> = own.iter().chain(&CONSTANTS).copied().collect();
    diagnostics.check_fields(&side.pointer, given, &fields, "severe_oxidation");
    let mut filled = given.clone();
    let surface = surface(side, given, &mut filled, diagnostics);
    let law = constants(side, given, friction, diagnostics);
    let law =
        surface.map(|surface| scene::WearLaw::OfSpeed(SpeedLaw::SevereOxidation(law(surface))));
    (filled, law)
}

/// The law by its surface, beside a coefficient of friction.
pub(super) fn constants(
    side: &WearingSide<'_>,
    given: &WearLaw,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> impl Fn(SurfaceState) -> SevereOxidation + use<> {
    let mut constant = |field, value, range| required(side, (field, value), range, diagnostics);
    let molten_fraction = constant("molten_fraction", given.molten_fraction, &FRACTION);
    let latent_heat_j_m3 = constant(
        "latent_heat_j_m3",
        given.latent_heat_j_m3,
        &LATENT_HEAT_J_M3,
    );
    let heat_share = constant("heat_share", given.heat_share, &FRACTION);
    let conductivity_w_mk = constant(
        "oxide_conductivity_w_mk",
        given.oxide_conductivity_w_mk,
        &CONDUCTIVITY_W_MK,
    );
    let melting_c = constant(
        "oxide_melting_temperature_c",
        given.oxide_melting_temperature_c,
        &CONTACT_TEMPERATURE_C,
    );
    let diffusion_um = constant(
        "diffusion_distance_um",
        given.diffusion_distance_um,
        &LENGTH_UM,
    );
    let bulk = given.contact_temperature_c.unwrap_or(side.surroundings_c);
    if given
        .oxide_melting_temperature_c
        .is_some_and(|melting| melting <= bulk)
    {
        let detail = format!("{bulk} is not below the {melting_c} at which the oxide melts");
        diagnostics.fault(&side.field("contact_temperature_c"), detail);
    }
    move |surface| SevereOxidation {
        molten_fraction,
        latent_heat_j_m3,
        heat_share,
        friction,
        conductivity_w_mk,
        melting_k: melting_c + ZERO_CELSIUS_K,
        diffusion_um,
        surface,
    }
}
