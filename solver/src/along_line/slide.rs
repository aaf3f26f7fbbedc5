//! Increments of a computed cycle that sections along a line take together, with replays of single cycles.

use super::record::{LineRecord, PositionContacts};
use crate::contact::ContactState;
use crate::cycle::retry::{
    FailedIncrement, Increment, IncrementError, RetryPolicy, halve_and_retry,
};
use crate::cycle::{IncrementNumber, MeanHalfWidth, WarmStarts};
use crate::number::real_cycles;
use crate::schedule::plan::Cycles;
use crate::schedule::replay::ReplayPlan;
use crate::schedule::step::{Position, Step};

/// An increment of all sections.
pub(crate) type SectionsIncrement = Increment<IncrementNumber>;

/// Sections along a line that take increments together.
pub(crate) trait Sections {
    /// Why an increment has no solution.
    type Unsolved: IncrementError;
    /// A copy of what increments change.
    type Saved;
    /// Retries of an increment.
    const RETRY: RetryPolicy;

    /// Solves an increment and makes it part of the state.
    ///
    /// # Errors
    /// An increment without a solution; the state is then the one before.
    fn advance(&mut self, increment: SectionsIncrement) -> Result<(), Self::Unsolved>;

    /// Takes the normals and the friction of the surfaces as worn now, in so many cycles.
    fn update_surfaces(&mut self, cycles: Cycles);

    /// A copy of what increments change.
    fn save(&self) -> Self::Saved;

    /// Goes back to a copy, with the jump control and the work as they are.
    fn go_back(&mut self, before: &Self::Saved);

    /// Goes back to a copy that was taken before a replay.
    fn end_replay(&mut self, before: &Self::Saved) {
        self.go_back(before);
    }

    /// Displacement of the slider, mm.
    fn slider_x(&self) -> f64;

    /// The contacts of the sections in their order.
    fn contacts(&self) -> impl Iterator<Item = &ContactState>;

    /// Half-widths whose means over a cycle are part of the state, mm.
    fn half_widths(&self) -> Vec<f64>;

    /// Force of the slider on the receptacle along the motion, N.
    fn tangential_force_n(&self) -> f64;

    /// Length of the line, mm.
    fn length_mm(&self) -> f64;

    /// The contacts of the present increment.
    fn contacts_at(&mut self, position: Position) -> PositionContacts;

    /// The worst imbalance of forces at a named position so far, over the force.
    fn worst_imbalance(&mut self) -> &mut f64;

    /// Takes what a cycle leaves for the next one: starts of each section, and means of the half-widths where something has touched.
    fn end_cycle(&mut self, starts: Vec<WarmStarts>, half_widths_mm: Vec<Option<f64>>);
}

/// Takes the steps of a cycle, each of which stands for a jump of cycles, with replays of single ones; without wear where the jump is 0.
///
/// # Errors
/// [`FailedIncrement`]; the steps before it have been taken.
pub(crate) fn slide<S: Sections>(
    sections: &mut S,
    steps: &[Step],
    cycles: Cycles,
    replays: &ReplayPlan,
) -> Result<LineRecord, FailedIncrement<S::Unsolved>> {
    let mut starts = vec![WarmStarts::default(); sections.contacts().count()];
    let mut half_widths = vec![MeanHalfWidth::default(); sections.half_widths().len()];
    let (mut record, mut replayed) = (LineRecord::default(), Vec::new());
    sections.update_surfaces(cycles);
    let cycles = real_cycles(cycles.jump);
    for (number, step) in steps.iter().enumerate() {
        for &(_, end) in replays.spans.iter().filter(|span| span.0 == number) {
            replayed.extend(replay(sections, &steps[number..=end], replays));
        }
        let count = steps.len();
        let increment = Increment {
            cycles,
            start: (cycles > 0.0).then_some(IncrementNumber { number, count }),
            ..Increment::new(sections.slider_x(), step.slider_x)
        };
        retried(sections, increment)?;
        for (starts, contact) in starts.iter_mut().zip(sections.contacts()) {
            starts.push(contact);
        }
        for (mean, half_width) in half_widths.iter_mut().zip(sections.half_widths()) {
            mean.push(half_width);
        }
        let force_n = sections.tangential_force_n();
        record.push(step.slider_x, force_n, sections.length_mm());
        if let Some(position) = step.at {
            let contacts = PositionContacts::take(&mut replayed, position);
            let contacts = contacts.unwrap_or_else(|| sections.contacts_at(position));
            let worst = sections.worst_imbalance();
            *worst = worst.max(contacts.imbalance);
            record.positions.push(contacts);
        }
    }
    if cycles > 0.0 {
        let means = half_widths.into_iter().map(MeanHalfWidth::mean_mm);
        sections.end_cycle(starts, means.collect());
    }
    Ok(record)
}

/// The contacts at the end of steps that wear as a single cycle, from a copy of the state; nothing where one has no solution.
fn replay<S: Sections>(
    sections: &mut S,
    steps: &[Step],
    plan: &ReplayPlan,
) -> Option<PositionContacts> {
    let before = sections.save();
    let position = steps.last()?.at?;
    let mut path = plan.path(sections.slider_x(), steps).into_iter();
    let replayed = path.all(|(to, count)| {
        let mut parts = Increment::parts(sections.slider_x(), to, count);
        parts.all(|part| retried(sections, part).is_ok())
    });
    let contacts = replayed.then(|| sections.contacts_at(position));
    sections.end_replay(&before);
    contacts
}

fn retried<S: Sections>(
    sections: &mut S,
    increment: SectionsIncrement,
) -> Result<(), FailedIncrement<S::Unsolved>> {
    halve_and_retry(increment, S::RETRY, |part| sections.advance(part))
}
