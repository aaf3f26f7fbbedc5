//! Real contact: the spots that carry load and current, and the films on exposed metals.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{Part, count};
use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// How a spot carries its load.
    SpotDeformation {
        /// By the hardness of the softer surface.
        Plastic = "plastic",
        /// As an elastic ball.
        Elastic = "elastic",
        /// By the one of both that has the lower pressure.
        Auto = "auto",
    }
}

/// Spots of real contact.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Spots {
    /// Their number.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub count: Option<u64>,
    /// Diameter of the circle that they fill evenly, mm. Required of more than one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cluster_diameter_mm: Option<f64>,
    /// How they carry the load; `auto` with an `asperity_radius_mm`, `plastic` without.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<SpotDeformation>)]
    pub deformation: Option<EnumValue<SpotDeformation>>,
    /// `elastic`, `auto`: radius of the tip of an asperity, or of a dimple, mm. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asperity_radius_mm: Option<f64>,
}

/// A film on a metal where that is exposed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Film {
    /// The part; both where absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Part>)]
    pub side: Option<EnumValue<Part>>,
    /// The layer that it covers, the outermost one being 1; the base metal if absent.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub layer: Option<u64>,
    /// Resistance of the film times the area of real contact, ohm mm^2; of a film that grows after `growth_time_h`. Required.
    pub specific_resistance_ohm_mm2: Option<f64>,
    /// Exponent of the growth with the time since the metal is exposed, -; a film that is there at once if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub growth_exponent: Option<f64>,
    /// Time after which the film has its specific resistance, h. Required with `growth_exponent`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub growth_time_h: Option<f64>,
}
