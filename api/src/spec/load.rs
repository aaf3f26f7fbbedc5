//! The normal load.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Kinds of load.
    LoadKind {
        /// A pressure on the slider's top face.
        Pressure = "pressure",
        /// A force per mm of depth.
        LineForce = "line_force",
        /// A force over a width.
        Force = "force",
    }
}

/// The normal load. Which fields belong to it depends on its kind; of the preset's kind, fields that are left out have the preset's
/// values.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Load {
    /// Kind.
    #[schema(value_type = LoadKind)]
    pub kind: EnumValue<LoadKind>,
    /// `pressure`: on the slider's top face, MPa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mpa: Option<f64>,
    /// `line_force`: N per mm of depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub n_per_mm: Option<f64>,
    /// `force`: N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub n: Option<f64>,
    /// `force`: the width (depth of the section) that carries it, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_mm: Option<f64>,
    /// Stiffness of the spring that presses the slider down, N per mm of deflection: of the whole contact for `force`,
    /// otherwise per mm of depth. The spring relaxes, and the load falls, as the contact wears.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spring_n_per_mm: Option<f64>,
}
