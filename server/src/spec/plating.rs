//! Platings: layers with their materials, thicknesses and wear laws.

use std::ops::RangeInclusive;

use api::spec::{Material, PlatingLayer, Platings, Provenance, WearLaw, WearLawName};
use solver::law::softening::REFERENCE_C;
use solver::scene::{self, Layer, MOST_LAYERS};
use solver::sides::Sides;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;
use crate::spec::law::{self, ByFriction, definition};
use crate::spec::materials;
use crate::spec::plating_choice::{self, PlatingChoice};
use crate::spec::system::LayerPreset;
use crate::spec::unit;

/// From a flash of some atoms to a clad inlay, um and mm.
pub(in crate::spec) const THICKNESS_UM: RangeInclusive<f64> = 1e-3..=1e3;
pub(in crate::spec) const THICKNESS_MM: RangeInclusive<f64> = 1e-6..=1.0;

/// The layers of both parts of a specification.
pub(super) fn by_side(platings: &Platings) -> Sides<&[PlatingLayer]> {
    plating_choice::given(platings).map(Option::unwrap_or_default)
}

/// Resolves the platings of both parts beside a coefficient of friction.
pub(super) fn resolve(
    plating_choices: Sides<PlatingChoice<'_>>,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (Platings, Sides<Vec<Layer>>) {
    let resolved = Sides::from_fn(|side| {
        let pointer = format!("/plating/{}", side.name());
        match *plating_choices.of(side) {
            PlatingChoice::Bare => (None, Vec::new()),
            PlatingChoice::Removed => {
                diagnostics.provenance(&pointer, Provenance::Given);
                (Some(Vec::new()), Vec::new())
            }
            PlatingChoice::Given(layers) => {
                diagnostics.check_length(&pointer, layers.len(), MOST_LAYERS);
                let layers = layers.iter().take(MOST_LAYERS).enumerate();
                let resolved = layers.map(|(index, given)| {
                    layer(&format!("{pointer}/{index}"), given, friction, diagnostics)
                });
                side_of(resolved)
            }
            PlatingChoice::Preset(layers) => {
                let layers = layers.iter().enumerate();
                let resolved = layers.map(|(index, preset)| {
                    let pointer = format!("{pointer}/{index}");
                    preset_layer(&pointer, preset, friction, diagnostics)
                });
                side_of(resolved)
            }
        }
    });
    let (slider, slider_layers) = resolved.slider;
    let (receptacle, receptacle_layers) = resolved.receptacle;
    let layers = Sides {
        slider: slider_layers,
        receptacle: receptacle_layers,
    };
    (Platings { slider, receptacle }, layers)
}

/// The layers of a side, filled in and as the engine takes them.
fn side_of(
    resolved: impl Iterator<Item = (PlatingLayer, Option<Layer>)>,
) -> (Option<Vec<PlatingLayer>>, Vec<Layer>) {
    let (filled, layers): (Vec<_>, Vec<_>) = resolved.unzip();
    (Some(filled), layers.into_iter().flatten().collect())
}

/// A layer of a preset, as a specification would write it, with the provenance of each value.
fn preset_layer(
    pointer: &str,
    preset: &LayerPreset,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (PlatingLayer, Option<Layer>) {
    let LayerPreset {
        material,
        thickness_um,
        k,
    } = *preset;
    let written = PlatingLayer {
        material: Some(Material::Named(material.value.to_owned())),
        thickness_um: Some(thickness_um.value),
        thickness_mm: None,
        friction_coefficient: None,
        wear: Some(WearLaw {
            k: Some(k.value),
            ..WearLaw::of(WearLawName::Archard)
        }),
    };
    let layer = layer(pointer, &written, friction, diagnostics);
    for (field, provenance) in [
        ("material/name", material.provenance),
        ("thickness_um", thickness_um.provenance),
        ("wear/law", k.provenance),
        ("wear/k", k.provenance),
    ] {
        diagnostics.provenance(format!("{pointer}/{field}"), provenance);
    }
    layer
}

fn layer(
    pointer: &str,
    given: &PlatingLayer,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (PlatingLayer, Option<Layer>) {
    let thickness_mm = thickness_mm(pointer, given, diagnostics);
    let material = material(&format!("{pointer}/material"), given, diagnostics);
    let side = WearingSide {
        pointer: format!("{pointer}/wear"),
        given: given.material.as_ref(),
        resolved: material.as_ref(),
        wears_as: given.material.as_ref(),
        // Layers wear by laws that do not depend on it.
        surroundings_c: REFERENCE_C,
    };
    let (wear, law) = wear(&side, given.wear.as_ref(), friction, diagnostics);
    law::check_plated(&side.pointer, law, diagnostics);
    let rate = law.and_then(scene::WearLaw::uniform);
    if rate.is_some_and(|rate| rate <= 0.0) {
        let of_friction = |law: &WearLaw| {
            let name = law.law.known();
            name.is_some_and(|name| definition(name).friction == ByFriction::Proportional)
        };
        if friction <= 0.0 && wear.as_ref().is_some_and(of_friction) {
            let detail = "without friction the layers of this law do not wear";
            diagnostics.fault("/interface/friction", detail);
        } else {
            let detail = "a layer that does not wear protects all below it; leave these out";
            diagnostics.fault(&side.pointer, detail);
        }
    }
    let layer = thickness_mm
        .zip(rate)
        .map(|(thickness_mm, rate_per_mpa)| Layer {
            thickness_mm,
            rate_per_mpa,
        });
    let filled = PlatingLayer {
        material,
        wear,
        ..given.clone()
    };
    (filled, layer)
}

fn thickness_mm(pointer: &str, given: &PlatingLayer, diagnostics: &mut Diagnostics) -> Option<f64> {
    let (um, mm) = (
        format!("{pointer}/thickness_um"),
        format!("{pointer}/thickness_mm"),
    );
    match (given.thickness_um, given.thickness_mm) {
        (Some(_), Some(_)) => {
            diagnostics.exclusive_fields(&mm, "thickness_um");
            None
        }
        (None, None) => {
            diagnostics.missing(&um, "the thickness of the layer");
            None
        }
        (Some(thickness), None) => {
            diagnostics.provenance(&um, Provenance::Given);
            diagnostics.check_unit(&um, Some(thickness), &unit::LAYER_UM);
            Some(1e-3 * diagnostics.check_range(&um, thickness, &THICKNESS_UM))
        }
        (None, Some(thickness)) => {
            diagnostics.provenance(&mm, Provenance::Given);
            diagnostics.check_unit(&mm, Some(thickness), &unit::LAYER_MM);
            Some(diagnostics.check_range(&mm, thickness, &THICKNESS_MM))
        }
    }
}

fn material(
    pointer: &str,
    given: &PlatingLayer,
    diagnostics: &mut Diagnostics,
) -> Option<Material> {
    let Some(given) = &given.material else {
        diagnostics.missing(pointer, "the material of the layer");
        return None;
    };
    let properties = materials::properties(pointer, given, diagnostics);
    Some(Material::Given(Box::new(properties)))
}

fn wear(
    side: &WearingSide<'_>,
    given: Option<&WearLaw>,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (Option<WearLaw>, Option<scene::WearLaw>) {
    if let Some(given) = given {
        let (filled, law) = law::given_wear(side, given, friction, diagnostics);
        return (Some(filled), law);
    }
    let Some((filled, law)) = law::listed_wear(side, diagnostics) else {
        let detail = "no published wear coefficient of this material is in the library; measure it, or write any value and let \
                      `fretwear calibrate` scale it to a rated number of cycles";
        diagnostics.missing(&side.pointer, detail);
        return (None, None);
    };
    (Some(filled), Some(law))
}

#[cfg(test)]
mod tests;
