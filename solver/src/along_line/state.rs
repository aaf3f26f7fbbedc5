//! State of a run of sections along a line between two computed cycles.

use serde::{Deserialize, Serialize};

use super::StationCycle;
use crate::number::real_cycles;
use crate::scene::Motion;

/// Progress of a run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Progress {
    /// Cycles done.
    pub(super) done: u64,
    /// Cycles done before the present motion, and the sliding distance in them, mm.
    before: u64,
    distance_before_mm: f64,
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

impl Progress {
    /// Ends a motion.
    pub(super) fn end_motion(&mut self, motion: Motion) {
        self.distance_before_mm = self.distance_mm(motion);
        self.before = self.done;
    }

    /// Sliding distance so far, mm, with that of the present motion.
    pub(super) fn distance_mm(&self, motion: Motion) -> f64 {
        let cycles = real_cycles(self.done - self.before);
        self.distance_before_mm + motion.distance_per_cycle_mm().abs() * cycles
    }
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
