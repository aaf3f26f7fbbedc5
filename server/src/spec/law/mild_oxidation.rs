//! Mild oxidational wear at moderate speeds.

use api::spec::WearLaw;
use solver::scene::{self, MildOxidation, SpeedLaw, SurfaceState};

use super::oxidation::{
    ACTIVATION_ENERGY_J_MOL, ARRHENIUS_CONSTANT, CONSTANT, LENGTH_UM, required, surface,
};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;

/// The constants of the law.
pub(super) const CONSTANTS: [&str; 4] = [
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
    let own = ["law", "hardness_mpa", "contact_temperature_c"];
    let fields: Vec<&str> = own.iter().chain(&CONSTANTS).copied().collect();
    diagnostics.check_fields(&side.pointer, given, &fields, "mild_oxidation");
    let mut filled = given.clone();
    let surface = surface(side, given, &mut filled, diagnostics);
    let law = constants(side, given, diagnostics);
    let law = surface.map(|surface| scene::WearLaw::OfSpeed(SpeedLaw::MildOxidation(law(surface))));
    (filled, law)
}

/// The law by its surface.
pub(super) fn constants(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> impl Fn(SurfaceState) -> MildOxidation + use<> {
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
    move |surface| MildOxidation {
        constant: c,
        arrhenius_m2_s,
        activation_j_mol,
        film_um,
        surface,
    }
}
