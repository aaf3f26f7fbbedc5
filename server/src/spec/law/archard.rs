//! Archard's wear law: worn depth = (k/H) p |slip|.

use api::spec::{Material, Provenance, WearLaw, WearLawName};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wear_coefficient;
use crate::spec::law::wearing_side::WearingSide;
use crate::spec::system::ArchardPreset;

/// The fields of the law.
const FIELDS: [&str; 4] = ["law", "k", "hardness_mpa", "k_over_h_per_mpa"];

/// Resolves the law of a specification.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "archard");
    let (filled, k_over_h) = wear_coefficient::resolve(side, given, diagnostics);
    let law = k_over_h.map(|k_over_h_per_mpa| scene::WearLaw::Archard { k_over_h_per_mpa });
    (filled, law)
}

/// The law of a preset; beside another material than the preset's, with that material's hardness and, where the library
/// lists one, its k.
pub(super) fn from_preset(
    side: &WearingSide<'_>,
    preset: ArchardPreset,
    provenance: Provenance,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, scene::WearLaw) {
    // The preset's values were chosen for the preset's material.
    let provenance = match side.given {
        Some(_) => Provenance::Assumed,
        None => provenance,
    };
    let library = side.library();
    let (k, k_provenance) = match library.and_then(|material| material.archard_k) {
        Some(listed) => (listed, Provenance::Source),
        None => (preset.k, provenance),
    };
    let (own_hardness, own_provenance) = match (side.given, library) {
        (Some(Material::Given(properties)), _) => (properties.hardness_mpa, Provenance::Given),
        (_, Some(listed)) => (listed.properties.hardness_mpa, listed.hardness_provenance),
        (_, None) => (None, provenance),
    };
    let (hardness, hardness_provenance) = match own_hardness {
        Some(hardness) => (hardness, own_provenance),
        None => (preset.hardness_mpa, provenance),
    };
    diagnostics.provenance(side.field("k"), k_provenance);
    diagnostics.provenance(side.field("hardness_mpa"), hardness_provenance);
    let filled = WearLaw {
        k: Some(k),
        hardness_mpa: Some(hardness),
        ..WearLaw::of(WearLawName::Archard)
    };
    let k_over_h_per_mpa = k / hardness;
    (filled, scene::WearLaw::Archard { k_over_h_per_mpa })
}
