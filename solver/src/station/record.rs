//! Record of a run of stations.

use crate::along_line::{StationCycle, StationProfile};

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StationOutcome {
    /// All cycles are done.
    Completed,
    /// A body is nearly consumed under a station.
    WornThrough {
        /// Number.
        station: usize,
    },
    /// The groove of a station is as deep below an end of its surface as the slider's radius: no graph describes walls that overhang.
    DeeperThanRadius {
        /// Number.
        station: usize,
    },
    /// The receiver of its cycles ended it.
    Stopped,
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
    pub computed_cycles: u64,
    /// Increments of the whole run, and iterations for the common height.
    pub solves: (usize, usize),
    /// Times that sections were condensed again.
    pub relocations: u64,
    /// Worn depths at the end, station by station.
    pub profiles: Vec<StationProfile>,
}
