//! Jumps that are implicit in the worn shapes.
//!
//! The unknowns are the doses D1 of all nodes of both surfaces at the end of a jump of n cycles,
//!   D1 = D0 + n (b d(G(D1)) + (1 - b) r0),
//! with the depth h = G(D) of a dose (`law::dose`) and the doses d(h) of one cycle on fixed shapes. Nothing wears within a cycle: no pass
//! leaves a step, so that the pressure is not skewed and k n s E*/b does not bound the jump. b = 1 is Euler's formula. With the mean doses
//! r0 of a cycle in the jump before, w of its lengths in this one, and b = (1 + w)/(1 + 2 w), it is the backward differentiation formula
//! of second order (Hairer and Wanner 1996, section III.5 of the first volume); both damp what is stiff, the wear of a pressure peak.
//!
//! d(h) is a sum over positions of the slider (`positions`), whose contacts are linear in the depths for their closed nodes
//! (`contact::line::linearised`): dd/dh = -sum path S T B, with the change T of the pressures per gap, the mean B of depths over a node
//! and the shares S of both surfaces. Without friction on walls the jump minimises a convex functional, because -d is monotone and G
//! increases; kinks of layers are kinks of its gradient. Contact and layers are one problem of active sets (`jump`).
//!
//! Limits: a reciprocating motion with imposed slip and one coefficient of friction, so that nothing sticks; wear by the dose alone; a pass
//! of a single cycle that hardly reshapes the contact; no groove whose cycles are extrapolated (`extrapolation`). A slider that climbs a slope s slides by s^2 farther than its displacement, which is left out. Everything else,
//! and a single cycle that does not converge, is integrated by computed cycles.

mod attempts;
mod buffers;
mod contacts;
mod dose_laws;
mod end;
mod jump;
mod positions;
#[cfg(test)]
mod tests;

use super::{CycleError, CycleRecord, CycleState, IncrementNumber, Integrator, WarmStarts};
use crate::contact::ContactError;
use crate::law::surface;
use crate::model::Tangential;
use crate::number::real_cycles;
use crate::scene::Motion;
use crate::schedule::attempts::longest_accepted_jump;
use crate::schedule::increments;
use crate::schedule::jump::Formula;
use crate::schedule::step::Step;
use crate::schedule::stroke::Stroke;
use crate::sides::{Side, Sides};
use attempts::JumpAttempts;
pub(super) use buffers::ImplicitJumps;
use contacts::Bodies;
use dose_laws::DoseLaws;
use end::End;
use jump::ImplicitJump;
use positions::{CyclePosition, positions};

/// Largest pressure skew of a single cycle by the wear that the contact as a whole has, k s E*/b: the pressure is off by about a third of
/// it.
const LARGEST_SKEW: f64 = 0.1;

impl Integrator<'_> {
    /// Makes a jump that is implicit in the worn shapes, as long as the jump control and `until` allow; `None` where computed cycles
    /// have to be integrated.
    ///
    /// # Errors
    /// [`CycleError`] if the contact has outgrown its zones; the state is then that before the jump.
    pub(super) fn implicit_jump(
        &mut self,
        state: &mut CycleState,
        stroke: Stroke,
        until: u64,
        is_reported: bool,
    ) -> Result<Option<CycleRecord>, CycleError> {
        let Some(laws) = self.dose_laws(state, stroke) else {
            return Ok(None);
        };
        let control = state.jump.clone();
        let remaining = until - state.cycle;
        let jump = state
            .jump
            .next_implicit(&self.scene.accuracy, stroke, remaining);
        let mut attempts = JumpAttempts {
            work: state.work,
            integrator: self,
            state,
            laws,
            stroke,
            until,
            is_reported,
        };
        match longest_accepted_jump(&mut attempts, jump) {
            Ok((_, record)) => Ok(Some(record)),
            Err(source) if source.needs_wider_zones() => Err(CycleError::Increment {
                cycle: state.cycle,
                increment: 0,
                halvings: 0,
                source,
            }),
            Err(_) => {
                state.jump = control;
                Ok(None)
            }
        }
    }

    /// The laws of a contact whose jumps are implicit.
    fn dose_laws(&self, state: &CycleState, stroke: Stroke) -> Option<DoseLaws> {
        let (scene, interface) = (self.scene, &self.pair.interface);
        let is_simple = scene.accuracy.tuning.implicit_jumps
            && matches!(scene.motion, Motion::Reciprocating { .. })
            && !scene.friction.changes()
            && interface.tangential != Tangential::StickSlip
            && scene.cycles_at_a_time.is_none()
            && scene.accuracy.cycle_jump.is_none()
            && self.heating.is_none();
        let laws = DoseLaws::of(&self.wear)?;
        let is_even = !stroke.is_groove && self.skew(state, stroke) <= LARGEST_SKEW;
        (is_simple && is_even && self.is_flat(state)).then_some(laws)
    }

    /// Pressure skew of a single cycle by the wear that the contact as a whole has had in the last jump.
    fn skew(&self, state: &CycleState, stroke: Stroke) -> f64 {
        let area = self.worn_area(state, state.jump.rates());
        if area <= 0.0 {
            return stroke.skew;
        }
        let interface = &self.pair.interface;
        area * interface.modulus / (2.0 * interface.load * state.mean_half_width)
    }

    /// Worn area of a cycle of equivalent depths in mm at the nodes of both surfaces, mm^2.
    fn worn_area(&self, state: &CycleState, equivalents: Sides<&[f64]>) -> f64 {
        let sides = Side::BOTH.iter().map(|side| {
            let (wear, depth) = (*self.wear.of(*side), state.depth.of(*side));
            let rates = surface::at_relative_rates(wear, equivalents.of(*side), depth);
            let widths = &self.pair.operators.of(*side).widths;
            rates.iter().zip(widths).map(|(r, d)| r * d).sum::<f64>()
        });
        sides.sum()
    }

    /// Returns `true` if the path of a slider that climbs the worn receptacle is its displacement.
    fn is_flat(&self, state: &CycleState) -> bool {
        let body = &self.pair.operators.receptacle;
        let (x, depth) = (&body.x, &state.depth.receptacle);
        let limit = self.scene.accuracy.tolerance.sqrt();
        let steps = x.windows(2).zip(depth.windows(2));
        steps.fold(0.0, |steepest: f64, (x, depth)| {
            steepest.max(((depth[1] - depth[0]) / (x[1] - x[0])).abs())
        }) <= limit
    }

    /// Makes a jump.
    ///
    /// # Errors
    /// [`ContactError`] if it does not converge.
    fn jump(
        &mut self,
        state: &mut CycleState,
        laws: &DoseLaws,
        jump: u64,
        detailed: bool,
    ) -> Result<CycleRecord, ContactError> {
        let positions = self.cycle_positions(state);
        let starts = self.starts(state, &positions)?;
        let bodies = Bodies {
            pair: &self.pair,
            slope: &self.slope,
        };
        let ImplicitJumps { contacts, system } = &mut self.implicit;
        contacts.place(bodies, positions, &state.depth, &starts)?;
        contacts.settle(bodies, &state.depth)?;
        let first = contacts.doses(bodies);
        let before = laws.doses(&state.depth);
        let cycles = real_cycles(jump);
        let nodes = first.as_ref().map(Vec::len);
        let last = state
            .jump
            .last_implicit(jump)
            .filter(|last| last.is_of(nodes));
        let (formula, weight) = last.map_or((Formula::ImplicitEuler, 1.0), |last| {
            let ratio = cycles / last.cycles;
            (Formula::TwoSteps, (1.0 + ratio) / (1.0 + 2.0 * ratio))
        });
        let known = Sides::from_fn(|side| match last {
            None => before.of(side).clone(),
            Some(last) => {
                let part = cycles * (1.0 - weight) / laws.rate(side).max(f64::MIN_POSITIVE);
                let nodes = before.of(side).iter().zip(*last.rates.of(side));
                nodes.map(|(dose, rate)| dose + part * rate).collect()
            }
        });
        let predictor = Sides::from_fn(|side| {
            let nodes = before.of(side).iter().zip(first.of(side));
            nodes
                .map(|(dose, of_cycle)| dose + cycles * of_cycle)
                .collect()
        });
        let implicit = ImplicitJump {
            bodies,
            laws,
            known,
            cycles: cycles * weight,
            before: &state.depth,
        };
        let end = implicit.solve(contacts, system, predictor)?;
        let end = End {
            laws,
            jump,
            formula,
            before,
            first,
            reached: end,
        };
        self.finish(state, end, detailed)
    }

    /// Positions of the next cycle.
    fn cycle_positions(&self, state: &CycleState) -> Vec<CyclePosition> {
        let (motion, accuracy) = (self.scene.motion, &self.scene.accuracy);
        let half_width = self.followed(state).narrower();
        let increments = increments::count(motion, accuracy, half_width, false);
        let count = positions::count(increments);
        let reference = state.contact.reference_height.unwrap_or_default();
        positions(motion.amplitude_mm(), count, reference)
    }

    /// Starts of the contacts at all positions: those of the last jump, or contacts that are solved one after the other.
    ///
    /// # Errors
    /// [`ContactError`] if one has no solution.
    fn starts(
        &mut self,
        state: &CycleState,
        positions: &[CyclePosition],
    ) -> Result<WarmStarts, ContactError> {
        let first = IncrementNumber {
            number: 0,
            count: positions.len(),
        };
        if state.warm_starts.of(first).is_some() {
            return Ok(state.warm_starts.clone());
        }
        let mut passing = state.clone();
        let mut starts = WarmStarts::default();
        for position in positions {
            let step = Step {
                slider_x: position.at.slider_x,
                surface_slip: 0.0,
                at: None,
                stroke: 0,
            };
            self.step(&mut passing, &step, 0.0, 0, None)
                .map_err(|error| match error {
                    CycleError::Increment { source, .. } => source,
                    CycleError::Melts { .. } => contacts::not_converged(0),
                })?;
            starts.push(&passing.contact);
        }
        Ok(starts)
    }
}
