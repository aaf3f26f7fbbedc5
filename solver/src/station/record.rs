//! What a run reports of its stations.

use crate::sides::Sides;

/// A station after a computed cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StationReport {
    /// Angle from the direction of motion on a ring, rad; distance from the middle of a straight line, mm.
    pub at: f64,
    /// Length of the line that it stands for, mm.
    pub weight_mm: f64,
    /// Largest worn depth, mm.
    pub max_depth_mm: Sides<f64>,
    /// Worn area, mm^2.
    pub worn_area_mm2: Sides<f64>,
    /// Integral of the pressure, as a mean over the sliding distance of the computed cycle, N/mm: on inclined walls more than the vertical
    /// force. The present vertical force before the first.
    pub line_load_n_per_mm: f64,
    /// Peak pressure at the end of the cycle, MPa.
    pub peak_pressure_mpa: f64,
    /// Half-width of the contact there, mm.
    pub half_width_mm: f64,
}

/// A computed cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct StationCycle {
    /// Cycles done.
    pub cycle: u64,
    /// Cycles that this computed one stands for; 0 for the unworn contact.
    pub jump: u64,
    /// All stations in their order.
    pub stations: Vec<StationReport>,
    /// Vertical force of all stations at the end of the cycle, N.
    pub force_n: f64,
    /// Worn volume by the final shapes, mm^3.
    pub worn_volume_mm3: Sides<f64>,
    /// Wear rate times the integral of p |slip| over contact and time, mm^3.
    pub sliding_work_volume_mm3: Sides<f64>,
    /// Wear rate times F s, mm^3.
    pub ideal_volume_mm3: Sides<f64>,
    /// Energy dissipated by friction since the run began, mJ.
    pub dissipated_energy_mj: f64,
    /// Largest estimated relative error of the wear of a station in the jump.
    pub jump_error: f64,
    /// Increments of the computed cycle.
    pub increments: usize,
    /// Iterations for the common height in these.
    pub iterations: usize,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StationOutcome {
    /// All cycles are done.
    Completed,
    /// The depth that ends it was reached.
    StopDepth,
    /// A body is nearly consumed under a station.
    WornThrough {
        /// Its number.
        station: usize,
    },
    /// The groove of a station is as deep below an end of its surface as the slider's radius: no graph describes walls that overhang.
    DeeperThanRadius {
        /// Its number.
        station: usize,
    },
    /// The receiver of its cycles ended it.
    Stopped,
}

/// Worn depths of a station.
#[derive(Debug, Clone, PartialEq)]
pub struct StationProfile {
    /// Places of the nodes of each body in its own frame, mm.
    pub x_mm: Sides<Vec<f64>>,
    /// Vertical worn depth there, mm.
    pub depth_mm: Sides<Vec<f64>>,
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct StationSummary {
    /// How it ended.
    pub outcome: StationOutcome,
    /// The loaded contact before any wear.
    pub initial: StationCycle,
    /// The last computed cycle.
    pub last: StationCycle,
    /// Computed cycles.
    pub computed_cycles: usize,
    /// Increments of the whole run, and iterations for the common height.
    pub solves: (usize, usize),
    /// Times that sections were condensed again.
    pub relocations: usize,
    /// Worn depths at the end, station by station.
    pub profiles: Vec<StationProfile>,
}
