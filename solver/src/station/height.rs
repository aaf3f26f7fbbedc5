//! The common height of the sections under a rigid top.

use serde::{Deserialize, Serialize};

/// The common height of a rigid top.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Height {
    /// It, mm; that of the lowest station.
    pub(super) mm: f64,
    /// Its change in the last increment, mm, and the cycles that this stood for.
    pub(super) change: f64,
    pub(super) cycles: f64,
    /// That of the loaded, unworn contact, mm; `None` before the first load.
    pub(super) reference: Option<f64>,
    /// Largest imbalance of forces so far, over the force.
    pub(super) imbalance: f64,
}

impl Height {
    /// The height of an unloaded top.
    pub(super) fn at(mm: f64) -> Self {
        Self {
            mm,
            ..Self::default()
        }
    }

    /// Records that the first load is applied.
    pub(super) fn loaded(&mut self) {
        self.reference = Some(self.mm);
    }

    /// The height after an increment like the last one.
    pub(super) fn predicted(&self, cycles: f64) -> f64 {
        if self.cycles > 0.0 {
            self.mm + self.change * cycles / self.cycles
        } else {
            self.mm
        }
    }
}
