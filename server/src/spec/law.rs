//! Friction and wear, one file a law.

mod archard;
mod coulomb;
mod frictionless;

use api::spec::{
    Friction, FrictionLaw, Interface, Material, Materials, Provenance, Sides, WearLaw, WearLawName,
};
use solver::scene;

use crate::reference::materials::LibraryMaterial;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::Sourced;
use crate::spec::system::{ArchardPreset, Preset};

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
    let (slider, slider_law) = slider.wear(wear.slider.as_ref(), preset.slider_wear, diagnostics);
    let (receptacle, receptacle_law) = receptacle.wear(
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

/// A side with its material as given and as resolved.
struct WearingSide<'a> {
    pointer: &'static str,
    given: Option<&'a Material>,
    resolved: Option<&'a Material>,
}

impl WearingSide<'_> {
    fn wear(
        &self,
        given: Option<&Option<WearLaw>>,
        preset: Sourced<Option<ArchardPreset>>,
        diagnostics: &mut Diagnostics,
    ) -> (Option<WearLaw>, Option<scene::WearLaw>) {
        let unworn = match (given, preset.value) {
            (Some(Some(given)), _) => {
                let law = diagnostics.enum_member(&self.field("law"), &given.law);
                diagnostics.provenance(self.field("law"), Provenance::Given);
                let (filled, law) = match law {
                    Some(WearLawName::Archard) => archard::resolve(self, given, diagnostics),
                    None => (given.clone(), None),
                };
                return (Some(filled), law);
            }
            (None, Some(law)) => {
                diagnostics.provenance(self.field("law"), preset.provenance);
                let (filled, law) = archard::from_preset(self, law, preset.provenance, diagnostics);
                return (Some(filled), Some(law));
            }
            (Some(None), _) => Provenance::Given,
            (None, None) => preset.provenance,
        };
        diagnostics.provenance(self.pointer, unworn);
        (None, None)
    }

    /// JSON pointer of a field of the law.
    fn field(&self, name: &str) -> String {
        format!("{}/{name}", self.pointer)
    }

    /// The material of the library that was named.
    fn library(&self) -> Option<&'static LibraryMaterial> {
        match self.given {
            Some(Material::Named(name)) => LibraryMaterial::named(name),
            _ => None,
        }
    }

    /// Hardness of the resolved material, MPa.
    fn hardness_mpa(&self) -> Option<f64> {
        match self.resolved {
            Some(Material::Given(properties)) => properties.hardness_mpa,
            _ => None,
        }
    }
}
