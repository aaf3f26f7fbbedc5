//! Single-cycle replay: the reported contact where a computed cycle represents many.
//!
//! In gross reciprocating sliding the contact rests on the leading-edge step that its pass wears. With a jump that step
//! is as many passes high, the contact is wider and its pressure lower: 39 % at the groove's cycle 240
//! (`fuzz_button.json`, tolerance 2 %). The contact reported at a position is therefore that of a copy of the state whose
//! last increments before the position, the lead-in, wear as a single cycle: within 1 % of a run without jumps in the
//! middle of the groove, 19 % below it at the ends, whose shape the jumps have changed.

use super::{CycleState, Integrator};
use crate::contact::ContactState;
use crate::history::Position;
use crate::number::count_at_least;
use crate::schedule::increments::{self, Step};

/// Length of the lead-in over the mean half-width of the contact: twice the contact's width. Lengths of 5 and 8
/// half-widths change the pressure of the groove by 0.02 %.
const LEAD_IN: f64 = 4.0;

/// Last part of the lead-in, over the half-width of the contact of a single cycle, whose steps are chosen for that
/// contact; in the steps of the wider one the pressure is 6 % low.
const FINE_LEAD_IN: f64 = 4.0;

/// Most parts of a step: a contact this much wider does not relax to the narrow one within the lead-in.
const MOST_PARTS: usize = 64;

/// Replays of one computed cycle.
#[derive(Debug, Default)]
pub(crate) struct Replays {
    /// First and last step of each.
    spans: Vec<(usize, usize)>,
    /// Number of steps before the end of a replay that are divided, and into how many parts.
    fine: usize,
    parts: usize,
    contacts: Vec<(Position, ContactState)>,
}

impl Replays {
    /// Plans replays that end at the named positions of a cycle of so many steps of a length, for the half-widths of the
    /// present contact and of that of a single cycle.
    pub(crate) fn of(
        (steps, length): (usize, f64),
        tolerance: f64,
        half_width: f64,
        single: f64,
    ) -> Self {
        if single <= 0.0 {
            return Self::default();
        }
        let count = count_at_least(LEAD_IN * half_width / length);
        let ends = increments::named(steps).into_iter();
        Self {
            spans: ends.map(|end| (end.saturating_sub(count), end)).collect(),
            fine: count_at_least(FINE_LEAD_IN * single / length),
            parts: count_at_least(length / increments::largest_step(tolerance, single))
                .min(MOST_PARTS),
            contacts: Vec::new(),
        }
    }

    /// Number of their increments.
    pub(crate) fn increments(&self) -> usize {
        let increments = |(begin, end): &(usize, usize)| {
            let steps = end + 1 - begin;
            steps + self.fine.min(steps) * (self.parts - 1)
        };
        self.spans.iter().map(increments).sum()
    }

    /// Runs the replays that begin before a step. A failed replay is skipped; the contact of the computed cycle is
    /// reported instead.
    pub(super) fn run(
        &mut self,
        integrator: &mut Integrator<'_>,
        state: &mut CycleState,
        steps: &[Step],
        next: usize,
    ) {
        for &(_, end) in self.spans.iter().filter(|span| span.0 == next) {
            let mut single = state.clone();
            let mut lead_in = steps[next..=end].iter().enumerate();
            let succeeded = lead_in.all(|(i, step)| {
                let divided = next + i + self.fine > end;
                integrator.replay_step(&mut single, step, if divided { self.parts } else { 1 })
            });
            state.increments = single.increments;
            if let (true, Some(position)) = (succeeded, steps[end].at) {
                state.checks = single.checks;
                self.contacts.push((position, single.contact));
            }
        }
    }

    /// Takes the contact of the replay that ended at a position.
    pub(super) fn take(&mut self, at: Position) -> Option<ContactState> {
        let place = self.contacts.iter().position(|contact| contact.0 == at)?;
        Some(self.contacts.swap_remove(place).1)
    }
}
