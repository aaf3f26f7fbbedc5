//! Step control: increments of a cycle, of its replays, and within a turning point.

use super::retry::{FailedIncrement, Increment, RETRY, RetryPolicy, halve_and_retry};
use super::{CycleError, CycleState, Integrator};
use crate::contact::{ContactError, Displacement, WarmStart};
use crate::scene::Motion;
use crate::schedule::increments;
use crate::schedule::step::Step;

/// A replay is optional, so the expensive method is not tried.
const REPLAY_RETRY: RetryPolicy = RetryPolicy {
    lemke_from: u32::MAX,
    ..RETRY
};

/// Parts of the first step after a turning point at which the friction loop has points. The force reverses over twice
/// the displacement of gross slip, often far less than a step; without them the loop encloses 7 to 10 % less than the
/// dissipated energy with 20 steps a cycle.
const REVERSAL: [f64; 5] = [0.03125, 0.0625, 0.125, 0.25, 0.5];

impl Integrator<'_> {
    /// Increments of a cycle of a motion for the present contact.
    pub(super) fn steps(&self, motion: Motion, state: &CycleState) -> Vec<Step> {
        let (half_width, sticks) = (state.mean_half_width, self.pair.interface.sticks);
        let count = increments::count(motion, &self.scene.accuracy, half_width, sticks);
        increments::steps(motion, count)
    }

    pub(super) fn step(
        &mut self,
        state: &mut CycleState,
        step: &Step,
        cycles: f64,
        increment: usize,
        start: Option<WarmStart<'_>>,
    ) -> Result<(), CycleError> {
        let cycle = state.cycle;
        let to = Increment {
            surface_slip: step.surface_slip,
            cycles,
            start,
            ..Increment::new(state.contact.slider_x, step.slider_x)
        };
        self.retried(state, to, RETRY)
            .map_err(|failed| CycleError::Increment {
                cycle,
                increment,
                halvings: failed.halvings,
                source: failed.source,
            })
    }

    /// Displaces the slider to a place with the wear of a single cycle, in equal parts; returns whether it succeeded.
    pub(super) fn replay_to(
        &mut self,
        state: &mut CycleState,
        slider_x: f64,
        parts: usize,
    ) -> bool {
        Increment::parts(state.contact.slider_x, slider_x, parts)
            .all(|part| self.retried(state, part, REPLAY_RETRY).is_ok())
    }

    /// Displacements and forces within the first step after a turning point, in which the force reverses: on a copy of
    /// the state, so that nothing else depends on them.
    pub(super) fn reversal(&mut self, state: &mut CycleState, step: &Step) -> Vec<(f64, f64)> {
        let mut copy = state.clone();
        let from = copy.contact.slider_x;
        let mut points = Vec::new();
        for part in REVERSAL {
            let to = from + part * (step.slider_x - from);
            if !self.replay_to(&mut copy, to, 1) {
                break;
            }
            let widths = &self.pair.slave().widths;
            let force = copy.contact.tangential_force(&self.pair.interface, widths);
            points.push((copy.contact.slider_x, force));
        }
        state.work = copy.work;
        points
    }

    /// Solves an increment, from a start or from the last contact, and in halves if it fails as a whole.
    fn retried(
        &mut self,
        state: &mut CycleState,
        to: Increment<WarmStart<'_>>,
        policy: RetryPolicy,
    ) -> Result<(), FailedIncrement<ContactError>> {
        halve_and_retry(to, policy, |increment| {
            let displacement = Displacement {
                slider_x: increment.to,
                surface_slip: increment.surface_slip,
                along: 0.0,
                height: None,
                repeated: false,
                cycles: increment.cycles,
                lemke: increment.lemke,
                start: increment.start,
            };
            self.increment(state, displacement)
        })
    }
}
