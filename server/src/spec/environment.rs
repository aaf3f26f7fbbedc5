//! Surroundings: the temperature, and the hardnesses of all surfaces at it.

use std::ops::RangeInclusive;

use api::spec::{Environment, Material, MaterialProperties, Spec, WearLaw};
use solver::law::softening::{REFERENCE_C, hardness_ratio};
use solver::scene::{Conductor, Softening};
use solver::sides::Sides;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::definition;
use crate::spec::materials;
use crate::spec::plating;
use crate::spec::sourced::assumed;

const POINTER: &str = "/environment/temperature_c";

/// °C, from absolute zero to beyond every contact.
pub(in crate::spec) const TEMPERATURE_C: RangeInclusive<f64> = -273.0..=3_000.0;

/// A, through one contact: from what a meter drives to beyond any connector.
pub(in crate::spec) const CURRENT_A: RangeInclusive<f64> = 0.0..=1e4;

/// Hz, of the current; from what is direct in all but name to beyond any connector.
pub(in crate::spec) const FREQUENCY_HZ: RangeInclusive<f64> = 1e-3..=1e12;

/// Resolves the surroundings.
pub(super) fn resolve(given: &Environment, diagnostics: &mut Diagnostics) -> Environment {
    let temperature = diagnostics.or_default(POINTER, given.temperature_c, assumed(REFERENCE_C));
    diagnostics.check_range(POINTER, temperature, &TEMPERATURE_C);
    let pointer = "/environment/frequency_hz";
    let frequency_hz = diagnostics.optional(pointer, given.frequency_hz, &FREQUENCY_HZ);
    let current_a = diagnostics.optional("/environment/current_a", given.current_a, &CURRENT_A);
    Environment {
        temperature_c: Some(temperature),
        current_a,
        frequency_hz,
    }
}

/// Hardnesses of the layers and the base of both parts of a specification whose materials and laws are resolved.
pub(super) fn softening(resolved: &Spec, diagnostics: &mut Diagnostics) -> Sides<Softening> {
    let temperature = resolved.environment.temperature_c.unwrap_or(REFERENCE_C);
    let is_reference = (temperature - REFERENCE_C).abs() <= 0.0;
    let materials = materials::by_side(&resolved.materials);
    let laws = laws(resolved);
    let layers = plating::by_side(&resolved.plating);
    Sides::from_fn(|side| {
        let layers = layers.of(side).iter();
        let layers = layers.map(|layer| (layer.material.as_ref(), layer.wear.as_ref()));
        let surfaces = layers.chain([(*materials.of(side), *laws.of(side))]);
        let surfaces: Vec<_> = surfaces.collect();
        let melting = surfaces
            .iter()
            .filter_map(|(material, _)| melting_c(*material));
        let to_melting_k = melting
            .map(|melting| melting - temperature)
            .reduce(f64::min);
        for (material, _) in &surfaces {
            check_melting(temperature, *material, diagnostics);
        }
        let hardness_mpa = surfaces
            .iter()
            .map(|(material, law)| hardness_mpa(temperature, *material, *law))
            .collect();
        let by_hardness: Vec<_> = surfaces
            .into_iter()
            .map(|(material, law)| law.filter(|law| wears_by_hardness(law)).map(|_| material))
            .collect();
        let margin = |material: &Option<Option<&Material>>| {
            let melting = material.and_then(melting_c);
            melting.map(|melting| melting - temperature)
        };
        let lacks_melting = by_hardness
            .iter()
            .any(|material| material.is_some_and(|material| melting_c(material).is_none()));
        let margins_k = by_hardness.iter().map(margin).collect();
        let ratios = by_hardness.iter().map(|material| match material {
            None => Some(1.0),
            Some(material) => ratio(temperature, *material),
        });
        Softening {
            hardness_mpa,
            ratios: if is_reference {
                Vec::new()
            } else {
                ratios.collect()
            },
            margins_k,
            lacks_melting,
            to_melting_k,
        }
    })
}

fn wears_by_hardness(law: &WearLaw) -> bool {
    law.law
        .known()
        .is_none_or(|law| definition(law).takes_hardness())
}

/// The properties of a material that is resolved.
pub(super) fn properties(material: Option<&Material>) -> Option<&MaterialProperties> {
    match material {
        Some(Material::Given(properties)) => Some(properties),
        _ => None,
    }
}

fn melting_c(material: Option<&Material>) -> Option<f64> {
    properties(material)?.melting_temperature_c
}

/// Both materials as conductors of heat.
pub(super) fn conductors(resolved: &Spec) -> Sides<Option<Conductor>> {
    let materials = materials::by_side(&resolved.materials);
    materials.map(|material| {
        let of = properties(material)?;
        let conductivity_w_mk = of.thermal_conductivity_w_mk?;
        let capacity_j_m3k = of.density_kg_m3.zip(of.specific_heat_j_kgk);
        Some(Conductor {
            conductivity_w_mk,
            // m^2/s = 1e6 mm^2/s.
            diffusivity_mm2_s: capacity_j_m3k
                .map(|(density, heat)| 1e6 * conductivity_w_mk / (density * heat)),
        })
    })
}

/// The laws of the bases.
pub(super) fn laws(resolved: &Spec) -> Sides<Option<&WearLaw>> {
    let wear = &resolved.interface.wear;
    Sides {
        slider: wear.slider.as_ref().and_then(Option::as_ref),
        receptacle: wear.receptacle.as_ref().and_then(Option::as_ref),
    }
}

/// Hardness of a metal at a temperature, MPa: that which its wear law states, or its own; at 20 °C where its melting temperature is not
/// known.
pub(super) fn hardness_mpa(
    temperature: f64,
    material: Option<&Material>,
    law: Option<&WearLaw>,
) -> Option<f64> {
    let of_law = law.and_then(|law| law.hardness_mpa);
    let hardness = of_law.or(properties(material).and_then(|own| own.hardness_mpa))?;
    Some(ratio(temperature, material).unwrap_or(1.0) * hardness)
}

/// Hardness of a material at a temperature over that at 20 °C; `None` where its melting temperature is not known or passed.
pub(super) fn ratio(temperature: f64, material: Option<&Material>) -> Option<f64> {
    let melting = melting_c(material)?;
    (temperature < melting).then(|| hardness_ratio(temperature, melting))
}

/// Adds a fault for a material that melts in its surroundings.
fn check_melting(temperature: f64, material: Option<&Material>, diagnostics: &mut Diagnostics) {
    let Some(melting) = melting_c(material).filter(|melting| temperature >= *melting) else {
        return;
    };
    let name = properties(material).and_then(|properties| properties.name.as_deref());
    let name = name.unwrap_or("a material");
    let detail = format!("{temperature} is not below the {melting} at which {name} melts");
    diagnostics.fault(POINTER, detail);
}

#[cfg(test)]
mod tests;
