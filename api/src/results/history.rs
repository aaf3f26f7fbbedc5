//! The wear history: one row a computed cycle, and the same as columns.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One side's wear after a cycle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SideRow {
    /// Largest worn depth, mm.
    pub max_depth_mm: f64,
    /// Worn area of the section, mm^2.
    pub worn_area_mm2: f64,
    /// Half the width of the scar, mm.
    pub scar_half_width_mm: f64,
}

/// State after a computed cycle; cycle 0 is the unworn, loaded state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CycleRow {
    /// Physical cycles done.
    pub cycle: u64,
    /// Physical cycles that the last computed cycle stood for.
    pub jump: u64,
    /// Estimated relative error of worn depth made by the last jump.
    pub jump_error: f64,
    /// Accumulated imposed sliding distance, mm.
    pub sliding_distance_mm: f64,
    /// The receptacle's wear.
    pub receptacle: SideRow,
    /// The slider's wear.
    pub slider: SideRow,
    /// Worn depth of the receptacle at the stations of the specification, mm, in their order.
    pub station_depth_mm: Vec<f64>,
    /// Normal load that a spring leaves, N per mm of depth.
    #[serde(default)]
    pub load_n_per_mm: f64,
    /// Highest contact pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the width of the contact, mm.
    pub contact_half_width_mm: f64,
    /// Accumulated energy dissipated by friction, mJ per mm of depth.
    pub dissipated_energy_mj_per_mm: f64,
}

/// Worn depth followed at one place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Station {
    /// The side: `receptacle`.
    pub side: String,
    /// The place, mm.
    pub x_mm: f64,
    /// Worn depth, mm, one a row.
    pub depth_mm: Vec<f64>,
}

/// One side's wear over the cycles.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SideSeries {
    /// Largest worn depth, mm.
    pub max_depth_mm: Vec<f64>,
    /// Worn area of the section, mm^2.
    pub worn_area_mm2: Vec<f64>,
    /// Half the width of the scar, mm.
    pub scar_half_width_mm: Vec<f64>,
}

/// The wear history as columns of equal length.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WearHistory {
    /// Physical cycles done.
    pub cycle: Vec<u64>,
    /// Physical cycles that the computed cycle stood for.
    pub jump: Vec<u64>,
    /// Accumulated imposed sliding distance, mm.
    pub sliding_distance_mm: Vec<f64>,
    /// Worn depth at the stations.
    pub stations: Vec<Station>,
    /// The receptacle's wear.
    pub receptacle: SideSeries,
    /// The slider's wear.
    pub slider: SideSeries,
    /// Normal load that a spring leaves, N per mm of depth.
    pub load_n_per_mm: Vec<f64>,
    /// Highest contact pressure, MPa.
    pub peak_pressure_mpa: Vec<f64>,
    /// Half the width of the contact, mm.
    pub contact_half_width_mm: Vec<f64>,
    /// Accumulated energy dissipated by friction, mJ per mm of depth.
    pub dissipated_energy_mj_per_mm: Vec<f64>,
}
