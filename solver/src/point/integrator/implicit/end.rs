//! Contacts on the shapes at the end of a jump: those that are reported.

use crate::point::error::PointError;
use crate::point::integrator::PointIntegrator;
use crate::point::point_state::PointState;
use crate::point::state::State;

impl PointIntegrator {
    /// Solves for the contacts at the neutral position and at both turning points, of which one is the other mirrored.
    ///
    /// # Errors
    /// A contact without a solution.
    pub(super) fn contacts_at_the_end(&mut self, state: &mut PointState) -> Result<(), PointError> {
        let amplitude = state.sliding.lattice.amplitude;
        let last = -self.scene.amplitude_mm.signum();
        let positions = state.sliding.passing.len();
        let neutral = self.settled(&state.sliding, 0, amplitude)?;
        state.neutral = self.sliding.contact(&neutral, last);
        state.sliding.work = neutral.work;
        state.sliding.worst_residuals = neutral.worst_residuals;
        let right = self.settled(&state.sliding, positions - 1, 2 * amplitude)?;
        let mut left = State {
            position: 0,
            ..right.clone()
        };
        left.pressure.values.reverse();
        let contact = |state, direction| self.sliding.contact(state, direction);
        state.turning = [contact(&left, -1.0), contact(&right, 1.0)];
        state.sliding.work = right.work;
        state.sliding.worst_residuals = right.worst_residuals;
        let arrived = if state.sliding.position == 0 {
            left
        } else {
            right
        };
        state.sliding.pressure = arrived.pressure;
        state.sliding.approach_mm = arrived.approach_mm;
        Ok(())
    }

    /// The contact at a position of the slider, from the pressure of the jump there.
    fn settled(
        &mut self,
        state: &State,
        number: usize,
        slider: usize,
    ) -> Result<State, PointError> {
        let mut settled = state.clone();
        settled.pressure.clone_from(&state.passing[number]);
        self.sliding.settle(&mut settled, slider)?;
        Ok(settled)
    }
}
