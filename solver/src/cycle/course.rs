//! The contacts of a computed cycle: the next one passes the same places with almost the same tractions.

use serde::{Deserialize, Serialize};

use crate::contact::{ContactState, Status, WarmStart};

/// Statuses and pressures of the closed nodes at the end of each increment of a cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// First node of each increment, and where its values end.
    increments: Vec<(usize, usize)>,
    status: Vec<Status>,
    pressure: Vec<f64>,
}

impl Course {
    /// Appends the contact at the end of the next increment.
    pub(super) fn push(&mut self, contact: &ContactState) {
        let (first, end) = contact.active_range().unwrap_or_default();
        self.status.extend_from_slice(&contact.status[first..end]);
        self.pressure
            .extend_from_slice(&contact.pressure[first..end]);
        self.increments.push((first, self.status.len()));
    }

    /// Start of an increment of the next cycle, if that has as many.
    pub(super) fn start(&self, increment: usize, increments: usize) -> Option<WarmStart<'_>> {
        if increments != self.increments.len() {
            return None;
        }
        let (first, end) = self.increments[increment];
        let begin = increment
            .checked_sub(1)
            .map_or(0, |before| self.increments[before].1);
        Some(WarmStart {
            first,
            status: &self.status[begin..end],
            pressure: &self.pressure[begin..end],
        })
    }
}
