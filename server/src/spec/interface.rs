//! Friction and wear laws.

use api::spec::{
    Friction, FrictionLaw, Interface, Material, Materials, Provenance, Sides, WearLaw, WearLawName,
};
use solver::scene;

use crate::reference::materials::LibraryMaterial;
use crate::reference::presets::{Known, Preset};
use crate::spec::diagnostics::{Diagnostics, Range};
use crate::spec::materials::HARDNESS_MPA;

/// Coefficient of friction, -; the highest of clean metals in air stay below 2.
const FRICTION: Range = Range { from: 0.0, to: 2.0 };
/// Wear coefficient k, -: from a perfect film (1e-12) to certain removal.
const ARCHARD_K: Range = Range { from: 0.0, to: 1.0 };
/// k/H, 1/MPa.
const K_OVER_H_PER_MPA: Range = Range { from: 0.0, to: 1.0 };

/// The engine's laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Laws {
    pub(crate) friction: scene::Friction,
    pub(crate) slider: Option<scene::WearLaw>,
    pub(crate) receptacle: Option<scene::WearLaw>,
}

/// Fills in friction and wear. `materials` as given, `resolved` with their properties.
pub(crate) fn resolve(
    given: &Interface,
    materials: &Materials,
    resolved: &Materials,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> (Interface, Laws) {
    let own = |given: Option<&Material>, name: &str| {
        given.is_none_or(|given| matches!(given, Material::Named(own) if own == name))
    };
    let preset_pair = own(materials.slider.as_ref(), preset.slider.value)
        && own(materials.receptacle.as_ref(), preset.receptacle.value);
    let (friction, friction_law) =
        friction(given.friction.as_ref(), preset, preset_pair, diagnostics);
    let slider = Side {
        pointer: "/interface/wear/slider",
        given: given.wear.slider.as_ref(),
        material: materials.slider.as_ref(),
        resolved: resolved.slider.as_ref(),
        preset: preset.slider_wear,
    };
    let receptacle = Side {
        pointer: "/interface/wear/receptacle",
        given: given.wear.receptacle.as_ref(),
        material: materials.receptacle.as_ref(),
        resolved: resolved.receptacle.as_ref(),
        preset: Known {
            value: Some(preset.receptacle_wear.value),
            from: preset.receptacle_wear.from,
        },
    };
    let (slider, slider_law) = slider.resolve(diagnostics);
    let (receptacle, receptacle_law) = receptacle.resolve(diagnostics);
    let wear = Sides {
        slider: Some(slider),
        receptacle: Some(receptacle),
    };
    let laws = Laws {
        friction: friction_law,
        slider: slider_law,
        receptacle: receptacle_law,
    };
    (
        Interface {
            friction: Some(friction),
            wear,
        },
        laws,
    )
}

fn friction(
    given: Option<&Friction>,
    preset: &Preset,
    preset_pair: bool,
    diagnostics: &mut Diagnostics,
) -> (Friction, scene::Friction) {
    let Some(given) = given else {
        let coefficient = preset.friction.value;
        // The preset's coefficient belongs to the preset's pair of materials.
        let from = if preset_pair {
            preset.friction.from
        } else {
            Provenance::Assumed
        };
        diagnostics.note("/interface/friction/law", from);
        diagnostics.note("/interface/friction/coefficient", from);
        let filled = Friction {
            law: FrictionLaw::Coulomb.into(),
            coefficient: Some(coefficient),
        };
        return (filled, scene::Friction::Coulomb { coefficient });
    };
    let law = diagnostics.known("/interface/friction/law", &given.law);
    diagnostics.note("/interface/friction/law", Provenance::Given);
    let law = match (law, given.coefficient) {
        (Some(FrictionLaw::Coulomb), Some(coefficient)) => {
            diagnostics.check("/interface/friction/coefficient", coefficient, FRICTION);
            diagnostics.note("/interface/friction/coefficient", Provenance::Given);
            scene::Friction::Coulomb { coefficient }
        }
        (Some(FrictionLaw::Coulomb), None) => {
            diagnostics.missing("/interface/friction/coefficient", "`coulomb` needs it");
            scene::Friction::Frictionless
        }
        (Some(FrictionLaw::Frictionless), coefficient) => {
            diagnostics.misplaced(
                "/interface/friction",
                &[("coefficient", coefficient.is_some())],
                "frictionless",
            );
            scene::Friction::Frictionless
        }
        (None, _) => scene::Friction::Frictionless,
    };
    (given.clone(), law)
}

/// One side's wear on its way.
struct Side<'a> {
    pointer: &'static str,
    given: Option<&'a Option<WearLaw>>,
    material: Option<&'a Material>,
    resolved: Option<&'a Material>,
    preset: Known<Option<(f64, f64)>>,
}

impl Side<'_> {
    fn resolve(&self, diagnostics: &mut Diagnostics) -> (Option<WearLaw>, Option<scene::WearLaw>) {
        match self.given {
            Some(None) => {
                diagnostics.note(self.pointer, Provenance::Given);
                (None, None)
            }
            Some(Some(law)) => self.stated(law, diagnostics),
            None => self.left_out(diagnostics),
        }
    }

    /// The preset's law; where the user chose another material of the library, that material's k and hardness.
    fn left_out(&self, diagnostics: &mut Diagnostics) -> (Option<WearLaw>, Option<scene::WearLaw>) {
        let Some((mut k, mut hardness)) = self.preset.value else {
            diagnostics.note(self.pointer, self.preset.from);
            return (None, None);
        };
        // The preset's figures belong to the preset's material; beside another one they are a guess.
        let from = if self.material.is_some() {
            Provenance::Assumed
        } else {
            self.preset.from
        };
        let (mut k_from, mut hardness_from) = (from, from);
        if let Some(own) = self.own_hardness() {
            (hardness, hardness_from) = own;
        }
        if let Some(listed) = self.library().and_then(|material| material.archard_k) {
            (k, k_from) = (listed, Provenance::Source);
        }
        diagnostics.note(format!("{}/law", self.pointer), self.preset.from);
        diagnostics.note(format!("{}/k", self.pointer), k_from);
        diagnostics.note(format!("{}/hardness_mpa", self.pointer), hardness_from);
        let law = WearLaw {
            law: WearLawName::Archard.into(),
            k: Some(k),
            hardness_mpa: Some(hardness),
            k_over_h_per_mpa: None,
        };
        (Some(law), Some(archard(k / hardness)))
    }

    fn stated(
        &self,
        given: &WearLaw,
        diagnostics: &mut Diagnostics,
    ) -> (Option<WearLaw>, Option<scene::WearLaw>) {
        let place = |field: &str| format!("{}/{field}", self.pointer);
        diagnostics.note(place("law"), Provenance::Given);
        let mut law = given.clone();
        if diagnostics.known(&place("law"), &given.law).is_none() {
            return (Some(law), None);
        }
        let k_over_h = match (given.k, given.k_over_h_per_mpa) {
            (Some(_), Some(_)) => {
                diagnostics.fault(
                    &place("k_over_h_per_mpa"),
                    "stands beside `k`; write one of them",
                );
                None
            }
            (None, None) => {
                diagnostics.missing(
                    &place("k"),
                    "write `k` and `hardness_mpa`, or `k_over_h_per_mpa`",
                );
                None
            }
            (None, Some(ratio)) => {
                diagnostics.misplaced(
                    self.pointer,
                    &[("hardness_mpa", given.hardness_mpa.is_some())],
                    "k_over_h_per_mpa",
                );
                diagnostics.note(place("k_over_h_per_mpa"), Provenance::Given);
                Some(diagnostics.check(&place("k_over_h_per_mpa"), ratio, K_OVER_H_PER_MPA))
            }
            (Some(k), None) => {
                diagnostics.note(place("k"), Provenance::Given);
                diagnostics.check(&place("k"), k, ARCHARD_K);
                law.hardness_mpa = self.hardness(given, diagnostics);
                law.hardness_mpa.map(|hardness| k / hardness)
            }
        };
        (Some(law), k_over_h.map(archard))
    }

    /// The hardness beside a stated k: stated too, or the material's.
    fn hardness(&self, given: &WearLaw, diagnostics: &mut Diagnostics) -> Option<f64> {
        let place = format!("{}/hardness_mpa", self.pointer);
        let of_material = match self.resolved {
            Some(Material::Given(properties)) => properties.hardness_mpa,
            _ => None,
        };
        match given.hardness_mpa {
            Some(hardness) => {
                diagnostics.note(&place, Provenance::Given);
                Some(diagnostics.check(&place, hardness, HARDNESS_MPA))
            }
            None if of_material.is_some() => {
                diagnostics.note(&place, Provenance::Typical);
                of_material
            }
            None => {
                diagnostics.missing(&place, "neither the law nor the material states a hardness");
                None
            }
        }
    }

    fn library(&self) -> Option<&'static LibraryMaterial> {
        match self.material {
            Some(Material::Named(name)) => LibraryMaterial::named(name),
            _ => None,
        }
    }

    fn own_hardness(&self) -> Option<(f64, Provenance)> {
        match self.material? {
            Material::Named(_) => self
                .library()
                .map(|material| (material.hardness_mpa, material.hardness_from)),
            Material::Given(properties) => properties
                .hardness_mpa
                .map(|hardness| (hardness, Provenance::Given)),
        }
    }
}

fn archard(k_over_h_per_mpa: f64) -> scene::WearLaw {
    scene::WearLaw::Archard { k_over_h_per_mpa }
}
