//! The contact of a single cycle, where a computed one digs for many.
//!
//! A contact that runs over the block rests on the front that its pass digs. With a jump that front is as many passes
//! high, the contact as much wider and its pressure lower: 39 % at the groove's cycle 240 (`fuzz_button.json`, tolerance
//! 2 %). What is reported of a place is therefore the contact of a copy of the state that came there over the last
//! part of the way digging single passes: within 1 % of that of single cycles throughout in the middle of the groove,
//! 19 % below it at the ends, whose shape the jumps have changed.

use super::path::{self, Step};
use super::{CycleState, Integrator, Position};
use crate::contact::ContactState;
use crate::number::count_at_least;

/// The way of a probe over the mean half-width of the contact: it leaves its whole width behind twice. Ways of 5 and 8
/// half-widths change the pressure of the groove by 0.02 %.
const WAY: f64 = 4.0;

/// The end of the way, over the half-width of the contact of a single cycle, that is made in steps for that contact
/// instead of the wide one; in the wide one's steps the pressure is 6 % low.
const FINE_WAY: f64 = 4.0;

/// Most parts of a step: the steps of a contact so much wider do not lead to the narrow one in a few of its widths.
const MOST_PARTS: usize = 64;

/// Probes of one computed cycle.
#[derive(Debug, Default)]
pub(super) struct Probes {
    /// First and last step of each.
    spans: Vec<(usize, usize)>,
    /// How many steps before its end a probe begins to cut them, and into how many parts.
    fine: usize,
    parts: usize,
    found: Vec<(Position, ContactState)>,
}

impl Probes {
    /// Probes that end at the named positions among so many steps of a length, for the half-widths of the contact as it
    /// is and of that of a single cycle.
    pub(super) fn of(
        (steps, length): (usize, f64),
        tolerance: f64,
        half_width: f64,
        single: f64,
    ) -> Self {
        if single <= 0.0 {
            return Self::default();
        }
        let count = count_at_least(WAY * half_width / length);
        let ends = path::named(steps).into_iter();
        Self {
            spans: ends.map(|end| (end.saturating_sub(count), end)).collect(),
            fine: count_at_least(FINE_WAY * single / length),
            parts: count_at_least(length / path::largest_step(tolerance, single)).min(MOST_PARTS),
            found: Vec::new(),
        }
    }

    /// Increments that they take.
    pub(super) fn increments(&self) -> usize {
        let taken = |(begin, end): &(usize, usize)| {
            let steps = end + 1 - begin;
            steps + self.fine.min(steps) * (self.parts - 1)
        };
        self.spans.iter().map(taken).sum()
    }

    /// Makes the probes that begin before a step. One that does not come through is not missed: the contact of the
    /// computed cycle stands in for it.
    pub(super) fn make(
        &mut self,
        integrator: &mut Integrator<'_>,
        state: &mut CycleState,
        steps: &[Step],
        next: usize,
    ) {
        for &(_, end) in self.spans.iter().filter(|span| span.0 == next) {
            let mut single = state.clone();
            let mut way = steps[next..=end].iter().enumerate();
            let arrives = way.all(|(i, step)| {
                let cut = next + i + self.fine > end;
                integrator.probe(&mut single, step, if cut { self.parts } else { 1 })
            });
            state.increments = single.increments;
            if let (true, Some(position)) = (arrives, steps[end].at) {
                state.checks = single.checks;
                self.found.push((position, single.contact));
            }
        }
    }

    /// The contact that a probe found at a position.
    pub(super) fn take(&mut self, at: Position) -> Option<ContactState> {
        let place = self.found.iter().position(|found| found.0 == at)?;
        Some(self.found.swap_remove(place).1)
    }
}
