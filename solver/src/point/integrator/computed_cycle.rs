//! A computed cycle: attempts of the jump that it stands for.

use super::PointIntegrator;
use crate::point::error::PointError;
use crate::point::jump::rejected;
use crate::point::point_state::PointState;
use crate::point::record::PointCycle;
use crate::point::state::{State, start};
use crate::point::window;
use crate::schedule::attempts::{Attempts, Remedy, longest_accepted_jump};

impl PointIntegrator {
    /// Computes the next cycle up to a number of them, with shorter jumps until its error is accepted.
    ///
    /// # Errors
    /// A contact without a solution.
    pub(crate) fn compute_cycle(
        &mut self,
        state: &mut PointState,
        until: u64,
    ) -> Result<PointCycle, PointError> {
        // A rest wears nothing, also by the round-off of merged cells.
        if self.scene.path_mm() != 0.0 {
            let cells = self.scene.accuracy.cells_per_half_length;
            window::coarsen(&mut state.sliding, cells);
            state.sliding.position = start(&self.scene, &state.sliding.lattice);
        }
        let remaining = until.max(state.done + 1) - state.done;
        if let Some(cycle) = self.implicit_jump(state, remaining)? {
            return Ok(cycle);
        }
        let work = state.sliding.work;
        state.sliding.passing.clear();
        let mut attempts = PointAttempts {
            integrator: self,
            state,
            remaining,
        };
        let first = attempts.next_jump();
        let (jump, error) = longest_accepted_jump(&mut attempts, first)?;
        state.control.update(jump, error);
        Ok(self.end_cycle(state, jump, error, work))
    }
}

/// Attempts to compute the next cycle of a state.
struct PointAttempts<'a> {
    integrator: &'a mut PointIntegrator,
    state: &'a mut PointState,
    /// Cycles that remain.
    remaining: u64,
}

impl PointAttempts<'_> {
    fn next_jump(&self) -> u64 {
        let (state, accuracy) = (&self.state, &self.integrator.scene.accuracy);
        let bounds = self.integrator.jump_bounds(state);
        let control = state.control;
        control.next(accuracy, state.done, self.remaining, bounds)
    }
}

impl Attempts for PointAttempts<'_> {
    type Saved = State;
    /// The estimated error.
    type Record = f64;
    type Error = PointError;

    fn attempt(&mut self, jump: u64) -> Result<f64, PointError> {
        let done = self.state.done;
        self.integrator
            .pass_all(self.state, jump)
            .map_err(|error| error.at(done))
    }

    fn rejected(&mut self, _: &State, error: &f64, jump: u64) -> Option<u64> {
        let accuracy = &self.integrator.scene.accuracy;
        rejected(accuracy, self.state.done, jump, *error)
    }

    fn save(&self) -> State {
        self.state.sliding.clone()
    }

    fn go_back(&mut self, before: &State) {
        self.state.sliding.go_back(before);
    }

    /// The window has been widened as far as it can be.
    fn remedy(&mut self, _: &PointError) -> Result<Remedy, PointError> {
        Ok(Remedy::Nothing)
    }

    /// In equal shares of what remains.
    fn limit(&mut self, most: u64) -> u64 {
        self.state.control.limit(most);
        self.next_jump()
    }
}
