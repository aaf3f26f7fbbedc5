//! What a run reports of extruded bodies.

use crate::sides::Sides;

/// A node plane after a computed cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneReport {
    /// Distance from the middle of the width, mm.
    pub z_mm: f64,
    /// Length of the width that it stands for, with its mirror image, mm.
    pub length_mm: f64,
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
pub struct ExtrudedCycle {
    /// Cycles done.
    pub cycle: u64,
    /// Cycles that this computed one stands for; 0 for the unworn contact.
    pub jump: u64,
    /// All node planes of the half width, from the end to the middle.
    pub planes: Vec<PlaneReport>,
    /// Distance by which the slider has sunk since first touch, by deformation and wear, mm.
    pub approach_mm: f64,
    /// Vertical force at the end of the cycle, N.
    pub force_n: f64,
    /// Worn volume by the final shapes, mm^3.
    pub worn_volume_mm3: Sides<f64>,
    /// Wear rate times the integral of p |slip| over contact and time, mm^3.
    pub sliding_work_volume_mm3: Sides<f64>,
    /// Wear rate times F s, mm^3.
    pub ideal_volume_mm3: Sides<f64>,
    /// Energy dissipated by friction since the run began, mJ.
    pub dissipated_energy_mj: f64,
    /// Estimated relative error of the wear in the jump.
    pub jump_error: f64,
    /// Increments of the computed cycle, and Newton iterations in these.
    pub increments: usize,
    /// Newton iterations in these.
    pub iterations: usize,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExtrudedOutcome {
    /// All cycles are done.
    Completed,
    /// The depth that ends it was reached.
    StopDepth,
    /// A body is nearly consumed in a node plane.
    WornThrough {
        /// Its number.
        plane: usize,
    },
    /// The groove of a node plane is as deep below an end of its surface as the slider's radius: no graph describes walls that overhang.
    DeeperThanRadius {
        /// Its number.
        plane: usize,
    },
    /// The receiver of its cycles ended it.
    Stopped,
}

/// Worn depths of a node plane.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneProfile {
    /// Distance from the middle of the width, mm.
    pub z_mm: f64,
    /// Places of the nodes of each body in its own frame, mm.
    pub x_mm: Sides<Vec<f64>>,
    /// Vertical worn depth there, mm.
    pub depth_mm: Sides<Vec<f64>>,
    /// Pressure at the nodes of the body that carries the constraints, MPa.
    pub pressure_mpa: Vec<f64>,
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtrudedSummary {
    /// How it ended.
    pub outcome: ExtrudedOutcome,
    /// The loaded contact before any wear.
    pub initial: ExtrudedCycle,
    /// The last computed cycle.
    pub last: ExtrudedCycle,
    /// Computed cycles.
    pub computed_cycles: usize,
    /// Increments of the whole run, and Newton iterations in these.
    pub solves: (usize, usize),
    /// Times that bodies were condensed again.
    pub relocations: usize,
    /// Worn depths and pressures at the end, plane by plane.
    pub profiles: Vec<PlaneProfile>,
}
