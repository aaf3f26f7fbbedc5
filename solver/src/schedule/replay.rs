//! Single-cycle replay: the reported contact where a computed cycle represents many.
//!
//! In gross reciprocating sliding the contact rests on the leading-edge step that its pass wears. With a jump that step
//! is as many passes high, the contact is wider and its pressure lower: 39 % at the groove's cycle 240
//! (`fuzz_button.json`, tolerance 2 %). The contact reported at a position is therefore that of a copy of the state
//! whose last increments before the position, the lead-in, wear as a single cycle: within 1 % of a run without jumps in
//! the middle of the groove, 19 % below it at the ends, whose shape the jumps have changed.

use crate::number::count_at_least;
use crate::scene::Accuracy;
use crate::schedule::increments;

/// Most parts of a step: a contact this much wider does not relax to the narrow one within the lead-in.
const MOST_PARTS: usize = 64;

/// Plan of the replays of one computed cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ReplayPlan {
    /// First and last step of each replay.
    pub(crate) spans: Vec<(usize, usize)>,
    /// Number of steps before the end of a replay that are divided.
    fine: usize,
    /// Parts of a divided step.
    parts: usize,
}

impl ReplayPlan {
    /// Plans replays that end at the named positions of a cycle of so many steps of a length, for the half-widths of
    /// the present contact and of that of a single cycle.
    pub(crate) fn new(
        (steps, length): (usize, f64),
        accuracy: &Accuracy,
        half_width: f64,
        single: f64,
    ) -> Self {
        if single <= 0.0 {
            return Self::default();
        }
        let tuning = &accuracy.tuning;
        let count = count_at_least(tuning.lead_in * half_width / length);
        let ends = increments::named(steps).into_iter();
        let largest_step = accuracy.largest_step(single);
        Self {
            spans: ends.map(|end| (end.saturating_sub(count), end)).collect(),
            fine: count_at_least(tuning.fine_lead_in * single / length),
            parts: count_at_least(length / largest_step).min(MOST_PARTS),
        }
    }

    /// Number of increments of all replays.
    pub(crate) fn increments(&self) -> usize {
        let increments = |(begin, end): &(usize, usize)| {
            let steps = end + 1 - begin;
            steps + self.fine.min(steps) * (self.parts - 1)
        };
        self.spans.iter().map(increments).sum()
    }

    /// Number of parts of a step of a replay that ends at step `end`.
    pub(crate) fn parts(&self, step: usize, end: usize) -> usize {
        if step + self.fine > end {
            self.parts
        } else {
            1
        }
    }
}
