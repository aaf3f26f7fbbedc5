//! Quinn's law of mild oxidational wear.

use api::spec::WearLaw;
use solver::scene::{self, Quinn, SpeedLaw};

use super::oxidation::{
    ACTIVATION_ENERGY_J_MOL, ARRHENIUS_CONSTANT, FRACTION, LENGTH_UM, OXIDE_DENSITY_KG_M3,
    required, surface,
};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 9] = [
    "law",
    "hardness_mpa",
    "contact_temperature_c",
    "activation_energy_j_mol",
    "critical_film_um",
    "asperity_diameter_um",
    "arrhenius_constant_kg2_m4s",
    "oxide_density_kg_m3",
    "oxygen_fraction",
];

/// Resolves the law of a specification.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "quinn");
    let mut filled = given.clone();
    let surface = surface(side, given, &mut filled, diagnostics);
    let mut constant = |field, value, range| required(side, (field, value), range, diagnostics);
    let asperity_um = constant(
        "asperity_diameter_um",
        given.asperity_diameter_um,
        &LENGTH_UM,
    );
    let arrhenius_kg2_m4s = constant(
        "arrhenius_constant_kg2_m4s",
        given.arrhenius_constant_kg2_m4s,
        &ARRHENIUS_CONSTANT,
    );
    let activation_j_mol = constant(
        "activation_energy_j_mol",
        given.activation_energy_j_mol,
        &ACTIVATION_ENERGY_J_MOL,
    );
    let film_um = constant("critical_film_um", given.critical_film_um, &LENGTH_UM);
    let oxide_density_kg_m3 = constant(
        "oxide_density_kg_m3",
        given.oxide_density_kg_m3,
        &OXIDE_DENSITY_KG_M3,
    );
    let oxygen_fraction = constant("oxygen_fraction", given.oxygen_fraction, &FRACTION);
    let law = surface.map(|surface| {
        scene::WearLaw::OfSpeed(SpeedLaw::Quinn(Quinn {
            asperity_um,
            arrhenius_kg2_m4s,
            activation_j_mol,
            film_um,
            oxide_density_kg_m3,
            oxygen_fraction,
            surface,
        }))
    });
    (filled, law)
}
