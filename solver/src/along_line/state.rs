//! State of a run of sections along a line between two computed cycles.

use serde::{Deserialize, Serialize};

use super::StationCycle;

/// Progress of a run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Progress {
    /// Cycles done.
    pub(super) done: u64,
    pub(super) computed: u64,
    /// Most increments of a cycle.
    pub(super) most_increments: usize,
    /// Times that sections were condensed again.
    pub(super) relocations: u64,
    /// The last computed cycle.
    pub(super) last: StationCycle,
}

/// State of a run of sections along a line between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SectionsState<S> {
    pub(crate) sections: S,
    pub(super) progress: Progress,
}

impl<S> SectionsState<S> {
    /// Cycles done.
    pub(crate) fn cycle(&self) -> u64 {
        self.progress.done
    }

    /// The last computed cycle.
    pub(crate) fn last(&self) -> &StationCycle {
        &self.progress.last
    }

    /// Computed cycles, and the most increments of one.
    pub(crate) fn computed(&self) -> (u64, usize) {
        (self.progress.computed, self.progress.most_increments)
    }

    /// Times that sections were condensed again.
    pub(crate) fn relocations(&self) -> u64 {
        self.progress.relocations
    }
}
