//! Worn depths and pressure over the area of a contact, at stored cycles: of a point, along a line or a ring, and of bodies of a width.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Worn depth over the surface of a body.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DepthMap {
    /// Positions along the sliding direction, mm, in the frame of the body; on a ring outward from its centre line.
    pub x_mm: Vec<f64>,
    /// Positions across it, mm; absent on a ring.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub z_mm: Vec<f64>,
    /// Angles from the direction of motion on a ring, degrees, from 0 to 360, which is 0 again; absent elsewhere.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub theta_deg: Vec<f64>,
    /// Worn depth, mm: one row for each of `x_mm`, with one value for each of `z_mm` or `theta_deg`.
    pub depth_mm: Vec<Vec<f32>>,
}

/// Contact pressure over the contact at the neutral position.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PressureMap {
    /// Positions along the sliding direction, mm, on the receptacle; on a ring outward from its centre line.
    pub x_mm: Vec<f64>,
    /// Positions across it, mm; absent on a ring.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub z_mm: Vec<f64>,
    /// Angles from the direction of motion on a ring, degrees, from 0 to 360, which is 0 again; absent elsewhere.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub theta_deg: Vec<f64>,
    /// Pressure, MPa: one row for each of `x_mm`, with one value for each of `z_mm` or `theta_deg`.
    pub pressure_mpa: Vec<Vec<f32>>,
}

/// Maps of a contact: of both bodies around what is worn, and of the contact.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ContactMaps {
    /// The cycle they belong to.
    pub cycle: u64,
    /// The receptacle's surface.
    pub receptacle: DepthMap,
    /// The slider's surface.
    pub slider: DepthMap,
    /// The contact.
    pub contact: PressureMap,
}
