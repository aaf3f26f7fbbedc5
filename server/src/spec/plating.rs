//! Platings: layers with their materials, thicknesses and wear laws.

use std::ops::RangeInclusive;

use api::spec::{EnumValue, Material, PlatingLayer, Platings, Provenance, WearLaw, WearLawName};
use solver::law::softening::REFERENCE_C;
use solver::scene::{self, Layer, MOST_LAYERS};
use solver::sides::Sides;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law;
use crate::spec::law::wearing_side::WearingSide;
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
            matches!(
                law.law,
                EnumValue::Known(WearLawName::Saracibar | WearLawName::DissipatedEnergy)
            )
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
mod tests {
    use crate::spec::tests::{accepted as resolved, faults};

    const GOLD: &str =
        r#"{"material":"hard_gold","thickness_um":0.76,"wear":{"law":"archard","k":1e-4}}"#;

    fn plated(layers: &str, base: &str) -> String {
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[{layers}]}},"interface":{{"wear":{{{base}}}}}}}"#
        )
    }

    #[test]
    fn layers_take_their_hardness_from_their_material_and_their_law_from_the_library() {
        let silver = r#"{"material":"silver","thickness_mm":0.002}"#;
        let resolved = resolved(&plated(&format!("{GOLD},{silver}"), ""));
        let [gold, silver] = &resolved.scene.receptacle.plating[..] else {
            panic!("two layers");
        };
        assert!((gold.thickness_mm - 0.76e-3).abs() < 1e-18);
        assert!((gold.rate_per_mpa - 1e-4 / 1_700.0).abs() < 1e-20);
        assert!((silver.rate_per_mpa - 0.004 / 250.0).abs() < 1e-18);
        // The base below is copper, of which the library lists a coefficient, and not the preset's gold.
        let base = resolved
            .scene
            .receptacle
            .wear
            .and_then(solver::scene::WearLaw::uniform);
        assert!(
            base.is_some_and(|rate| (rate - 0.011 / 427.0).abs() < 1e-18),
            "{base:?}"
        );
        // Submitted again, the resolved specification is the same.
        let again = serde_json::to_string(&resolved.spec).expect("JSON");
        assert_eq!(crate::spec::tests::accepted(&again).scene, resolved.scene);
    }

    #[test]
    fn what_nobody_has_published_is_asked_for_by_name() {
        let pointers = |text: &str| -> Vec<String> {
            let found = faults(text).into_iter();
            found.map(|fault| fault.pointer).collect()
        };
        let bare = r#"{"material":"hard_gold"}"#;
        assert_eq!(
            pointers(&plated(bare, "")),
            [
                "/plating/receptacle/0/thickness_um",
                "/plating/receptacle/0/wear"
            ]
        );
        let both = r#"{"thickness_um":1.0,"thickness_mm":0.001}"#;
        assert_eq!(
            pointers(&plated(both, "")),
            [
                "/plating/receptacle/0/thickness_mm",
                "/plating/receptacle/0/material",
                "/plating/receptacle/0/wear"
            ]
        );
        let hard = r#"{"material":"silver","thickness_um":1.0,"wear":{"law":"archard","k":0}}"#;
        assert_eq!(pointers(&plated(hard, "")), ["/plating/receptacle/0/wear"]);
        let unworn = format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"slider":[{GOLD}]}},"interface":{{"wear":{{"slider":null}}}}}}"#
        );
        assert_eq!(resolved(&unworn).scene.slider.wear, None);
        let many = [GOLD; 9].join(",");
        assert_eq!(pointers(&plated(&many, "")), ["/plating/receptacle"]);
    }

    #[test]
    fn a_layer_in_another_unit_is_questioned() {
        let in_mm = GOLD.replace(r#""thickness_um":0.76"#, r#""thickness_mm":1.27"#);
        let [fault] = &faults(&plated(&in_mm, ""))[..] else {
            panic!("one fault");
        };
        assert_eq!(fault.pointer, "/plating/receptacle/0/thickness_mm");
        assert!(fault.detail.contains("in um?"), "{}", fault.detail);
        let thick = GOLD.replace("0.76", "760");
        let resolved = resolved(&plated(&thick, ""));
        let warning = &resolved.warnings[0];
        assert_eq!(warning.pointer, "/plating/receptacle/0/thickness_um");
        assert!(warning.detail.contains("in nm?"), "{}", warning.detail);
    }

    #[test]
    fn laws_of_friction_take_the_coefficient_of_the_contact() {
        let rate = |law: &str| {
            let base = format!(r#""receptacle":{law}"#);
            let text = format!(
                r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[]}},
                "interface":{{"friction":{{"law":"coulomb","coefficient":0.6}},"wear":{{{base}}}}}}}"#
            );
            resolved(&text)
                .scene
                .receptacle
                .outer_rate()
                .expect("a uniform rate")
        };
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
        let k = r#""k":1e-4,"hardness_mpa":1700"#;
        let archard = 1e-4 / 1_700.0;
        assert!(near(rate(&format!(r#"{{"law":"archard",{k}}}"#)), archard));
        let sarkar = rate(&format!(r#"{{"law":"sarkar",{k}}}"#));
        assert!(near(sarkar, archard * 2.08_f64.sqrt()), "{sarkar}");
        let saracibar = rate(&format!(
            r#"{{"law":"saracibar",{k},"reference_friction":0.3}}"#
        ));
        assert!(near(saracibar, 2.0 * archard), "{saracibar}");
        let energy = rate(r#"{"law":"dissipated_energy","energy_coefficient_mm3_per_j":4.23e-5}"#);
        assert!(near(energy, 4.23e-8 * 0.6), "{energy}");
    }

    #[test]
    fn laws_name_the_field_that_they_lack_or_do_not_have() {
        let fault = |law: &str| {
            let text = plated("", &format!(r#""receptacle":{law}"#));
            faults(&text)
                .into_iter()
                .map(|fault| fault.pointer)
                .collect::<Vec<_>>()
        };
        let at = |field: &str| vec![format!("/interface/wear/receptacle/{field}")];
        assert_eq!(
            fault(r#"{"law":"saracibar","k":1e-4}"#),
            at("reference_friction")
        );
        assert_eq!(
            fault(r#"{"law":"dissipated_energy"}"#),
            at("energy_coefficient_mm3_per_j")
        );
        let foreign = r#"{"law":"archard","k":1e-4,"reference_friction":0.3}"#;
        assert_eq!(fault(foreign), at("reference_friction"));
        let foreign = r#"{"law":"dissipated_energy","energy_coefficient_mm3_per_j":1e-5,"k":1e-4}"#;
        assert_eq!(fault(foreign), at("k"));
    }
}
