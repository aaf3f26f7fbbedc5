//! Materials: names to properties, and the elastic constants of both bodies.

use api::spec::{Material, MaterialProperties, Materials, Provenance};
use solver::scene::Elastic;

use crate::reference::materials::{LibraryMaterial, MATERIALS};
use crate::reference::presets::{Known, Preset};
use crate::spec::diagnostics::{Diagnostics, Range, shortened};

/// From soft gels to far beyond diamond (1.1e6 MPa), MPa.
const YOUNGS_MODULUS_MPA: Range = Range {
    from: 1e-3,
    to: 1e8,
};
/// Isotropic, not auxetic, compressible.
const POISSON_RATIO: Range = Range {
    from: 0.0,
    to: 0.499_9,
};
/// MPa; diamond has about 1e5.
pub(crate) const HARDNESS_MPA: Range = Range {
    from: 1e-3,
    to: 1e6,
};
/// Any positive property whose value only an effect still to come will use.
const POSITIVE: Range = Range {
    from: 1e-15,
    to: 1e15,
};

/// The elastic constants of both bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ElasticPair {
    pub(crate) slider: Elastic,
    pub(crate) receptacle: Elastic,
}

/// Fills in both materials.
pub(crate) fn resolve(
    given: &Materials,
    preset: &Preset,
    diagnostics: &mut Diagnostics,
) -> (Materials, ElasticPair) {
    let (slider, slider_elastic) = side(
        "/materials/slider",
        given.slider.as_ref(),
        preset.slider,
        diagnostics,
    );
    let (receptacle, receptacle_elastic) = side(
        "/materials/receptacle",
        given.receptacle.as_ref(),
        preset.receptacle,
        diagnostics,
    );
    let materials = Materials {
        slider: Some(Material::Given(Box::new(slider))),
        receptacle: Some(Material::Given(Box::new(receptacle))),
    };
    (
        materials,
        ElasticPair {
            slider: slider_elastic,
            receptacle: receptacle_elastic,
        },
    )
}

fn side(
    pointer: &str,
    given: Option<&Material>,
    preset: Known<&'static str>,
    diagnostics: &mut Diagnostics,
) -> (MaterialProperties, Elastic) {
    let properties = match given {
        None => named(pointer, preset.value, preset.from, diagnostics),
        Some(Material::Named(name)) => named(pointer, name, Provenance::Given, diagnostics),
        Some(Material::Given(properties)) => checked(pointer, properties, diagnostics),
    };
    let elastic = Elastic {
        youngs_modulus_mpa: properties.youngs_modulus_mpa.unwrap_or_default(),
        poisson_ratio: properties.poisson_ratio.unwrap_or_default(),
    };
    (properties, elastic)
}

fn named(
    pointer: &str,
    name: &str,
    from: Provenance,
    diagnostics: &mut Diagnostics,
) -> MaterialProperties {
    let Some(material) = LibraryMaterial::named(name) else {
        let names: Vec<_> = MATERIALS.iter().map(|material| material.name).collect();
        diagnostics.fault(
            pointer,
            format!(
                "`{}` is not in the material library ({}); write an object with its properties instead",
                shortened(name),
                names.join(", ")
            ),
        );
        return MaterialProperties::default();
    };
    let properties = material.properties();
    diagnostics.note(format!("{pointer}/name"), from);
    for (field, value) in numbers(&properties) {
        if value.is_some() {
            let from = if field == "hardness_mpa" {
                material.hardness_from
            } else {
                Provenance::Typical
            };
            diagnostics.note(format!("{pointer}/{field}"), from);
        }
    }
    properties
}

fn checked(
    pointer: &str,
    given: &MaterialProperties,
    diagnostics: &mut Diagnostics,
) -> MaterialProperties {
    if let Some(name) = &given.name {
        diagnostics.text(&format!("{pointer}/name"), name, 200);
        diagnostics.note(format!("{pointer}/name"), Provenance::Given);
    }
    for (field, value) in numbers(given) {
        let place = format!("{pointer}/{field}");
        let required = matches!(field, "youngs_modulus_mpa" | "poisson_ratio");
        match value {
            Some(value) => {
                diagnostics.note(&place, Provenance::Given);
                diagnostics.check(&place, value, range(field));
            }
            None if required => {
                diagnostics.missing(&place, "a material written as an object states it");
            }
            None => {}
        }
    }
    given.clone()
}

fn range(field: &str) -> Range {
    match field {
        "youngs_modulus_mpa" => YOUNGS_MODULUS_MPA,
        "poisson_ratio" => POISSON_RATIO,
        "hardness_mpa" => HARDNESS_MPA,
        // Some materials shrink when heated.
        "thermal_expansion_per_k" => Range {
            from: -1e-3,
            to: 1e-3,
        },
        _ => POSITIVE,
    }
}

fn numbers(properties: &MaterialProperties) -> [(&'static str, Option<f64>); 8] {
    [
        ("youngs_modulus_mpa", properties.youngs_modulus_mpa),
        ("poisson_ratio", properties.poisson_ratio),
        ("hardness_mpa", properties.hardness_mpa),
        ("density_kg_m3", properties.density_kg_m3),
        (
            "thermal_conductivity_w_mk",
            properties.thermal_conductivity_w_mk,
        ),
        ("specific_heat_j_kgk", properties.specific_heat_j_kgk),
        ("resistivity_ohm_m", properties.resistivity_ohm_m),
        (
            "thermal_expansion_per_k",
            properties.thermal_expansion_per_k,
        ),
    ]
}
