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
//! Limits: a reciprocating motion with imposed slip and one coefficient of friction, so that nothing sticks; wear by the dose alone; no
//! groove whose cycles are extrapolated (`extrapolation`). Everything else, single cycles, and a jump that does not converge are
//! integrated by computed cycles. What a pass reshapes is no part of the depths, whose both passes undo it, but of the pressures: those of a computed cycle are
//! reported where it is much.

mod attempts;
mod buffers;
mod contacts;
mod end;
mod jump;
mod positions;
#[cfg(test)]
mod tests;

use super::attempts::CycleAttempts;
use super::{CycleError, CycleRecord, CycleState, IncrementNumber, Integrator, WarmStarts};
use crate::contact::{ContactError, Thickness};
use crate::law::dose_laws::DoseLaws;
use crate::law::surface::{self, SurfaceWear};
use crate::model::Tangential;
use crate::number::real_cycles;
use crate::scene::{Motion, Scene};
use crate::schedule::attempts::{Attempts, longest_accepted_jump};
use crate::schedule::increments;
use crate::schedule::jump::implicit::formulas::{Formulas, JumpFrom, LastDoses};
use crate::schedule::step::Step;
use crate::schedule::stroke::Stroke;
use crate::sides::{Side, Sides};
use attempts::JumpAttempts;
pub(super) use buffers::ImplicitJumps;
use contacts::Bodies;
use end::End;
use jump::ImplicitJump;
pub(crate) use positions::count as positions_of_jumps;
use positions::{CyclePosition, positions};

/// Pressure skew of a single cycle by the wear that the contact as a whole has, k s E*/b, from which on the contacts in a computed cycle
/// are reported: the pressure is off by about a third of it.
const LARGEST_SKEW: f64 = 0.1;

/// End of a jump as it is reported.
struct ReportedEnd {
    record: CycleRecord,
    /// Cycles up to which nothing else is reported.
    until: u64,
    /// True if the state then may be reported in detail.
    is_reported: bool,
}

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
        let Some(laws) = self.dose_laws(stroke) else {
            return Ok(None);
        };
        let control = state.jump.clone();
        let remaining = until - state.cycle;
        let jump = state
            .jump
            .next_implicit(&self.scene.accuracy, stroke, remaining);
        if jump <= 1 || !self.saves_work(state, stroke, jump) {
            state.jump = control;
            return Ok(None);
        }
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
            Ok((_, record)) => {
                let end = ReportedEnd {
                    record,
                    until,
                    is_reported,
                };
                Ok(Some(self.in_a_cycle(state, stroke, end)))
            }
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
    fn dose_laws(&self, stroke: Stroke) -> Option<DoseLaws> {
        let laws = laws_of_jumps(self.scene, self.pair.interface.tangential, &self.wear)?;
        (self.heating.is_none() && !stroke.is_groove).then_some(laws)
    }

    /// Returns `true` if an implicit jump of so many cycles is less work than computed ones, with the cycle for its reported contacts.
    fn saves_work(&self, state: &CycleState, stroke: Stroke, jump: u64) -> bool {
        let is_reported_as_is = self.skew(state, stroke) <= LARGEST_SKEW;
        is_reported_as_is || state.jump.saves_cycles(&self.scene.accuracy, stroke, jump)
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

    /// Replaces the contacts at the end of a jump by those of one computed cycle, if a cycle reshapes its contact: the wear of the cycle
    /// does not count. They stay where that has no solution.
    fn in_a_cycle(
        &mut self,
        state: &mut CycleState,
        stroke: Stroke,
        end: ReportedEnd,
    ) -> CycleRecord {
        let ReportedEnd {
            record,
            until,
            is_reported,
        } = end;
        if self.skew(state, stroke) <= LARGEST_SKEW {
            return record;
        }
        let mut passing = state.clone();
        passing.cycle -= 1;
        let mut attempt = CycleAttempts {
            work: passing.work,
            integrator: self,
            state: &mut passing,
            stroke,
            until,
            is_reported,
        };
        let Ok(record_of_cycle) = attempt.attempt(1) else {
            return record;
        };
        state.contact = passing.contact;
        state.neutral = passing.neutral;
        state.checks = passing.checks;
        state.work = passing.work;
        record_of_cycle
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
        let cycles = real_cycles(jump);
        let mut bodies = Bodies::of(
            &self.pair,
            &self.slope,
            &state.depth,
            state.contact.indentation,
        );
        let contacts = &mut self.implicit.contacts;
        let mut first = contacts.doses_on(bodies, &positions, &state.depth, &starts)?;
        let worn_next = self.worn_next(state, laws, cycles, &first);
        let ImplicitJumps { contacts, system } = &mut self.implicit;
        if let Some(worn_next) = &worn_next {
            bodies.next.thickness = Thickness::OfNodes(worn_next);
            first = contacts.doses_on(bodies, &positions, &state.depth, &starts)?;
        }
        let before = laws.doses(&state.depth);
        let nodes = first.as_ref().map(Vec::len);
        let last = state.jump.last_implicit();
        let formulas = Formulas::new(&JumpFrom {
            laws,
            dose: &before,
            of_cycle: &first,
            sizes: self.pair.operators.as_ref().map(|body| &body.widths[..]),
            depth: &state.depth,
            cycles,
            last: last.and_then(|last| LastDoses::of(last, laws, nodes)),
        });
        let predicted = Sides::from_fn(|side| {
            let nodes = before.of(side).iter().zip(first.of(side));
            nodes
                .map(|(dose, of_cycle)| dose + cycles * of_cycle)
                .collect()
        });
        let implicit = ImplicitJump {
            bodies,
            laws,
            formulas: &formulas,
            before: &state.depth,
        };
        let reached = implicit.solve(contacts, system, predicted)?;
        let formula = formulas.formula;
        let end = End {
            laws,
            jump,
            formula,
            before,
            first,
            reached,
        };
        self.finish(state, end, detailed)
    }

    /// Thicknesses that a jump of so many cycles wears at the master's nodes at the doses and rates of its beginning, an indentation at
    /// least, mm; where a layer of the master wears faster than its surface.
    fn worn_next(
        &self,
        state: &CycleState,
        laws: &DoseLaws,
        cycles: f64,
        first: &Sides<Vec<f64>>,
    ) -> Option<Vec<f64>> {
        let master = self.pair.interface.slave.other();
        let quickens = self.wear.of(master).is_some_and(SurfaceWear::quickens);
        let least = state.contact.indentation;
        let nodes = first.of(master).iter().zip(state.depth.of(master));
        let worn = nodes.map(|(dose, depth)| cycles * dose * laws.slope(master, *depth));
        quickens.then(|| worn.map(|worn| worn.max(least)).collect())
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

/// Returns `true` if the jumps of a motion may be implicit.
pub(crate) fn are_possible(scene: &Scene, tangential: Tangential) -> bool {
    laws_of_jumps(scene, tangential, &scene.surface_wear()).is_some()
}

/// The laws of a motion whose jumps may be implicit, on surfaces of this wear.
fn laws_of_jumps(
    scene: &Scene,
    tangential: Tangential,
    wear: &Sides<Option<SurfaceWear>>,
) -> Option<DoseLaws> {
    let accuracy = &scene.accuracy;
    let is_simple = accuracy.tuning.implicit_jumps
        && matches!(scene.motion, Motion::Reciprocating { .. })
        && !scene.friction.changes()
        && tangential != Tangential::StickSlip
        && scene.cycles_at_a_time.is_none()
        && accuracy.cycle_jump.is_none();
    DoseLaws::of(wear).filter(|_| is_simple)
}
