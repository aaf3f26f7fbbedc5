//! Archard's wear law.

use api::spec::{Material, Provenance, WearLaw, WearLawName};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::definition::{ByFriction, LawDefinition};
use crate::spec::law::wear_coefficient::K_OVER_H;
use crate::spec::law::wearing_side::WearingSide;
use crate::spec::sourced::{Sourced, source, sourced};
use crate::spec::system::ArchardPreset;

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh = (k/H) p |ds|",
    states: &[],
    friction: ByFriction::Independent,
    groups: &[K_OVER_H],
    choices: &[],
    engine_law: |values| {
        Some(scene::WearLaw::Archard {
            k_over_h_per_mpa: values.k_over_h_per_mpa()?,
        })
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""k":0.002,"hardness_mpa":1700"#,
};

/// The coefficients that a side has where its specification gives none.
struct Defaults {
    k: Sourced<f64>,
    hardness_mpa: Sourced<f64>,
}

/// Coefficients of a preset; beside another material than the preset's, the hardness of that material and its k, where the library lists
/// one.
fn defaults(side: &WearingSide<'_>, preset: Sourced<ArchardPreset>) -> Defaults {
    let Sourced { value, provenance } = preset;
    // The preset's values were chosen for the preset's material.
    let provenance = match side.wears_as {
        Some(_) => Provenance::Assumed,
        None => provenance,
    };
    let k = match side.library().and_then(|material| material.archard_k) {
        Some(listed) => source(listed),
        None => sourced(value.k, provenance),
    };
    let changed = side.changed_hardness_mpa();
    let own_hardness = match (side.wears_as, side.library()) {
        _ if changed.is_some() => changed.map(|own| sourced(own, Provenance::Given)),
        (Some(Material::Given(properties)), _) => properties
            .hardness_mpa
            .map(|own| sourced(own, Provenance::Given)),
        (_, Some(listed)) => {
            let own = listed.properties.hardness_mpa;
            own.map(|own| sourced(own, listed.hardness_provenance))
        }
        (_, None) => None,
    };
    Defaults {
        k,
        hardness_mpa: own_hardness.unwrap_or(sourced(value.hardness_mpa, provenance)),
    }
}

/// The law of a preset.
pub(super) fn from_preset(
    side: &WearingSide<'_>,
    preset: Sourced<ArchardPreset>,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, scene::WearLaw) {
    let Defaults { k, hardness_mpa } = defaults(side, preset);
    diagnostics.provenance(side.field("law"), preset.provenance);
    diagnostics.provenance(side.field("k"), k.provenance);
    diagnostics.provenance(side.field("hardness_mpa"), hardness_mpa.provenance);
    let filled = WearLaw {
        k: Some(k.value),
        hardness_mpa: Some(hardness_mpa.value),
        ..WearLaw::of(WearLawName::Archard)
    };
    let k_over_h_per_mpa = k.value / hardness_mpa.value;
    (filled, scene::WearLaw::Archard { k_over_h_per_mpa })
}

/// A given law with the coefficients of a preset where it leaves them out; another law than the preset's is unchanged.
pub(super) fn completed(
    side: &WearingSide<'_>,
    given: &WearLaw,
    preset: Option<Sourced<ArchardPreset>>,
) -> Completed {
    let mut completed = Completed {
        law: given.clone(),
        defaults: Vec::new(),
    };
    let is_ratio = given.k_over_h_per_mpa.is_some();
    let Some(preset) = preset.filter(|_| given.law == WearLawName::Archard.into() && !is_ratio)
    else {
        return completed;
    };
    let Defaults { k, hardness_mpa } = defaults(side, preset);
    let WearLaw {
        k: own_k,
        hardness_mpa: own_hardness,
        ..
    } = &mut completed.law;
    for (field, own, default) in [
        ("k", own_k, k),
        ("hardness_mpa", own_hardness, hardness_mpa),
    ] {
        if own.is_none() {
            *own = Some(default.value);
            completed
                .defaults
                .push((side.field(field), default.provenance));
        }
    }
    completed
}

/// A law with defaults.
pub(super) struct Completed {
    pub(super) law: WearLaw,
    /// JSON pointers of the values that were left out, with their provenances.
    pub(super) defaults: Vec<(String, Provenance)>,
}
