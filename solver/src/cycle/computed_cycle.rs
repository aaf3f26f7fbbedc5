//! A computed cycle: its jump, and what that depends on.

use super::attempts::CycleAttempts;
use super::extrapolation::loss_of_load;
use super::{CycleError, CycleRecord, CycleState, Integrator};
use crate::change::Change;
use crate::closed_form::unworn_contact::radius;
use crate::law::elastic::contact_modulus;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::number::real_cycles;
use crate::schedule::attempts::longest_accepted_jump;
use crate::schedule::equivalent_wear::EquivalentWear;
use crate::schedule::plan::Followed;
use crate::schedule::stroke::{Movement, Stroke};

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
        self.heat(state)?;
        let stroke = self.stroke(state);
        if let Some(record) = self.implicit_jump(state, stroke, until, is_reported)? {
            return Ok(record);
        }
        let remaining = until - state.cycle;
        let jump = state.jump.next(&self.scene.accuracy, stroke, remaining);
        let mut attempts = CycleAttempts {
            work: state.work,
            integrator: self,
            state,
            stroke,
            until,
            is_reported,
        };
        longest_accepted_jump(&mut attempts, jump).map(|(_, record)| record)
    }

    /// A shorter jump where the estimated error of one far exceeds what it may be.
    pub(super) fn shorter_jump(
        &self,
        state: &CycleState,
        stroke: Stroke,
        jump: u64,
    ) -> Option<u64> {
        state.jump.shorter(self.scene, &self.wear, stroke, jump)
    }

    /// Measures what the next jump depends on; returns the error by the change of friction.
    pub(super) fn measure_jump(&self, state: &mut CycleState, before: &CycleState) -> f64 {
        let done = state.cycle - before.cycle;
        let load = |state: &CycleState| state.contact.load(&self.pair.interface);
        state.loss_of_load = loss_of_load(load(before), load(state), real_cycles(done));
        let widths = self.pair.operators.as_ref().map(|body| &body.widths[..]);
        let depth = Change {
            before: &before.depth,
            after: &state.depth,
        };
        let worn = EquivalentWear::new(&self.wear, widths, depth);
        let friction = &self.friction;
        let friction = friction.change_at_nodes(&self.wear, widths, depth, worn.depths());
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
