//! Record of a run of extruded bodies.

use crate::along_line::{SectionsOutcome, StationCycle, StationProfile};

/// Result of a run. Sections are the node planes of the half width, from the end to the middle.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtrudedSummary {
    /// How it ended.
    pub outcome: SectionsOutcome,
    /// The loaded contact before any wear.
    pub initial: StationCycle,
    /// Distance by which the slider sinks under the load, mm.
    pub approach_mm: f64,
    /// The last computed cycle.
    pub last: StationCycle,
    /// Computed cycles.
    pub computed_cycles: u64,
    /// Increments of the whole run, and Newton iterations in these.
    pub solves: (usize, usize),
    /// Times that bodies were condensed again.
    pub relocations: u64,
    /// Worn depths at the end, plane by plane.
    pub profiles: Vec<StationProfile>,
    /// Pressures at the end at the nodes of the body that carries the constraints, plane by plane, MPa.
    pub pressures_mpa: Vec<Vec<f64>>,
}
