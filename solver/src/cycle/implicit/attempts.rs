//! Attempts of a jump that is implicit in the worn shapes, and the way back to the state before it.

use crate::contact::{ContactError, Work};
use crate::cycle::{CycleRecord, CycleState, Integrator};
use crate::law::dose_laws::DoseLaws;
use crate::number::real_cycles;
use crate::schedule::attempts::{Attempts, Remedy};
use crate::schedule::stroke::Stroke;

/// Attempts to make the next jump of a state, up to a number of cycles.
pub(super) struct JumpAttempts<'a, 'o> {
    pub(super) integrator: &'a mut Integrator<'o>,
    pub(super) state: &'a mut CycleState,
    pub(super) laws: DoseLaws,
    pub(super) stroke: Stroke,
    pub(super) until: u64,
    /// True if what happens until then may be reported in detail.
    pub(super) is_reported: bool,
    /// Work before the first attempt.
    pub(super) work: Work,
}

impl Attempts for JumpAttempts<'_, '_> {
    type Saved = CycleState;
    type Record = CycleRecord;
    type Error = ContactError;

    fn attempt(&mut self, jump: u64) -> Result<CycleRecord, ContactError> {
        let (run, state) = (&mut *self.integrator, &mut *self.state);
        // A run may end after this jump.
        let is_last = state.cycle + jump == self.until;
        let detailed = (is_last && self.is_reported) || run.scene.has_stops();
        run.update_surfaces(state, real_cycles(jump));
        let record = run.jump(state, &self.laws, jump, detailed);
        if record.is_err() {
            // Work of failed jumps does not count.
            state.work = self.work;
        }
        record
    }

    fn rejected(&mut self, _: &CycleState, _: &CycleRecord, jump: u64) -> Option<u64> {
        let accuracy = &self.integrator.scene.accuracy;
        self.state
            .jump
            .rejected_implicit(accuracy, self.stroke, jump)
    }

    fn save(&self) -> CycleState {
        self.state.clone()
    }

    fn go_back(&mut self, before: &CycleState) {
        let work = self.state.work;
        self.state.clone_from(before);
        self.state.work = work;
    }

    /// Zones are widened by a run that builds other operators.
    fn remedy(&mut self, error: &ContactError) -> Result<Remedy, ContactError> {
        Ok(if error.needs_wider_zones() {
            Remedy::Nothing
        } else {
            Remedy::ShorterJump
        })
    }

    fn limit(&mut self, most: u64) -> u64 {
        self.state.jump.limit(most);
        most
    }
}
