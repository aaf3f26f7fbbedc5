//! Attempts of a computed cycle: its plan, its increments, and the way back to the state before it.

use super::{CycleError, CycleRecord, CycleState, Integrator};
use crate::contact::Work;
use crate::number::real_cycles;
use crate::schedule::attempts::{Attempts, Remedy};
use crate::schedule::plan::{CyclePlan, Cycles};
use crate::schedule::stroke::Stroke;

/// Attempts to compute the next cycle of a state, up to a number of cycles.
pub(super) struct CycleAttempts<'a, 'o> {
    pub(super) integrator: &'a mut Integrator<'o>,
    pub(super) state: &'a mut CycleState,
    pub(super) stroke: Stroke,
    pub(super) until: u64,
    /// True if what happens until then may be reported in detail.
    pub(super) is_reported: bool,
    /// Work before the first attempt.
    pub(super) work: Work,
}

impl CycleAttempts<'_, '_> {
    /// Physical cycles of a jump that are computed at once; those besides are extrapolated.
    fn computed(&self, jump: u64) -> u64 {
        if self.stroke.is_groove { 1 } else { jump }
    }
}

impl Attempts for CycleAttempts<'_, '_> {
    type Saved = CycleState;
    type Record = CycleRecord;
    type Error = CycleError;

    fn attempt(&mut self, jump: u64) -> Result<CycleRecord, CycleError> {
        let computed = self.computed(jump);
        let (run, state, stroke) = (&mut *self.integrator, &mut *self.state, self.stroke);
        // A run may end after this cycle.
        let is_last = state.cycle + jump == self.until;
        let detailed = (is_last && self.is_reported) || run.scene.has_stops();
        let extrapolated = extrapolated(jump - computed, detailed);
        run.update_surfaces(state, real_cycles(computed));
        run.extrapolate(state, extrapolated[0], computed);
        let cycles = Cycles {
            done: state.cycle,
            jump: computed,
        };
        let (motion, accuracy) = (run.scene.motion, &run.scene.accuracy);
        let contact = run.followed(state);
        let plan = CyclePlan::new(motion, accuracy, contact, stroke, cycles, detailed);
        let record = run.integrate(state, plan, computed, extrapolated[1], detailed);
        if record.is_err() {
            // Work of failed cycles does not count.
            state.work = self.work;
        }
        record
    }

    fn rejected(&mut self, before: &CycleState, _: &CycleRecord, jump: u64) -> Option<u64> {
        let computed = self.computed(jump);
        let (run, state) = (&mut *self.integrator, &mut *self.state);
        if run.measure_jump(state, before) > 0.0 {
            run.correct_extrapolated_energy(state, before, computed);
        }
        run.shorter_jump(state, self.stroke, jump)
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
    fn remedy(&mut self, error: &CycleError) -> Result<Remedy, CycleError> {
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

/// Cycles that are extrapolated before a computed cycle, and between its strokes: half of them at either turning point,
/// because what is extrapolated where a stroke ends and the next one begins has worn last there; all of them before a cycle whose
/// contacts at both turning points may be reported.
fn extrapolated(cycles: u64, detailed: bool) -> [u64; 2] {
    let later = if detailed { 0 } else { cycles / 2 };
    [cycles - later, later]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_turning_points_share_the_extrapolated_cycles_except_before_a_report() {
        assert_eq!(
            [0, 1, 6, 7].map(|cycles| extrapolated(cycles, false)),
            [[0, 0], [1, 0], [3, 3], [4, 3]]
        );
        assert_eq!(extrapolated(7, true), [7, 0]);
    }
}
