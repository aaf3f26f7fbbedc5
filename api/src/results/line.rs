//! Sections along the line of a contact, at its end and at stored cycles.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::results::{PressurePosition, SideProfile};

/// One side's wear in a section.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SectionSide {
    /// Largest worn depth, mm.
    pub max_depth_mm: f64,
    /// Worn area, mm^2.
    pub worn_area_mm2: f64,
}

/// A section along the line of a contact.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LineStation {
    /// Angle from the direction of motion, degrees; of a ring.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub theta_deg: Option<f64>,
    /// Distance from the middle, mm; of a straight line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z_mm: Option<f64>,
    /// Length of the line that it stands for, mm.
    pub length_mm: f64,
    /// Integral of the pressure across the line, its mean over the sliding distance of the last computed cycle, N/mm.
    pub line_load_n_per_mm: f64,
    /// Highest pressure at the neutral position, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the width of the contact there, mm.
    pub contact_half_width_mm: f64,
    /// The receptacle's wear.
    pub receptacle: SectionSide,
    /// The slider's wear.
    pub slider: SectionSide,
}

/// Profiles and tractions of a section.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LineProfile {
    /// Where it is, and what it carries.
    #[serde(flatten)]
    pub station: LineStation,
    /// Worn depth over the receptacle's surface.
    pub receptacle_profile: SideProfile,
    /// Worn depth over the slider's surface.
    pub slider_profile: SideProfile,
    /// Contact tractions at the positions of the cycle.
    pub positions: Vec<PressurePosition>,
}

/// All sections at a cycle, in their order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LineProfiles {
    /// The cycle they belong to.
    pub cycle: u64,
    /// The sections.
    pub stations: Vec<LineProfile>,
}

/// A section along the line of a contact over the cycles.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LineSeries {
    /// Angle from the direction of motion, degrees; of a ring.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub theta_deg: Option<f64>,
    /// Distance from the middle, mm; of a straight line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z_mm: Option<f64>,
    /// Line load, N/mm, one value per row.
    pub line_load_n_per_mm: Vec<f64>,
    /// Largest worn depth of the receptacle, mm.
    pub receptacle_max_depth_mm: Vec<f64>,
    /// Largest worn depth of the slider, mm.
    pub slider_max_depth_mm: Vec<f64>,
}
