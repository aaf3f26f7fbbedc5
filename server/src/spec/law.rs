//! Friction and wear, one file a law.

pub(super) mod archard;
pub(super) mod coulomb;
mod frictionless;
mod wearing_side;

use api::spec::{
    Friction, FrictionLaw, Interface, Material, Materials, Provenance, WearLaw, WearLawName,
};
use solver::scene;
use solver::sides::{Side, Sides};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::materials::by_side;
use crate::spec::sourced::Sourced;
use crate::spec::system::{ArchardPreset, Preset};
use wearing_side::WearingSide;

const FRICTION: &str = "/interface/friction";

/// The engine's laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Laws {
    pub(crate) friction: scene::Friction,
    pub(crate) wear: Sides<Option<scene::WearLaw>>,
}

/// Resolves friction and wear. `materials` as given, `resolved` with their properties.
pub(crate) fn resolve(
    given: &Interface,
    materials: &Materials,
    resolved: &Materials,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> (Interface, Laws) {
    let (materials, resolved) = (by_side(materials), by_side(resolved));
    let (friction, friction_law) = friction(given, materials, preset, diagnostics);
    let wear = Sides::from_fn(|at| {
        let law = match at {
            Side::Slider => given.wear.slider.as_ref(),
            Side::Receptacle => given.wear.receptacle.as_ref(),
        };
        let side = WearingSide {
            pointer: format!("/interface/wear/{}", at.name()),
            given: *materials.of(at),
            resolved: *resolved.of(at),
        };
        wear(&side, law, *preset.wear.of(at), diagnostics)
    });
    let (slider, slider_law) = wear.slider;
    let (receptacle, receptacle_law) = wear.receptacle;
    let interface = Interface {
        friction: Some(friction),
        wear: api::spec::Sides {
            slider: Some(slider),
            receptacle: Some(receptacle),
        },
    };
    let laws = Laws {
        friction: friction_law,
        wear: Sides {
            slider: slider_law,
            receptacle: receptacle_law,
        },
    };
    (interface, laws)
}

fn friction(
    given: &Interface,
    materials: Sides<Option<&Material>>,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> (Friction, scene::Friction) {
    let Some(given) = &given.friction else {
        let is_preset = |side| {
            let name = preset.materials.of(side).value;
            let given = materials.of(side);
            given.is_none_or(|given| matches!(given, Material::Named(given) if given == name))
        };
        // The preset's coefficient belongs to the preset's pair of materials.
        let provenance = if Side::BOTH.into_iter().all(is_preset) {
            preset.friction.provenance
        } else {
            Provenance::Assumed
        };
        return coulomb::from_preset(preset.friction.value, provenance, diagnostics);
    };
    let law = diagnostics.enum_member(&format!("{FRICTION}/law"), &given.law);
    diagnostics.provenance(format!("{FRICTION}/law"), Provenance::Given);
    let law = match law {
        Some(FrictionLaw::Coulomb) => coulomb::resolve(given, diagnostics),
        Some(FrictionLaw::Frictionless) => frictionless::resolve(given, diagnostics),
        None => scene::Friction::Frictionless,
    };
    (given.clone(), law)
}

/// Resolves the wear law of a side.
fn wear(
    side: &WearingSide<'_>,
    given: Option<&Option<WearLaw>>,
    preset: Sourced<Option<ArchardPreset>>,
    diagnostics: &mut Diagnostics,
) -> (Option<WearLaw>, Option<scene::WearLaw>) {
    let unworn = match (given, preset.value) {
        (Some(Some(given)), _) => {
            let law = diagnostics.enum_member(&side.field("law"), &given.law);
            diagnostics.provenance(side.field("law"), Provenance::Given);
            let (filled, law) = match law {
                Some(WearLawName::Archard) => archard::resolve(side, given, diagnostics),
                None => (given.clone(), None),
            };
            return (Some(filled), law);
        }
        (None, Some(law)) => {
            diagnostics.provenance(side.field("law"), preset.provenance);
            let (filled, law) = archard::from_preset(side, law, preset.provenance, diagnostics);
            return (Some(filled), Some(law));
        }
        (Some(None), _) => Provenance::Given,
        (None, None) => preset.provenance,
    };
    diagnostics.provenance(&side.pointer, unworn);
    (None, None)
}
