//! Materials: names to properties, and the elastic constants of both bodies.

use std::ops::RangeInclusive;

use api::spec::{Material, MaterialProperties, Materials, Provenance};
use solver::scene::Elastic;
use solver::sides::Sides;

use crate::reference::materials::LibraryMaterial;
use crate::spec::diagnostics::{Diagnostics, NAME_LIMIT, shortened};
use crate::spec::sourced::Sourced;
use crate::spec::suggestion::did_you_mean;
use crate::spec::system::Preset;
use crate::spec::unit::{self, Typical};

/// From soft gels to far beyond diamond (1.1e6 MPa), MPa.
const YOUNGS_MODULUS_MPA: RangeInclusive<f64> = 1e-3..=1e8;
/// Isotropic, not auxetic, compressible.
const POISSON_RATIO: RangeInclusive<f64> = 0.0..=0.499_9;
/// MPa; diamond has about 1e5.
pub(crate) const HARDNESS_MPA: RangeInclusive<f64> = 1e-3..=1e6;
/// Per K; some materials shrink when heated.
const THERMAL_EXPANSION_PER_K: RangeInclusive<f64> = -1e-3..=1e-3;
/// From gallium to beyond tungsten, °C; above the temperature at which hardnesses are measured.
const MELTING_TEMPERATURE_C: RangeInclusive<f64> = 25.0..=5_000.0;
/// Any positive property that no effect uses yet.
const POSITIVE: RangeInclusive<f64> = 1e-15..=1e15;

/// The materials of a specification by side.
pub(crate) fn by_side(materials: &Materials) -> Sides<Option<&Material>> {
    Sides {
        slider: materials.slider.as_ref(),
        receptacle: materials.receptacle.as_ref(),
    }
}

/// The name of a material, if it has one.
pub(crate) fn name(material: &Material) -> Option<&str> {
    match material {
        Material::Named(name) => Some(name),
        Material::Given(properties) => properties.name.as_deref(),
    }
}

/// Resolves both materials.
pub(crate) fn resolve(
    given: &Materials,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> (Materials, Sides<Elastic>) {
    let given = by_side(given);
    let properties = Sides::from_fn(|at| {
        let pointer = format!("/materials/{}", at.name());
        side(
            &pointer,
            *given.of(at),
            *preset.materials.of(at),
            diagnostics,
        )
    });
    let elastic = properties.as_ref().map(|properties| Elastic {
        youngs_modulus_mpa: properties.youngs_modulus_mpa.unwrap_or_default(),
        poisson_ratio: properties.poisson_ratio.unwrap_or_default(),
    });
    let filled = properties.map(|properties| Some(Material::Given(Box::new(properties))));
    let materials = Materials {
        slider: filled.slider,
        receptacle: filled.receptacle,
    };
    (materials, elastic)
}

fn side(
    pointer: &str,
    given: Option<&Material>,
    preset: Sourced<&'static str>,
    diagnostics: &mut Diagnostics,
) -> MaterialProperties {
    match given {
        None => from_library(pointer, preset.value, preset.provenance, diagnostics),
        Some(given) => properties(pointer, given, diagnostics),
    }
}

/// Properties of a material as given.
pub(in crate::spec) fn properties(
    pointer: &str,
    given: &Material,
    diagnostics: &mut Diagnostics,
) -> MaterialProperties {
    match given {
        Material::Named(name) => from_library(pointer, name, Provenance::Given, diagnostics),
        Material::Given(properties) => from_properties(pointer, properties, diagnostics),
    }
}

fn from_library(
    pointer: &str,
    name: &str,
    provenance: Provenance,
    diagnostics: &mut Diagnostics,
) -> MaterialProperties {
    let Some(material) = LibraryMaterial::named(name) else {
        let known = LibraryMaterial::names().join(", ");
        let meant = did_you_mean(name, LibraryMaterial::names().iter().copied());
        let name = shortened(name);
        let detail = format!(
            "`{name}` is not in the material library ({known}){meant}; write an object with its properties instead"
        );
        diagnostics.fault(pointer, detail);
        return MaterialProperties::default();
    };
    let properties = material.properties.clone();
    diagnostics.provenance(format!("{pointer}/name"), provenance);
    for (field, value) in numbers(&properties) {
        if value.is_some() {
            let provenance = match field {
                "hardness_mpa" => material.hardness_provenance,
                _ => Provenance::Typical,
            };
            diagnostics.provenance(format!("{pointer}/{field}"), provenance);
        }
    }
    properties
}

fn from_properties(
    pointer: &str,
    given: &MaterialProperties,
    diagnostics: &mut Diagnostics,
) -> MaterialProperties {
    if let Some(name) = &given.name {
        diagnostics.check_text(&format!("{pointer}/name"), name, NAME_LIMIT);
        diagnostics.provenance(format!("{pointer}/name"), Provenance::Given);
    }
    for (field, value) in numbers(given) {
        let pointer = format!("{pointer}/{field}");
        let required = matches!(field, "youngs_modulus_mpa" | "poisson_ratio");
        match value {
            Some(value) => {
                diagnostics.provenance(&pointer, Provenance::Given);
                diagnostics.check_range(&pointer, value, &range(field));
                if let Some(typical) = typical(field) {
                    diagnostics.check_unit(&pointer, Some(value), &typical);
                }
            }
            None if required => {
                diagnostics.missing(&pointer, "a material written as an object states it");
            }
            None => {}
        }
    }
    given.clone()
}

pub(in crate::spec) fn range(field: &str) -> RangeInclusive<f64> {
    match field {
        "youngs_modulus_mpa" => YOUNGS_MODULUS_MPA,
        "poisson_ratio" => POISSON_RATIO,
        "hardness_mpa" => HARDNESS_MPA,
        "thermal_expansion_per_k" => THERMAL_EXPANSION_PER_K,
        "melting_temperature_c" => MELTING_TEMPERATURE_C,
        _ => POSITIVE,
    }
}

fn typical(field: &str) -> Option<Typical> {
    match field {
        "youngs_modulus_mpa" => Some(unit::YOUNGS_MODULUS_MPA),
        "hardness_mpa" => Some(unit::HARDNESS_MPA),
        _ => None,
    }
}

pub(in crate::spec) fn numbers(of: &MaterialProperties) -> [(&'static str, Option<f64>); 9] {
    [
        ("youngs_modulus_mpa", of.youngs_modulus_mpa),
        ("poisson_ratio", of.poisson_ratio),
        ("hardness_mpa", of.hardness_mpa),
        ("density_kg_m3", of.density_kg_m3),
        ("thermal_conductivity_w_mk", of.thermal_conductivity_w_mk),
        ("specific_heat_j_kgk", of.specific_heat_j_kgk),
        ("resistivity_ohm_m", of.resistivity_ohm_m),
        ("thermal_expansion_per_k", of.thermal_expansion_per_k),
        ("melting_temperature_c", of.melting_temperature_c),
    ]
}
