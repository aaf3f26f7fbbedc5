//! Constants of the oxidational wear laws; all of them are required from the user. Published are those of steels alone.

use std::ops::RangeInclusive;

use api::spec::WearLaw;
use solver::scene::{SurfaceState, Temperature};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wear_coefficient;
use crate::spec::law::wearing_side::WearingSide;

/// Kelvin at 0 °C.
pub(super) const ZERO_CELSIUS_K: f64 = 273.15;

/// °C: asperities from the coldest surroundings to where every oxide melts.
pub(in crate::spec) const CONTACT_TEMPERATURE_C: RangeInclusive<f64> = -273.0..=3_000.0;
/// J/mol; those of diffusion in oxides are 1e5 to 3e5.
pub(in crate::spec) const ACTIVATION_ENERGY_J_MOL: RangeInclusive<f64> = 1e3..=1e6;
/// um, from some atoms to beyond any oxide that holds together; also lengths of asperities and of the diffusion of heat.
pub(in crate::spec) const LENGTH_UM: RangeInclusive<f64> = 1e-3..=1e4;
/// Arrhenius constants, in their units: that of steels changes by eight orders of magnitude from oxide to oxide.
pub(in crate::spec) const ARRHENIUS_CONSTANT: RangeInclusive<f64> = 1e-20..=1e20;
/// kg/m^3, of oxides.
pub(in crate::spec) const OXIDE_DENSITY_KG_M3: RangeInclusive<f64> = 1e3..=2e4;
/// mm/s, of the transition from Archard's law: from creep to beyond any sliding contact.
pub(in crate::spec) const TRANSITION_SPEED_MM_S: RangeInclusive<f64> = 1e-3..=1e6;
/// Fractions and shares, -.
pub(in crate::spec) const FRACTION: RangeInclusive<f64> = 1e-6..=1.0;
/// The constant C, -.
pub(in crate::spec) const CONSTANT: RangeInclusive<f64> = 1e-12..=1e3;
/// J/m^3; a metre of ice and of the most refractory oxide are 3e8 and 1e10.
pub(in crate::spec) const LATENT_HEAT_J_M3: RangeInclusive<f64> = 1e7..=1e11;
/// W/(m K).
pub(in crate::spec) const CONDUCTIVITY_W_MK: RangeInclusive<f64> = 1e-3..=1e3;

/// A required constant.
pub(super) fn required(
    side: &WearingSide<'_>,
    (field, value): (&str, Option<f64>),
    range: &RangeInclusive<f64>,
    diagnostics: &mut Diagnostics,
) -> f64 {
    let needs =
        "the oxidational laws have no default constants: published are those of steels alone";
    diagnostics.required(&side.field(field), value, range, needs)
}

/// The surface with its hardness, given or the material's, and its temperature; `None` without a hardness.
pub(super) fn surface(
    side: &WearingSide<'_>,
    given: &WearLaw,
    filled: &mut WearLaw,
    diagnostics: &mut Diagnostics,
) -> Option<SurfaceState> {
    filled.hardness_mpa = wear_coefficient::hardness(side, given, diagnostics);
    let temperature = temperature(side, given, diagnostics);
    filled.hardness_mpa.map(|hardness_mpa| SurfaceState {
        hardness_mpa,
        temperature,
    })
}

/// The temperature of the contact as given, or that of the surroundings, over which friction and current heat it.
pub(super) fn temperature(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> Temperature {
    let pointer = side.field("contact_temperature_c");
    let celsius = diagnostics.optional(
        &pointer,
        given.contact_temperature_c,
        &CONTACT_TEMPERATURE_C,
    );
    celsius.map_or(
        Temperature::OfSurroundings(side.surroundings_c + ZERO_CELSIUS_K),
        |celsius| Temperature::OfContact(celsius + ZERO_CELSIUS_K),
    )
}
