//! The wear coefficients of a specification.

use api::rating::Coefficient;
use api::spec::{Material, PlatingLayer, Spec, WearLaw};

use crate::spec::materials::name;

/// Multiplies all of them by a factor; returns them with their values before and after.
pub(crate) fn scale(spec: &mut Spec, factor: f64) -> Vec<Coefficient> {
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
            scaled.extend(scale_law(&pointer, material.as_ref(), law, factor));
        }
    }
    let plating = &mut spec.plating;
    for (side, layers) in [
        ("slider", &mut plating.slider),
        ("receptacle", &mut plating.receptacle),
    ] {
        for (index, PlatingLayer { material, wear, .. }) in layers.iter_mut().flatten().enumerate()
        {
            let pointer = format!("/plating/{side}/{index}/wear");
            if let Some(law) = wear {
                scaled.extend(scale_law(&pointer, material.as_ref(), law, factor));
            }
        }
    }
    scaled
}

/// Every law has one of these coefficients; the dose after which a rate changes is in proportion to the inverse, so that all depths
/// depend on the product of coefficient and cycles.
fn scale_law(
    pointer: &str,
    material: Option<&Material>,
    law: &mut WearLaw,
    factor: f64,
) -> Vec<Coefficient> {
    // Of a depth that grows with a power of the time, the factor to this power is in proportion to the inverse of the cycles.
    let course = law.time_exponent.or(law.repetition_exponent).unwrap_or(1.0);
    let coefficients = [
        ("k", &mut law.k, factor),
        ("k_over_h_per_mpa", &mut law.k_over_h_per_mpa, factor),
        (
            "energy_coefficient_mm3_per_j",
            &mut law.energy_coefficient_mm3_per_j,
            factor,
        ),
        (
            "arrhenius_constant_kg2_m4s",
            &mut law.arrhenius_constant_kg2_m4s,
            factor,
        ),
        (
            "arrhenius_constant_m2_s",
            &mut law.arrhenius_constant_m2_s,
            factor,
        ),
        ("molten_fraction", &mut law.molten_fraction, factor),
        ("wear_factor", &mut law.wear_factor, factor.powf(course)),
        (
            "characteristic_dose_mpa_mm",
            &mut law.characteristic_dose_mpa_mm,
            1.0 / factor,
        ),
    ];
    let scaled = coefficients
        .into_iter()
        .filter_map(|(field, value, factor)| {
            let value = value.as_mut()?;
            let given = std::mem::replace(value, *value * factor);
            Some(Coefficient {
                pointer: format!("{pointer}/{field}"),
                material: material.and_then(name).map(str::to_owned),
                given,
                implied: *value,
            })
        });
    scaled.collect()
}
