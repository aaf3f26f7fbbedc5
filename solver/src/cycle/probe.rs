//! The contact of a single cycle, where a computed one digs for many.
//!
//! A contact that runs over the block rests on the front that its pass digs. With a jump that front is as many passes
//! high, the contact as much wider and its pressure lower: 39 % at the groove's cycle 240 (`fuzz_button.json`, tolerance
//! 2 %). What is reported of a place is therefore the contact of a copy of the state that came there over the last
//! part of the way digging single passes: 6 % below that of single cycles throughout in the middle of the groove, 20 %
//! at its ends, whose shape the jumps have changed.

use super::path::Step;
use super::{CycleState, Integrator};
use crate::contact::ContactState;
use crate::history::Position;
use crate::number::count_at_least;

/// The way of a probe over the mean half-width of the contact: it leaves its whole width behind twice, which ways of 5
/// and 8 half-widths change by nothing that matters (555, 551 and 551 MPa with 3, 5 and 8 where single cycles have 586).
const WAY: f64 = 4.0;

/// Probes of one computed cycle: which steps they begin and end with.
#[derive(Debug, Default)]
pub(super) struct Probes {
    spans: Vec<(usize, usize)>,
    found: Option<(Position, ContactState)>,
}

impl Probes {
    /// Probes that end at the named positions among the steps.
    pub(super) fn of(steps: &[Step], half_width: f64) -> Self {
        let Some(length) = steps
            .windows(2)
            .map(|w| (w[1].slider_x - w[0].slider_x).abs())
            .next()
        else {
            return Self::default();
        };
        let count = count_at_least(WAY * half_width / length);
        let ends = steps
            .iter()
            .enumerate()
            .filter(|(_, step)| step.at.is_some());
        Self {
            spans: ends
                .map(|(end, _)| (end.saturating_sub(count), end))
                .collect(),
            found: None,
        }
    }

    /// Increments that they take.
    pub(super) fn increments(&self) -> usize {
        self.spans.iter().map(|(begin, end)| end + 1 - begin).sum()
    }

    /// Makes the probe that begins before a step, if there is one. One that does not come through is not missed: the
    /// contact of the computed cycle stands in for it.
    pub(super) fn make(
        &mut self,
        integrator: &mut Integrator<'_>,
        state: &mut CycleState,
        steps: &[Step],
        next: usize,
    ) {
        let Some((begin, end)) = self.spans.iter().copied().find(|span| span.0 == next) else {
            return;
        };
        let mut single = state.clone();
        let mut way = steps[begin..=end].iter();
        let arrives = way.all(|step| integrator.step(&mut single, step, 1.0, next).is_ok());
        state.increments = single.increments;
        let position = steps[end].at;
        self.found = position.filter(|_| arrives).map(|at| (at, single.contact));
    }

    /// The contact that a probe found at a position.
    pub(super) fn take(&mut self, at: Position) -> Option<ContactState> {
        self.found
            .take_if(|found| found.0 == at)
            .map(|found| found.1)
    }
}
