//! A computed cycle: its jump, its plan, and its retry with a smaller jump where an increment fails.

use super::extrapolation::loss_of_load;
use super::{CycleError, CycleRecord, CycleState, Integrator};
use crate::change::Change;
use crate::closed_form::unworn_contact::radius;
use crate::law::elastic::contact_modulus;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::number::real_cycles;
use crate::schedule::equivalent_wear::EquivalentWear;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};
use crate::schedule::stroke::{Movement, Stroke};
use crate::sides::Side;

/// Load at a turning point over that at the neutral position from which on a groove is not extrapolated: where a spring has
/// faded on the floor, all wear is that of the walls, which the rate of a groove under an even load does not describe. Arbitrary:
/// without a spring the ratio is 1, and once the floor carries nothing it has no bound.
const UNEVEN: f64 = 2.0;

impl Integrator<'_> {
    /// Computes one cycle, which represents as many physical ones as the jump control and `until` allow; what happens until then
    /// may be reported in detail.
    ///
    /// # Errors
    /// [`CycleError`] if an increment fails however small it is; the state is then that before the cycle if wider zones
    /// would help.
    pub fn compute_cycle(
        &mut self,
        state: &mut CycleState,
        until: u64,
        is_reported: bool,
    ) -> Result<CycleRecord, CycleError> {
        let (motion, accuracy) = (self.scene.motion, &self.scene.accuracy);
        self.heat(state)?;
        let stroke = self.stroke(state);
        let mut jump = state.jump.next(accuracy, stroke, until - state.cycle);
        let before = state.clone();
        loop {
            // A run may end after this cycle.
            let is_last = before.cycle + jump == until;
            let detailed = (is_last && is_reported) || self.scene.has_stops();
            let (computed, extrapolated) = if stroke.is_groove {
                (1, extrapolated(jump - 1, detailed))
            } else {
                (jump, [0; 2])
            };
            self.update_surfaces(state, real_cycles(computed));
            self.extrapolate(state, extrapolated[0], computed);
            let cycles = Cycles {
                done: state.cycle,
                jump: computed,
            };
            let contact = self.followed(state);
            let plan = CyclePlan::new(motion, accuracy, contact, stroke, cycles, detailed);
            let error = match self.integrate(state, plan, computed, extrapolated[1], detailed) {
                Ok(record) => {
                    if self.measure_jump(state, &before) > 0.0 {
                        self.correct_extrapolated_energy(state, &before, computed);
                    }
                    let shorter = self.rejected(state, stroke, jump);
                    let Some(shorter) = shorter else {
                        return Ok(record);
                    };
                    let work = state.work;
                    *state = before.clone();
                    (state.work, jump) = (work, shorter);
                    state.jump.limit(shorter);
                    continue;
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

    /// A shorter jump where the estimated error of one far exceeds what it may be, as where it has passed an interface of a
    /// plating: the rate before does not foresee that behind it. Of surfaces whose rate depends on their depth.
    fn rejected(&self, state: &CycleState, stroke: Stroke, jump: u64) -> Option<u64> {
        let wear = self.wear;
        let by_depth = |wear: Option<SurfaceWear>| wear.is_some_and(SurfaceWear::depends_on_depth);
        let friction = |side| self.scene.friction.follows_wear_of(side);
        let mut sides = Side::BOTH.into_iter();
        if !sides.any(|side| by_depth(*wear.of(side)) || friction(side)) {
            return None;
        }
        state.jump.rejected(&self.scene.accuracy, stroke, jump)
    }

    /// Measures what the next jump depends on; returns the error by the change of friction.
    fn measure_jump(&self, state: &mut CycleState, before: &CycleState) -> f64 {
        let done = state.cycle - before.cycle;
        let load = |state: &CycleState| state.contact.load(&self.pair.interface);
        state.loss_of_load = loss_of_load(load(before), load(state), real_cycles(done));
        let widths = self.pair.operators.as_ref().map(|body| &body.widths[..]);
        let depth = Change {
            before: &before.depth,
            after: &state.depth,
        };
        let worn = EquivalentWear::new(&self.wear, widths, depth);
        let friction = self.change_of_friction(depth, worn.depths());
        state
            .jump
            .update(worn.weights(), friction, worn.depths(), done);
        friction
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
        let pace = scene.timed_motion().mean();
        let at = LocalState::mean(interface.load, state.mean_half_width, pace);
        let wear = self.wear.zip(state.depth.largest_of_each());
        let wear = wear.map(|(wear, depth)| {
            let wear = wear.map(|wear| self.timed.mean_wear(wear));
            wear.map_or(0.0, |wear| wear.largest_rate(depth, at))
        });
        let mut stroke = Stroke::new(
            &scene.accuracy.tuning,
            wear,
            modulus,
            Movement {
                amplitude,
                half_width: state.mean_half_width,
                travel: radius(scene) / scene.slider.shape.radius_mm,
                sticks: interface.sticks,
            },
            self.expected_cycles,
        );
        if scene.motion.turns_inside() {
            stroke = stroke.turning_inside(scene.motion);
        }
        let is_even = state.contact.load(interface) <= UNEVEN * state.neutral.load;
        let passes = self.wear.receptacle;
        stroke.is_groove &= is_even && passes.is_none_or(SurfaceWear::is_even);
        stroke.is_groove &= self.heating.as_ref().is_none_or(|heating| heating.is_even);
        stroke.limit_change_of_friction(scene, state.cycle);
        let is_proportional =
            |wear: Option<SurfaceWear>| wear.is_none_or(SurfaceWear::is_proportional);
        if !(is_proportional(self.wear.slider) && is_proportional(self.wear.receptacle)) {
            return stroke.of_uneven_wear();
        }
        stroke
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
