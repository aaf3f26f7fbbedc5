//! Record of a run of a point contact.

use serde::{Deserialize, Serialize};

use super::section::section;
use crate::contact::area::Cells;
use crate::sides::Sides;

/// A computed cycle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct PointCycle {
    /// Cycles done.
    pub cycle: u64,
    /// Cycles that this computed one stands for; 0 for the unworn contact.
    pub jump: u64,
    /// Largest worn depth, mm.
    pub max_depth_mm: Sides<f64>,
    /// Worn volume, mm^3.
    pub worn_volume_mm3: Sides<f64>,
    /// Specific wear rate times sliding work, k F s in gross slip, mm^3; `None` for rates that depend on the depth.
    pub ideal_volume_mm3: Sides<Option<f64>>,
    /// Specific wear rate times the sliding work of the middle section, z = 0, mm^2; `None` for rates that depend on the depth.
    pub ideal_area_mm2: Sides<Option<f64>>,
    /// Normal force at the neutral position, N, which a spring reduces as the bodies wear.
    pub force_n: f64,
    /// Line load of the middle section there, N/mm.
    pub line_load_n_per_mm: f64,
    /// Peak pressure at the neutral position, MPa; without the skew of the jump, unless single cycles are skewed that much too.
    pub peak_pressure_mpa: f64,
    /// Half-length of that contact along the sliding direction, mm.
    pub half_length_along_mm: f64,
    /// Half-length of that contact across it, mm.
    pub half_length_across_mm: f64,
    /// Energy dissipated since the run began, mu F s in gross slip, mJ (N mm).
    pub dissipated_energy_mj: f64,
    /// The same per mm of depth of the middle section, mJ/mm.
    pub dissipated_energy_mj_per_mm: f64,
    /// Mean coefficient of friction over the contact at the neutral position, weighted by its pressure, -.
    pub friction_coefficient: f64,
    /// Estimated relative error of the wear of the jump.
    pub jump_error: f64,
    /// Contact solves of the computed cycle.
    pub increments: usize,
    /// Iterations of these.
    pub iterations: usize,
}

/// Worn depth of a body over its cells, in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthMap {
    /// Centres of the cells along the sliding direction from the middle of the body, mm.
    pub x_mm: Vec<f64>,
    /// Centres of the cells across it, mm.
    pub z_mm: Vec<f64>,
    /// Depth at (i, j), with the index i times the number of z plus j, mm.
    pub depth_mm: Vec<f64>,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointOutcome {
    /// All cycles are done.
    Completed,
    /// The receiver of its cycles ended it.
    Stopped,
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSummary {
    /// How it ended.
    pub outcome: PointOutcome,
    /// The loaded contact before any wear.
    pub initial: PointCycle,
    /// The last computed cycle.
    pub last: PointCycle,
    /// Computed cycles.
    pub computed_cycles: usize,
    /// Contact solves of the whole run, and their iterations.
    pub solves: (usize, usize),
    /// Worn depths at the end.
    pub depth: Sides<DepthMap>,
    /// Pressure of the contact at the neutral position, MPa, on its window.
    pub pressure_mpa: Vec<f64>,
    /// That window.
    pub window: Cells,
}

impl DepthMap {
    /// Depths along the middle section, z = 0, mm.
    pub fn section(&self) -> Vec<f64> {
        section(self.z_mm.len(), &self.depth_mm).collect()
    }

    /// Length and width of a cell, mm.
    pub fn cell_mm(&self) -> (f64, f64) {
        (self.x_mm[1] - self.x_mm[0], self.z_mm[1] - self.z_mm[0])
    }
}

impl DepthMap {
    /// The map of depths on cells.
    pub(super) fn new(cells: &Cells, depth_mm: Vec<f64>) -> Self {
        Self {
            x_mm: (0..cells.along_x).map(|i| cells.x_mm(i)).collect(),
            z_mm: (0..cells.along_z).map(|j| cells.z_mm(j)).collect(),
            depth_mm,
        }
    }
}
