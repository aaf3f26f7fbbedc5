//! Plating: the layers over the base material of each part.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{Material, WearLaw};

/// The platings of both parts. A part without a list has the preset's plating, whatever else of it is given, unless its wear is `null`: it
/// does not wear at all then and has no layers. A part whose list is empty is bare.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Platings {
    /// Layers of the sprung or vibrating part, from the surface down.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slider: Option<Vec<PlatingLayer>>,
    /// Layers of the fixed part, from the surface down.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub receptacle: Option<Vec<PlatingLayer>>,
}

impl Platings {
    /// Returns `true` if neither part has a list.
    pub fn is_absent(&self) -> bool {
        self.slider.is_none() && self.receptacle.is_none()
    }
}

/// A layer.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PlatingLayer {
    /// Material: a name from the library, or its properties. It determines the hardness, where `wear` states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<Material>,
    /// Thickness, um; or `thickness_mm`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_um: Option<f64>,
    /// Thickness, mm; or `thickness_um`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_mm: Option<f64>,
    /// Wear law; that of the library's material if it lists a wear coefficient, required otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wear: Option<WearLaw>,
    /// Coefficient of friction where this layer lies open, -. The contact has the mean of both surfaces' there; a part none of whose
    /// layers has one does not count.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_coefficient: Option<f64>,
}
