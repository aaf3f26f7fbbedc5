//! Archard's wear law: worn depth = (k/H) p |slip|.

use std::ops::RangeInclusive;

use api::spec::{Material, Provenance, WearLaw, WearLawName};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;
use crate::spec::materials::HARDNESS_MPA;
use crate::spec::system::ArchardPreset;
use crate::spec::unit;

/// The fields of the law.
const FIELDS: [&str; 4] = ["law", "k", "hardness_mpa", "k_over_h_per_mpa"];

/// Wear coefficient k, -: from a perfect film (1e-12) to certain removal.
pub(in crate::spec) const K: RangeInclusive<f64> = 0.0..=1.0;
/// k/H, 1/MPa.
pub(in crate::spec) const K_OVER_H_PER_MPA: RangeInclusive<f64> = 0.0..=1.0;

/// Resolves the law of a specification.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "archard");
    let mut filled = given.clone();
    let k_over_h = match (given.k, given.k_over_h_per_mpa) {
        (Some(_), Some(_)) => {
            diagnostics.exclusive_fields(&side.field("k_over_h_per_mpa"), "k");
            None
        }
        (None, None) => {
            let detail = "write `k` and `hardness_mpa`, or `k_over_h_per_mpa`";
            diagnostics.missing(&side.field("k"), detail);
            None
        }
        (None, Some(ratio)) => {
            if given.hardness_mpa.is_some() {
                diagnostics.foreign_field(&side.pointer, "hardness_mpa", "k_over_h_per_mpa");
            }
            let pointer = side.field("k_over_h_per_mpa");
            diagnostics.provenance(&pointer, Provenance::Given);
            diagnostics.check_unit(&pointer, Some(ratio), &unit::K_OVER_H_PER_MPA);
            Some(diagnostics.check_range(&pointer, ratio, &K_OVER_H_PER_MPA))
        }
        (Some(k), None) => {
            diagnostics.provenance(side.field("k"), Provenance::Given);
            diagnostics.check_range(&side.field("k"), k, &K);
            filled.hardness_mpa = hardness(side, given, diagnostics);
            filled.hardness_mpa.map(|hardness| k / hardness)
        }
    };
    let law = k_over_h.map(|k_over_h_per_mpa| scene::WearLaw::Archard { k_over_h_per_mpa });
    (filled, law)
}

/// The hardness beside a given k: given too, or the material's.
fn hardness(side: &WearingSide<'_>, given: &WearLaw, diagnostics: &mut Diagnostics) -> Option<f64> {
    let pointer = side.field("hardness_mpa");
    match (given.hardness_mpa, side.hardness_mpa()) {
        (Some(hardness), _) => {
            diagnostics.provenance(&pointer, Provenance::Given);
            diagnostics.check_unit(&pointer, Some(hardness), &unit::HARDNESS_MPA);
            Some(diagnostics.check_range(&pointer, hardness, &HARDNESS_MPA))
        }
        (None, Some(hardness)) => {
            diagnostics.provenance(&pointer, Provenance::Typical);
            Some(hardness)
        }
        (None, None) => {
            let detail = "neither the law nor the material states a hardness";
            diagnostics.missing(&pointer, detail);
            None
        }
    }
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
        law: WearLawName::Archard.into(),
        k: Some(k),
        hardness_mpa: Some(hardness),
        k_over_h_per_mpa: None,
    };
    let k_over_h_per_mpa = k / hardness;
    (filled, scene::WearLaw::Archard { k_over_h_per_mpa })
}
