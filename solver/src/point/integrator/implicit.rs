//! Jumps of a point contact that are implicit in the worn shapes, as those of sections (`cycle::implicit`).
//!
//! The unknowns are the doses D1 of all cells of both surfaces at the end of a jump of n cycles,
//!   D1 = known + n b d(G(D1)),
//! with the depth h = G(D) of a dose and the doses d(h) of one cycle on fixed shapes; b and the known part are those of Euler's formula or of
//! the backward differentiation formula of second order (`schedule::jump::implicit::formulas`), after a computed cycle as well. Nothing wears within a cycle, so that no leading-edge step bounds a jump. d is a sum
//! over positions of the slider (`positions`), whose pressures are solved for together with the doses (`pressures`): one convex minimum. Each
//! cell has its own pressure at each position. Depths whose mean over a position's part of the stroke is zero are hidden from them; no dose of a
//! position, which is the same all over its part, makes any.
//!
//! Figures at 2 % of a ball of 0.4 mm under 0.5 N, +-20 um, gold over nickel on both sides, beside those of computed cycles:
//! `tests/verify_implicit_points.rs`.
//!
//! Limits: one reciprocating motion, no mission, in gross slip under a dead load, wear by the dose alone. Both halves of the stroke wear alike: the shapes that
//! computed cycles have left a little skewed are mirrored and averaged. Everything else, and a single cycle that does not converge, is
//! integrated by computed cycles.

mod end;
mod fields;
mod filter;
mod jump;
mod newton;
mod positions;
mod pressures;
mod surface;
#[cfg(test)]
mod tests;

use super::super::error::PointError;
use super::super::jump::{laws_of_implicit_jumps, rejected_implicit, saves_work};
use super::super::point_state::PointState;
use super::super::record::PointCycle;
use super::super::state::State;
use super::PointIntegrator;
use crate::law::dose_laws::DoseLaws;
use crate::schedule::attempts::{Attempts, Remedy, longest_accepted_jump};
use crate::schedule::plan::Cycles;
use jump::Jumped;
pub(super) use pressures::CyclePressures;

impl PointIntegrator {
    /// Makes a jump that is implicit in the worn shapes, up to a number of cycles and as long as the control allows; `None` where
    /// computed cycles have to be integrated, or pay more.
    ///
    /// # Errors
    /// A contact at the end that has no solution.
    pub(super) fn implicit_jump(
        &mut self,
        state: &mut PointState,
        remaining: u64,
    ) -> Result<Option<PointCycle>, PointError> {
        let Some(laws) = self.dose_laws(state) else {
            return Ok(None);
        };
        let (control, before) = (state.control, state.sliding.clone());
        let accuracy = &self.scene.accuracy;
        let computed = control.next(accuracy, state.done, remaining, self.jump_bounds(state));
        let jump = state.control.next_implicit(accuracy, state.done, remaining);
        let along = state.neutral.half_lengths_mm.0;
        if !saves_work(&self.scene, along, jump, computed) {
            state.control = control;
            return Ok(None);
        }
        let work = state.sliding.work;
        let cycles = Cycles {
            done: state.done,
            jump,
        };
        self.sliding.update_coefficient(&mut state.sliding, cycles);
        let mut attempts = ImplicitAttempts {
            integrator: self,
            state,
            laws,
        };
        let Ok((jump, jumped)) = longest_accepted_jump(&mut attempts, jump) else {
            let work = state.sliding.work;
            (state.control, state.sliding) = (control, State { work, ..before });
            return Ok(None);
        };
        self.contacts_at_the_end(state)?;
        let Jumped { formula, error } = jumped;
        state.control.update_implicit(jump, error, formula);
        Ok(Some(self.end_cycle(state, jump, error, work)))
    }

    /// The laws of a contact whose jumps may be implicit.
    fn dose_laws(&self, state: &PointState) -> Option<DoseLaws> {
        let is_simple = !self.is_mission && state.sliding.lattice.amplitude > 0 && state.done > 0;
        let laws = laws_of_implicit_jumps(&self.scene);
        laws.filter(|_| is_simple)
    }
}

/// Attempts to make the next jump of a state.
struct ImplicitAttempts<'a> {
    integrator: &'a mut PointIntegrator,
    state: &'a mut PointState,
    laws: DoseLaws,
}

impl Attempts for ImplicitAttempts<'_> {
    type Saved = State;
    type Record = Jumped;
    type Error = PointError;

    fn attempt(&mut self, jump: u64) -> Result<Jumped, PointError> {
        let done = self.state.done;
        let jumped = self.integrator.jump(self.state, &self.laws, jump);
        jumped.map_err(|error| error.at(done))
    }

    fn rejected(&mut self, _: &State, jumped: &Jumped, jump: u64) -> Option<u64> {
        let accuracy = &self.integrator.scene.accuracy;
        rejected_implicit(accuracy, self.state.done, jump, jumped.error)
    }

    fn save(&self) -> State {
        self.state.sliding.clone()
    }

    fn go_back(&mut self, before: &State) {
        self.state.sliding.go_back(before);
    }

    fn remedy(&mut self, _: &PointError) -> Result<Remedy, PointError> {
        Ok(Remedy::ShorterJump)
    }

    fn limit(&mut self, most: u64) -> u64 {
        self.state.control.limit(most);
        most
    }
}
