//! Results of a run, from which the documents of its job are made; an attempt collects them, so that it makes the documents itself.

use api::results::Snapshot;
use solver::record::CycleReport;

/// Largest length of the lines that are held, bytes: all workers of a process hold theirs. Arbitrary.
const LIMIT: usize = 32 << 20;

/// Rows and snapshots of a run, in their order.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Computed {
    pub(super) rows: Vec<CycleReport>,
    pub(super) snapshots: Vec<Snapshot>,
    /// Length of their lines.
    bytes: usize,
}

impl Computed {
    /// Everything that is stored of a run.
    pub(super) fn stored(rows: Vec<CycleReport>, snapshots: Vec<Snapshot>) -> Self {
        Self {
            rows,
            snapshots,
            bytes: 0,
        }
    }

    /// Adds a row of a line of this length; `None` if not all can be held, or if its cycle is not a later one.
    pub(super) fn with_row(mut self, row: &CycleReport, bytes: usize) -> Option<Self> {
        let is_later = self.rows.last().is_none_or(|last| last.cycle < row.cycle);
        self.rows.push(row.clone());
        self.within_limit(bytes).filter(|_| is_later)
    }

    /// Adds a snapshot, likewise.
    pub(super) fn with_snapshot(mut self, snapshot: &Snapshot, bytes: usize) -> Option<Self> {
        let last = self.snapshots.last();
        let is_later = last.is_none_or(|last| last.profile.cycle < snapshot.profile.cycle);
        self.snapshots.push(snapshot.clone());
        self.within_limit(bytes).filter(|_| is_later)
    }

    fn within_limit(mut self, bytes: usize) -> Option<Self> {
        self.bytes = self.bytes.saturating_add(bytes);
        (self.bytes <= LIMIT).then_some(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::http::tests::{row, snapshot};

    #[test]
    fn results_are_held_in_their_order_up_to_a_length() {
        let held = Computed::default().with_row(&row(1), 100);
        let held = held.and_then(|held| held.with_snapshot(&snapshot(1), 100));
        let held = held.expect("two lines");
        assert_eq!((held.rows.len(), held.snapshots.len()), (1, 1));
        assert!(held.clone().with_row(&row(2), 100).is_some());
        assert_eq!(held.clone().with_row(&row(1), 100), None);
        assert_eq!(held.clone().with_snapshot(&snapshot(1), 100), None);
        assert_eq!(held.with_row(&row(2), LIMIT), None);
    }
}
