//! Step control: an increment that fails is halved and retried.

use super::{CycleError, CycleState, Integrator};
use crate::contact::{ContactError, Displacement, WarmStart};
use crate::number::real;
use crate::scene::Motion;
use crate::schedule::increments;
use crate::schedule::step::Step;

/// Retries of an increment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RetryPolicy {
    /// Most halvings before the increment fails.
    pub(crate) halvings: u32,
    /// From this many halvings on, Lemke's method is tried where Newton's method does not converge.
    pub(crate) lemke_from: u32,
}

/// Of an increment that has to be solved.
pub(crate) const RETRY: RetryPolicy = RetryPolicy {
    halvings: 8,
    lemke_from: 2,
};

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
        let to = Displacement {
            start,
            ..displacement(step, cycles)
        };
        self.halve_and_retry(state, to, 0, RETRY)
            .map_err(|(halvings, source)| CycleError::Increment {
                cycle,
                increment,
                halvings,
                source,
            })
    }

    /// Displaces the slider to a place with the wear of a single cycle, in equal parts; returns whether it succeeded.
    pub(super) fn replay_to(
        &mut self,
        state: &mut CycleState,
        slider_x: f64,
        parts: usize,
    ) -> bool {
        let from = state.contact.slider_x;
        let part = |k: usize| Step {
            slider_x: from + (slider_x - from) * real(k) / real(parts),
            surface_slip: 0.0,
            at: None,
            stroke: 0,
        };
        (1..=parts).all(|k| {
            self.halve_and_retry(state, displacement(&part(k), 1.0), 0, REPLAY_RETRY)
                .is_ok()
        })
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

    /// Solves an increment, from the last contact if it fails from another start, and in halves if it fails as a whole.
    fn halve_and_retry(
        &mut self,
        state: &mut CycleState,
        to: Displacement<'_>,
        halvings: u32,
        policy: RetryPolicy,
    ) -> Result<(), (u32, ContactError)> {
        let to = Displacement {
            lemke: halvings >= policy.lemke_from,
            ..to
        };
        let Err(error) = self.increment(state, to) else {
            return Ok(());
        };
        if to.start.is_some() {
            let cold = Displacement { start: None, ..to };
            return self.halve_and_retry(state, cold, halvings, policy);
        }
        if halvings == policy.halvings || error.needs_wider_zones() {
            return Err((halvings, error));
        }
        let slider_x = 0.5 * (state.contact.slider_x + to.slider_x);
        let surface_slip = 0.5 * to.surface_slip;
        let first = Displacement {
            slider_x,
            surface_slip,
            ..to
        };
        self.halve_and_retry(state, first, halvings + 1, policy)?;
        let second = Displacement {
            slider_x: to.slider_x,
            ..first
        };
        self.halve_and_retry(state, second, halvings + 1, policy)
    }
}

fn displacement(step: &Step, cycles: f64) -> Displacement<'static> {
    Displacement {
        slider_x: step.slider_x,
        surface_slip: step.surface_slip,
        along: 0.0,
        height: None,
        repeated: false,
        cycles,
        lemke: false,
        start: None,
    }
}
