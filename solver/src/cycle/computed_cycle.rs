//! A computed cycle: its jump, its plan, and its retry with a smaller jump where an increment fails.

use super::extrapolation::loss_of_load;
use super::{CycleError, CycleRecord, CycleState, Integrator};
use crate::law::elastic::contact_modulus;
use crate::law::wear::{self, LocalState};
use crate::model::resolution::radius;
use crate::number::real_cycles;
use crate::schedule::jump::Stroke;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};

impl Integrator<'_> {
    /// Computes one cycle, which represents as many physical ones as the jump control and `until` allow.
    ///
    /// # Errors
    /// [`CycleError`] if an increment fails however small it is; the state is then that before the cycle if wider zones
    /// would help.
    pub fn compute_cycle(
        &mut self,
        state: &mut CycleState,
        until: u64,
    ) -> Result<CycleRecord, CycleError> {
        let (motion, accuracy) = (self.scene.motion, &self.scene.accuracy);
        let stroke = self.stroke(state);
        let mut jump = state.jump.next(accuracy, stroke, until - state.cycle);
        let before = state.clone();
        loop {
            let computed = if stroke.is_groove {
                self.extrapolate(state, jump - 1);
                1
            } else {
                jump
            };
            self.update_slopes(state);
            // A run may end after this cycle.
            let detailed = state.cycle + computed == until || !self.scene.stop.is_empty();
            let cycles = Cycles {
                done: state.cycle,
                jump: computed,
            };
            let (run, stroke) = ((motion, accuracy), (stroke, cycles));
            let plan = CyclePlan::new(run, self.followed(state), stroke, detailed);
            let error = match self.integrate(state, plan, computed, detailed) {
                Ok(record) => {
                    self.measure_jump(state, &before);
                    return Ok(record);
                }
                Err(error) => error,
            };
            if error.needs_wider_zones() {
                *state = before;
                return Err(error);
            }
            let cut = state.jump.cut(jump);
            *state = CycleState {
                jump: state.jump.clone(),
                ..before.clone()
            };
            jump = cut.ok_or(error)?;
        }
    }

    /// Measures what the next jump depends on.
    fn measure_jump(&self, state: &mut CycleState, before: &CycleState) {
        let done = state.cycle - before.cycle;
        let load = |state: &CycleState| state.contact.load(&self.pair.interface);
        state.loss_of_load = loss_of_load(load(before), load(state), real_cycles(done));
        let widths = self.pair.operators.as_ref().map(|body| &body.widths[..]);
        state.jump.update(widths, &before.depth, &state.depth, done);
    }

    pub(super) fn followed(&self, state: &CycleState) -> Followed {
        Followed {
            half_width: state.mean_half_width,
            single: state.neutral.half_width,
            sticks: self.pair.interface.sticks,
        }
    }

    pub(super) fn stroke(&self, state: &CycleState) -> Stroke {
        let (scene, interface) = (self.scene, &self.pair.interface);
        let amplitude = scene.motion.amplitude_mm().abs();
        let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
        let at = LocalState::mean(interface.load, state.mean_half_width);
        let wear = wear::coefficients(interface.wear, at);
        Stroke::new(
            &scene.accuracy.tuning,
            wear,
            modulus,
            (amplitude, state.mean_half_width),
            radius(scene) / scene.slider.shape.radius_mm,
            scene.cycles,
        )
    }
}
