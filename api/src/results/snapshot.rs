//! Profiles, pressures and friction loops at stored cycles.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::string_enum;

/// Worn depth along one surface.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SideProfile {
    /// Positions along the surface, mm, in the frame of its body.
    pub x_mm: Vec<f64>,
    /// Worn depth, mm.
    pub depth_mm: Vec<f64>,
}

/// Worn depth along both surfaces.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Profile {
    /// The cycle it belongs to.
    pub cycle: u64,
    /// The receptacle's surface.
    pub receptacle: SideProfile,
    /// The slider's surface.
    pub slider: SideProfile,
}

string_enum! {
    /// Named positions of a cycle.
    SlidePosition {
        /// Slider at x = 0 on its way to +x (the end of the cycle).
        Neutral = "neutral",
        /// Slider at its rightmost position.
        Rightmost = "rightmost",
        /// Slider at its leftmost position.
        Leftmost = "leftmost",
    }
}

/// Contact tractions at one position of the slider.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PressurePosition {
    /// Position in the cycle.
    pub phase: SlidePosition,
    /// Imposed displacement of the slider relative to the receptacle, mm.
    pub slider_x_mm: f64,
    /// Positions on the receptacle, mm.
    pub x_mm: Vec<f64>,
    /// Normal pressure, MPa.
    pub pressure_mpa: Vec<f64>,
    /// Shear traction on the receptacle, MPa.
    pub shear_mpa: Vec<f64>,
}

/// Contact tractions at the positions of a cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Pressure {
    /// The cycle it belongs to.
    pub cycle: u64,
    /// The positions.
    pub positions: Vec<PressurePosition>,
}

/// Friction force over the imposed displacement during one cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Loop {
    /// The cycle it belongs to.
    pub cycle: u64,
    /// Imposed displacement, mm.
    pub displacement_mm: Vec<f64>,
    /// Force of the slider on the receptacle along x, N/mm.
    pub tangential_force_n_per_mm: Vec<f64>,
    /// Tangential force of the whole contact, N; absent of a section.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tangential_force_n: Vec<f64>,
}

/// Everything that is stored at one cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Snapshot {
    /// Worn depth.
    pub profile: Profile,
    /// Contact tractions.
    pub pressure: Pressure,
    /// Friction loop.
    pub friction_loop: Loop,
}
