//! Work of the contact solve, counted.

use std::ops::AddAssign;

use serde::{Deserialize, Serialize};

/// Work of the increments that a run consists of, without those that were taken back: the same on every machine, unlike times.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Increments that were solved.
    pub increments: u64,
    /// Factorizations of Newton's systems.
    pub factorizations: u64,
    /// Unknowns of these systems, summed.
    pub unknowns: u64,
    /// Entries of the bodies' responses that were computed: gaps and tangential jumps of a node by a traction of another.
    pub response_entries: u64,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.increments += other.increments;
        self.factorizations += other.factorizations;
        self.unknowns += other.unknowns;
        self.response_entries += other.response_entries;
    }
}
