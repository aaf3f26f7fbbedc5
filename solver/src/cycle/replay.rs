//! Runs the single-cycle replays of a computed cycle and holds the states that they reach.

use super::CycleState;
use crate::schedule::replay::ReplayPlan;
use crate::schedule::step::{Position, Step};

/// Replays of one computed cycle.
#[derive(Debug, Default)]
pub(super) struct Replays {
    plan: ReplayPlan,
    states: Vec<(Position, CycleState)>,
}

impl Replays {
    /// Replays to be run by a plan.
    pub(super) fn new(plan: ReplayPlan) -> Self {
        Self {
            plan,
            states: Vec::new(),
        }
    }

    /// Runs the replays that begin before step `next`; `solve` displaces the slider to a place in so many parts and returns
    /// whether it succeeded. A failed replay is skipped; the contact of the computed cycle is reported instead.
    pub(super) fn run(
        &mut self,
        state: &mut CycleState,
        steps: &[Step],
        next: usize,
        mut solve: impl FnMut(&mut CycleState, f64, usize) -> bool,
    ) {
        for &(_, end) in self.plan.spans.iter().filter(|span| span.0 == next) {
            let mut single = state.clone();
            let from = single.contact.slider_x;
            let mut path = self.plan.path(from, &steps[next..=end]).into_iter();
            let succeeded = path.all(|(to, parts)| solve(&mut single, to, parts));
            state.work = single.work;
            if let (true, Some(position)) = (succeeded, steps[end].at) {
                state.checks = single.checks;
                self.states.push((position, single));
            }
        }
    }

    /// Returns `true` if contacts of the computed cycle stand on the step of a jump.
    pub(super) fn are_planned(&self) -> bool {
        !self.plan.spans.is_empty()
    }

    /// Takes the state at the end of the replay that ended at a position.
    pub(super) fn take(&mut self, at: Position) -> Option<CycleState> {
        let place = self.states.iter().position(|state| state.0 == at)?;
        Some(self.states.swap_remove(place).1)
    }
}
