//! Plating: the layers over the base material of each part.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{Material, WearLaw};

/// The platings of both parts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Platings {
    /// Layers of the sprung or vibrating part, from the surface down.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slider: Vec<PlatingLayer>,
    /// Layers of the fixed part, from the surface down.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub receptacle: Vec<PlatingLayer>,
}

impl Platings {
    /// Whether neither part is plated.
    pub fn is_empty(&self) -> bool {
        self.slider.is_empty() && self.receptacle.is_empty()
    }
}

/// A layer.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PlatingLayer {
    /// Its material: a name from the library, or its properties. It determines the hardness, where `wear` states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<Material>,
    /// Thickness, um; or `thickness_mm`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_um: Option<f64>,
    /// Thickness, mm; or `thickness_um`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_mm: Option<f64>,
    /// Its wear law; that of the library's material if it lists a wear coefficient, required otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wear: Option<WearLaw>,
}
