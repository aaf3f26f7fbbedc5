//! Friction and wear, one file a law.

mod archard;
mod coulomb;
mod frictionless;
mod wearing_side;

use api::spec::{
    Friction, FrictionLaw, Interface, Material, Materials, Provenance, Sides, WearLaw, WearLawName,
};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::Sourced;
use crate::spec::system::{ArchardPreset, Preset};
use wearing_side::WearingSide;

const FRICTION: &str = "/interface/friction";

/// The engine's laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Laws {
    pub(crate) friction: scene::Friction,
    pub(crate) slider: Option<scene::WearLaw>,
    pub(crate) receptacle: Option<scene::WearLaw>,
}

/// Resolves friction and wear. `materials` as given, `resolved` with their properties.
pub(crate) fn resolve(
    given: &Interface,
    materials: &Materials,
    resolved: &Materials,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> (Interface, Laws) {
    let (friction, friction_law) = friction(given, materials, preset, diagnostics);
    let slider = WearingSide {
        pointer: "/interface/wear/slider",
        given: materials.slider.as_ref(),
        resolved: resolved.slider.as_ref(),
    };
    let receptacle = WearingSide {
        pointer: "/interface/wear/receptacle",
        given: materials.receptacle.as_ref(),
        resolved: resolved.receptacle.as_ref(),
    };
    let wear = &given.wear;
    let (slider, slider_law) = self::wear(
        &slider,
        wear.slider.as_ref(),
        preset.slider_wear,
        diagnostics,
    );
    let (receptacle, receptacle_law) = self::wear(
        &receptacle,
        wear.receptacle.as_ref(),
        preset.receptacle_wear,
        diagnostics,
    );
    let interface = Interface {
        friction: Some(friction),
        wear: Sides {
            slider: Some(slider),
            receptacle: Some(receptacle),
        },
    };
    let laws = Laws {
        friction: friction_law,
        slider: slider_law,
        receptacle: receptacle_law,
    };
    (interface, laws)
}

fn friction(
    given: &Interface,
    materials: &Materials,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> (Friction, scene::Friction) {
    let Some(given) = &given.friction else {
        let is_preset = |given: Option<&Material>, name: &str| {
            given.is_none_or(|given| matches!(given, Material::Named(given) if given == name))
        };
        // The preset's coefficient belongs to the preset's pair of materials.
        let preset_pair = is_preset(materials.slider.as_ref(), preset.slider.value)
            && is_preset(materials.receptacle.as_ref(), preset.receptacle.value);
        let provenance = if preset_pair {
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
    diagnostics.provenance(side.pointer, unworn);
    (None, None)
}
