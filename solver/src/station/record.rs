//! Record of a run of stations.

use crate::along_line::{SectionsOutcome, StationCycle, StationProfile};

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct StationSummary {
    /// How it ended.
    pub outcome: SectionsOutcome,
    /// The loaded contact before any wear.
    pub initial: StationCycle,
    /// The last computed cycle.
    pub last: StationCycle,
    /// Computed cycles.
    pub computed_cycles: u64,
    /// Increments of the whole run, and iterations for the common height.
    pub solves: (usize, usize),
    /// Times that sections were condensed again.
    pub relocations: u64,
    /// Worn depths at the end, station by station.
    pub profiles: Vec<StationProfile>,
}
