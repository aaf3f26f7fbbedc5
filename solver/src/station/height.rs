//! The common height of the sections under one top, and the lifts of coupled ones.

use serde::{Deserialize, Serialize};

/// A height that carries the force.
pub(super) struct HeightSolution {
    pub(super) mm: f64,
    /// Lifts of coupled sections over it, mm; none of others.
    pub(super) lifts: Vec<f64>,
    /// Of the forces, over the force.
    pub(super) imbalance: f64,
    pub(super) iterations: usize,
}

/// The common height of the sections under one top.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Height {
    /// Height of the lowest station, mm.
    pub(super) mm: f64,
    /// Change in the last increment, mm, and the cycles that this stood for.
    pub(super) change: f64,
    pub(super) cycles: f64,
    /// Height of the loaded, unworn contact, mm; `None` before the first load.
    pub(super) reference: Option<f64>,
    /// Lifts of coupled sections over it, mm, and their changes in the last increment; empty of others.
    pub(super) lifts: Vec<f64>,
    pub(super) lift_changes: Vec<f64>,
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
        self.mm + self.like(cycles) * self.change
    }

    /// The lifts of so many sections after an increment like the last one.
    pub(super) fn predicted_lifts(&self, sections: usize, cycles: f64) -> Vec<f64> {
        if self.lifts.is_empty() {
            return vec![0.0; sections];
        }
        let lifts = self.lifts.iter().zip(&self.lift_changes);
        let like = self.like(cycles);
        lifts.map(|(lift, change)| lift + like * change).collect()
    }

    /// Takes the heights of an increment that stands for so many cycles.
    pub(super) fn take(&mut self, found: HeightSolution, cycles: f64) {
        self.lift_changes.clear();
        if self.lifts.is_empty() {
            self.lift_changes.resize(found.lifts.len(), 0.0);
        } else {
            let lifts = found.lifts.iter().zip(&self.lifts);
            self.lift_changes.extend(lifts.map(|(new, old)| new - old));
        }
        self.lifts = found.lifts;
        self.change = found.mm - self.mm;
        self.mm = found.mm;
        self.cycles = cycles;
        self.imbalance = self.imbalance.max(found.imbalance);
    }

    /// An increment of so many cycles over the last one; 0 after one without cycles.
    fn like(&self, cycles: f64) -> f64 {
        if self.cycles > 0.0 {
            cycles / self.cycles
        } else {
            0.0
        }
    }
}
