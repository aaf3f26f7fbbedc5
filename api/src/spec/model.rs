//! Which dimensions of the contact are simulated.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Dimensions of a model.
    Dimension {
        /// A section, alike along its depth.
        PlaneStrain = "plane_strain",
        /// A contact that is small in both directions: a ball, a dimple or a crowned spring on a pad.
        Point = "point",
    }
}

/// Which dimensions of the contact are simulated. Which fields belong to it depends on its dimension.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Model {
    /// Its dimension.
    #[schema(value_type = Dimension)]
    pub dimension: EnumValue<Dimension>,
    /// `point`: radius of the slider in the plane across the sliding direction, mm; that of the section if absent, as of a ball.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_z_mm: Option<f64>,
}

impl Model {
    /// Whether the contact is small in both directions.
    pub fn is_point(&self) -> bool {
        matches!(self.dimension, EnumValue::Known(Dimension::Point))
    }
}
