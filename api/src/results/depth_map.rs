//! Worn depths and pressure over the area of a contact, at stored cycles.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Worn depth over the surface of a body.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DepthMap {
    /// Positions along the sliding direction, mm, in the frame of the body.
    pub x_mm: Vec<f64>,
    /// Positions across it, mm.
    pub z_mm: Vec<f64>,
    /// Worn depth, mm: one row for each position along the sliding direction, with one value for each position across it.
    pub depth_mm: Vec<Vec<f32>>,
}

/// Contact pressure over the contact at the neutral position.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PressureMap {
    /// Positions along the sliding direction, mm, on the receptacle.
    pub x_mm: Vec<f64>,
    /// Positions across it, mm.
    pub z_mm: Vec<f64>,
    /// Pressure, MPa: one row for each position along the sliding direction, with one value for each position across it.
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
