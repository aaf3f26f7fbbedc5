//! The cycle integrator: contact increments in which one computed cycle stands for many physical ones.
//!
//! The motion begins at the neutral position and goes to +x. Its first quarter only brings the contact into gross
//! slip; cycles are then computed from turning point to turning point, and the wear of the first quarter is made
//! up by the last one of the last cycle. After N cycles every place has been passed 2 N times either way.
//!
//! Normals are taken from the worn surface at the beginning of a computed cycle. The step that a single pass digs
//! in front of the slider belongs to the wear law, not to the geometry of the scar: with a jump it would be
//! `jump` times too high, and its slope would load the contact like a wall.

mod checks;
mod cycle_record;
pub mod forecast;
mod jump;
mod path;
mod probe;
mod reach;
mod share;
mod state;

use crate::ale::Spines;
use crate::condensation::Operators;
use crate::contact::{self, ContactError, ContactState, Move, Pair, Solver, Surfaces};
use crate::material::contact_modulus;
use crate::model::Model;
use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::Scene;

pub use checks::Checks;
pub use cycle_record::{CycleRecord, FrictionLoop, Neutral, Position};
use probe::Probes;
use share::check_wear;
pub use state::{CycleError, CycleState};

/// A stroke whose amplitude is larger than this many half-widths of the contact leaves it behind.
const RUNS_FROM: f64 = 2.0;

/// Integrates cycles of one scene on one set of operators.
pub struct Integrator<'a> {
    scene: &'a Scene,
    pair: Pair<'a>,
    solver: Solver,
    /// Slopes of the receptacle's and the slider's surface at the beginning of the computed cycle.
    slope: [Vec<f64>; 2],
    spines: Spines,
    next: ContactState,
}

impl<'a> Integrator<'a> {
    /// An integrator for a scene on its condensed model.
    pub fn new(scene: &'a Scene, model: &Model, operators: &'a Operators) -> Self {
        let pair = Pair {
            operators,
            interface: model.interface,
        };
        let next = ContactState::untouched(operators);
        Self {
            scene,
            pair,
            solver: Solver::default(),
            slope: [Vec::new(), Vec::new()],
            spines: Spines::of(model),
            next,
        }
    }

    /// Applies the load at the neutral position without sliding: cycle 0.
    ///
    /// # Errors
    /// [`CycleError`] if there is no equilibrium.
    pub fn apply_load(&mut self, state: &mut CycleState) -> Result<CycleRecord, CycleError> {
        self.take_slopes(state);
        self.increment(
            state,
            Move {
                slider_x: 0.0,
                run: 0.0,
                cycles: 0.0,
                pivots: true,
            },
        )
        .map_err(|source| CycleError::Increment {
            cycle: 0,
            increment: 0,
            halvings: 0,
            source,
        })?;
        let x = &self.pair.operators.receptacle.x;
        state.contact.reference_height = Some(state.contact.height);
        state.mean_half_width = state.contact.half_width(x);
        state.neutral = Neutral::of(&state.contact, &self.pair);
        let contacts = vec![(Position::Neutral, state.contact.clone())];
        Ok(CycleRecord {
            friction_loop: FrictionLoop::default(),
            contacts,
        })
    }

    fn take_slopes(&mut self, state: &CycleState) {
        let Operators { receptacle, slider } = self.pair.operators;
        self.slope = [
            contact::slopes(receptacle, &state.receptacle_depth, -1.0),
            contact::slopes(slider, &state.slider_depth, 1.0),
        ];
    }

    /// Brings the contact to where cycles begin, slipping, without wear.
    ///
    /// # Errors
    /// [`CycleError`] if an increment fails however small it is.
    pub fn initial_quarter(&mut self, state: &mut CycleState) -> Result<(), CycleError> {
        let (motion, accuracy) = (self.scene.motion, &self.scene.accuracy);
        let steps = path::steps(motion, accuracy, state.followed_half_width());
        for (increment, step) in path::initial_quarter(&steps).iter().enumerate() {
            self.step(state, step, 0.0, increment)?;
        }
        Ok(())
    }

    /// One computed cycle; it stands for as many physical ones as the jump control and `until` allow.
    ///
    /// # Errors
    /// [`CycleError`] if an increment fails however small it is.
    pub fn compute_cycle(
        &mut self,
        state: &mut CycleState,
        until: u64,
    ) -> Result<CycleRecord, CycleError> {
        let (motion, accuracy) = (self.scene.motion, &self.scene.accuracy);
        let stroke = self.stroke(state);
        let mut jump = state.jump.next(accuracy, stroke, until - state.cycle);
        let steps = path::steps(motion, accuracy, state.followed_half_width());
        self.take_slopes(state);
        let before = state.clone();
        loop {
            let error = match self.computed_cycle(state, &steps, jump, stroke.runs) {
                Ok(record) => {
                    let widths = &self.pair.operators.receptacle.widths;
                    let done = state.cycle - before.cycle;
                    let (old, new) = (&before.receptacle_depth, &state.receptacle_depth);
                    state.jump.learn(widths, old, new, done);
                    return Ok(record);
                }
                Err(error) => error,
            };
            let cut = state.jump.cut(jump);
            *state = CycleState {
                jump: state.jump.clone(),
                ..before.clone()
            };
            jump = cut.ok_or(error)?;
        }
    }

    /// The steps of one computed cycle, up to its end or to where a body is worn through.
    fn computed_cycle(
        &mut self,
        state: &mut CycleState,
        steps: &[path::Step],
        jump: u64,
        runs: bool,
    ) -> Result<CycleRecord, CycleError> {
        let mut record = CycleRecord::default();
        let mut probes = if runs && jump > 1 {
            let length = 4.0 * self.scene.motion.amplitude_mm() / real(steps.len());
            Probes::of(
                (steps.len(), length),
                self.scene.accuracy.tolerance,
                state.mean_half_width,
                state.neutral.half_width,
            )
        } else {
            Probes::default()
        };
        let (mut half_widths, mut touching, mut done) = (0.0, 0, 0);
        for (increment, step) in steps.iter().enumerate() {
            probes.make(self, state, steps, increment);
            self.step(state, step, real_cycles(jump), increment)?;
            if state.contact.active_range().is_some() {
                half_widths += state.contact.half_width(&self.pair.operators.receptacle.x);
                touching += 1;
            }
            self.record(&mut record, state, step.at, &mut probes);
            done += 1;
            if self.spines.are_worn_through(state) {
                break;
            }
        }
        let cycles = if done == steps.len() {
            record
                .friction_loop
                .begin_at(steps.len() - path::initial_quarter(steps).len());
            jump
        } else {
            cycles_at_least(real_cycles(jump) * real(done) / real(steps.len())).min(jump)
        };
        state.cycle += cycles;
        state.sliding_distance += self.scene.motion.distance_per_cycle_mm() * real_cycles(cycles);
        if touching > 0 {
            state.mean_half_width = half_widths / real(touching);
        }
        state.computed_cycles += 1;
        state.most_increments = state.most_increments.max(steps.len());
        Ok(record)
    }

    fn stroke(&self, state: &CycleState) -> jump::Stroke {
        let (scene, interface) = (self.scene, &self.pair.interface);
        let amplitude = scene.motion.amplitude_mm();
        let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
        let wear = interface.receptacle_wear + interface.slider_wear;
        jump::Stroke {
            runs: amplitude > RUNS_FROM * state.mean_half_width,
            lean: wear * 2.0 * amplitude * modulus / state.mean_half_width,
            cycles: scene.cycles,
        }
    }

    fn increment(&mut self, state: &mut CycleState, to: Move) -> Result<(), ContactError> {
        let cycles = to.cycles;
        let surfaces = Surfaces {
            receptacle_depth: &state.receptacle_depth,
            slider_depth: &state.slider_depth,
            slope: &self.slope[0],
            slider_slope: &self.slope[1],
        };
        let last = &state.contact;
        let done = self
            .solver
            .advance(&self.pair, &surfaces, last, to, &mut self.next)?;
        check_wear(&self.spines, &self.pair.interface, state, to, &done)?;
        let interface = &self.pair.interface;
        let widths = &self.pair.operators.receptacle.widths[done.first..];
        let depths = &mut state.receptacle_depth[done.first..];
        for ((depth, path), width) in depths.iter_mut().zip(done.path).zip(widths) {
            *depth += interface.receptacle_wear * cycles * path;
            state.friction_path += cycles * width * path;
        }
        let depths = &mut state.slider_depth[done.slider_first..];
        for (depth, path) in depths.iter_mut().zip(done.slider_path) {
            *depth += interface.slider_wear * cycles * path;
        }
        state.energy += cycles * done.energy;
        state.increments += 1;
        let checks = &mut state.checks;
        checks.force_balance = checks.force_balance.max(done.force_balance);
        checks.complementarity = checks.complementarity.max(done.complementarity);
        checks.friction_cone = checks.friction_cone.max(done.friction_cone);
        std::mem::swap(&mut state.contact, &mut self.next);
        if interface.friction > 0.0 {
            let used = state
                .contact
                .friction_use(&self.pair.operators.receptacle.widths)
                / interface.friction;
            state.checks.friction_use = state.checks.friction_use.max(used);
        }
        Ok(())
    }

    fn record(
        &self,
        record: &mut CycleRecord,
        state: &mut CycleState,
        at: Option<Position>,
        probes: &mut Probes,
    ) {
        let contact = &state.contact;
        record.friction_loop.displacement_mm.push(contact.slider_x);
        record
            .friction_loop
            .tangential_force_n_per_mm
            .push(contact.tangential_force());
        let Some(position) = at else { return };
        let contact = probes
            .take(position)
            .unwrap_or_else(|| state.contact.clone());
        if position == Position::Neutral {
            state.neutral = Neutral::of(&contact, &self.pair);
        }
        record.contacts.push((position, contact));
    }
}
