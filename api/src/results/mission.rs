//! Worn depths of the blocks of a mission.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::spec::DerivedMotion;

/// A block of a mission, as planned for all of its repetitions or as done.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BlockExtent {
    /// Name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Cycles.
    pub cycles: u64,
    /// Amplitude of its motion, mm.
    pub amplitude_mm: f64,
    /// Imposed sliding distance, mm.
    pub sliding_distance_mm: f64,
    /// Duration, h.
    pub duration_h: f64,
    /// How its motion was derived from a vibration, a thermal cycle or an insertion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<DerivedMotion>,
}

/// Wear of one side by a block.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BlockSide {
    /// Worn area of the section, mm^2.
    pub worn_area_mm2: f64,
    /// Share in the worn area of all blocks, -.
    pub share: f64,
    /// Share of the block in the dose that the deepest point has received, -.
    pub share_of_deepest: f64,
}

/// Wear of a block of a mission.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct BlockSummary {
    /// Computed part of the block.
    #[serde(flatten)]
    pub extent: BlockExtent,
    /// Energy dissipated by friction, mJ per mm of depth.
    pub dissipated_energy_mj_per_mm: f64,
    /// The receptacle's wear.
    pub receptacle: BlockSide,
    /// The slider's wear.
    pub slider: BlockSide,
}
