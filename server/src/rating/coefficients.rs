//! The wear coefficients of a specification.

use api::rating::Coefficient;
use api::spec::{Material, PlatingLayer, Spec, WearLaw};

/// Multiplies all of them by a factor; returns them with their values before and after.
pub(super) fn scale(spec: &mut Spec, factor: f64) -> Vec<Coefficient> {
    let mut scaled = Vec::new();
    let materials = spec.materials.clone();
    let wear = &mut spec.interface.wear;
    let bases = [
        ("slider", &mut wear.slider, materials.slider),
        ("receptacle", &mut wear.receptacle, materials.receptacle),
    ];
    for (side, law, material) in bases {
        let pointer = format!("/interface/wear/{side}");
        if let Some(Some(law)) = law {
            scaled.extend(scale_law(&pointer, name(material.as_ref()), law, factor));
        }
    }
    let plating = &mut spec.plating;
    for (side, layers) in [
        ("slider", &mut plating.slider),
        ("receptacle", &mut plating.receptacle),
    ] {
        for (index, PlatingLayer { material, wear, .. }) in layers.iter_mut().enumerate() {
            let pointer = format!("/plating/{side}/{index}/wear");
            if let Some(law) = wear {
                scaled.extend(scale_law(&pointer, name(material.as_ref()), law, factor));
            }
        }
    }
    scaled
}

/// Every law has one of these coefficients.
fn scale_law(
    pointer: &str,
    material: Option<String>,
    law: &mut WearLaw,
    factor: f64,
) -> Option<Coefficient> {
    let coefficients = [
        ("k", &mut law.k),
        ("k_over_h_per_mpa", &mut law.k_over_h_per_mpa),
        (
            "energy_coefficient_mm3_per_j",
            &mut law.energy_coefficient_mm3_per_j,
        ),
    ];
    let mut given = coefficients.into_iter();
    let (field, value) = given.find_map(|(field, value)| Some((field, value.as_mut()?)))?;
    let given = std::mem::replace(value, *value * factor);
    Some(Coefficient {
        pointer: format!("{pointer}/{field}"),
        material,
        given,
        implied: *value,
    })
}

/// The name of a material, if it has one.
fn name(material: Option<&Material>) -> Option<String> {
    match material? {
        Material::Named(name) => Some(name.clone()),
        Material::Given(properties) => properties.name.clone(),
    }
}
