//! Mild oxidational wear at moderate speeds.

use api::spec::WearLaw;
use solver::scene::{self, MildOxidation, SpeedLaw};

use super::oxidation::{
    ACTIVATION_ENERGY_J_MOL, ARRHENIUS_CONSTANT, CONSTANT, LENGTH_UM, required, surface,
};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 7] = [
    "law",
    "hardness_mpa",
    "contact_temperature_c",
    "activation_energy_j_mol",
    "critical_film_um",
    "arrhenius_constant_m2_s",
    "oxidation_constant",
];

/// Resolves the law of a specification.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "mild_oxidation");
    let mut filled = given.clone();
    let (hardness, temperature_k) = surface(side, given, &mut filled, diagnostics);
    let mut constant = |field, value, range| required(side, (field, value), range, diagnostics);
    let c = constant("oxidation_constant", given.oxidation_constant, &CONSTANT);
    let arrhenius_m2_s = constant(
        "arrhenius_constant_m2_s",
        given.arrhenius_constant_m2_s,
        &ARRHENIUS_CONSTANT,
    );
    let activation_j_mol = constant(
        "activation_energy_j_mol",
        given.activation_energy_j_mol,
        &ACTIVATION_ENERGY_J_MOL,
    );
    let film_um = constant("critical_film_um", given.critical_film_um, &LENGTH_UM);
    let law = hardness.map(|hardness_mpa| {
        scene::WearLaw::OfSpeed(SpeedLaw::MildOxidation(MildOxidation {
            constant: c,
            arrhenius_m2_s,
            activation_j_mol,
            temperature_k,
            film_um,
            hardness_mpa,
        }))
    });
    (filled, law)
}
