//! Materials: a name from the material library, or an object.

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;

/// The materials of both parts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Materials {
    /// The sprung or vibrating part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slider: Option<Material>,
    /// The fixed part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub receptacle: Option<Material>,
}

/// A material: a name from the library, or its properties.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(untagged)]
pub enum Material {
    /// A name from the library.
    Named(String),
    /// Properties.
    Given(Box<MaterialProperties>),
}

/// Properties of a material.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct MaterialProperties {
    /// Name in the library, if it is from there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Young's modulus, MPa. Required.
    pub youngs_modulus_mpa: Option<f64>,
    /// Poisson's ratio, -. Required.
    pub poisson_ratio: Option<f64>,
    /// Hardness, MPa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness_mpa: Option<f64>,
    /// Density, kg/m^3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_kg_m3: Option<f64>,
    /// Thermal conductivity, W/(m K).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thermal_conductivity_w_mk: Option<f64>,
    /// Specific heat, J/(kg K).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub specific_heat_j_kgk: Option<f64>,
    /// Electrical resistivity, ohm m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resistivity_ohm_m: Option<f64>,
    /// Thermal expansion, 1/K.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thermal_expansion_per_k: Option<f64>,
    /// Melting temperature, of an alloy that of its solidus, °C.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub melting_temperature_c: Option<f64>,
}

struct MaterialVisitor;

impl<'de> Visitor<'de> for MaterialVisitor {
    type Value = Material;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("the name of a material or an object with its properties")
    }

    fn visit_str<E>(self, text: &str) -> Result<Material, E> {
        Ok(Material::Named(text.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Material, A::Error> {
        // The map is not buffered, so unknown fields and wrong types inside it have their own pointers.
        MaterialProperties::deserialize(MapAccessDeserializer::new(map))
            .map(|given| Material::Given(Box::new(given)))
    }
}

impl<'de> Deserialize<'de> for Material {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MaterialVisitor)
    }
}
