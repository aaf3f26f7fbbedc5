//! The cycle integrator: contact increments in which one computed cycle stands for many physical ones.
//!
//! The motion begins at the neutral position toward +x. Its initial quarter only brings the contact into gross slip;
//! cycles are then computed from turning point to turning point, and the last quarter of the last cycle replaces the
//! wear of the initial one. After N cycles every point has been passed 2 N times. In a groove only the last cycle of a jump is
//! computed, as a single one, and the others are extrapolated.
//!
//! Normals are those of the worn surface at the beginning of a computed cycle. The leading-edge step that a single pass
//! wears belongs to the wear law, not to the geometry of the scar: with a jump it would be `jump` times too high, and
//! its slope would load the contact like a wall.

mod attempts;
mod checks;
mod computed_cycle;
mod cycle_record;
mod extrapolation;
mod friction;
mod groove;
mod half_width;
mod heating;
mod implicit;
mod increment;
mod motion_history;
mod replay;
pub(crate) mod retry;
mod skew;
mod state;
mod step_control;
mod stroke_wear;
mod unskewed;
mod warm_starts;
pub(crate) mod wear_limit;

use crate::ale::Spines;
use crate::closed_form::expected_wear;
use crate::condensation::Operators;
use crate::contact::{self, ContactError, ContactState, Displacement, Pair, Solver, Surfaces};
use crate::law::friction::contact::{ContactFriction, CycleFriction};
use crate::law::surface::SurfaceWear;
use crate::model::{Interface, Model, Tangential};
use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::{Motion, Scene, TimedMotion};
use crate::schedule::increments::{self, Position};
use crate::schedule::plan::CyclePlan;
use crate::sides::Sides;

pub use checks::Checks;
pub use cycle_record::{CycleRecord, FrictionLoop, Neutral};
pub(crate) use half_width::MeanHalfWidth;
use heating::Heating;
use implicit::ImplicitJumps;
pub(crate) use implicit::are_possible as implicit_jumps_are_possible;
pub(crate) use implicit::positions_of_jumps as positions_of_implicit_jumps;
pub use motion_history::MotionHistory;
pub(crate) use motion_history::mean_error;
use replay::Replays;
use skew::Passes;
pub(crate) use skew::Skew;
pub use state::{CycleError, CycleState};
pub(crate) use warm_starts::IncrementNumber;
pub use warm_starts::WarmStarts;

/// The load at the neutral position, without sliding.
const FIRST_LOAD: Displacement<'_> = Displacement {
    slider_x: 0.0,
    surface_slip: 0.0,
    along: 0.0,
    height: None,
    repeated: false,
    cycles: 0.0,
    lemke: true,
    start: None,
};

/// Integrates cycles of one scene on one set of operators.
pub struct Integrator<'a> {
    scene: &'a Scene,
    pair: Pair<'a>,
    solver: Solver,
    /// Slopes of the surfaces at the beginning of the computed cycle.
    slope: Sides<Vec<f64>>,
    /// Wear of both surfaces, at the mean temperature of a cycle; the pair has that of the present increment.
    wear: Sides<Option<SurfaceWear>>,
    /// Heating of the contact, if it is simulated.
    heating: Option<Heating>,
    friction: ContactFriction,
    /// Coefficients of the present computed cycle.
    cycle_friction: CycleFriction,
    pub(crate) spines: Spines,
    /// Cycles until the end of the run, estimated where it stops at a depth.
    expected_cycles: u64,
    /// The motion in time, and the present stroke of its cycle.
    timed: TimedMotion,
    stroke: usize,
    next: ContactState,
    implicit: ImplicitJumps,
}

impl<'a> Integrator<'a> {
    /// An integrator for a scene, or a block of its mission, on its condensed model.
    pub fn new(scene: &'a Scene, model: &Model, operators: &'a Operators) -> Self {
        let pair = Pair {
            operators,
            interface: model.interface_of(scene),
        };
        let timed = scene.timed_motion();
        let constant = timed.constant();
        let at_pace = |wear: SurfaceWear| constant.map_or(wear, |pace| wear.during(pace, 0.0));
        let wear = pair.interface.wear.map(|wear| wear.map(at_pace));
        let heating = Heating::of(scene, &pair.interface, &pair.interface.wear);
        let next = ContactState::untouched(operators, model.interface.slave);
        Self {
            scene,
            pair,
            solver: Solver::default(),
            slope: Sides::default(),
            wear,
            heating,
            friction: scene.contact_friction(&model.interface.wear, model.surface.plating),
            cycle_friction: CycleFriction::default(),
            spines: Spines::of(model),
            expected_cycles: expected_wear::expected_cycles(scene, model.sizes.hertz_half_width),
            timed,
            stroke: 0,
            next,
            implicit: ImplicitJumps::default(),
        }
    }

    /// Applies the load at the neutral position without sliding: cycle 0.
    ///
    /// # Errors
    /// [`CycleError`] if there is no equilibrium.
    pub fn apply_load(&mut self, state: &mut CycleState) -> Result<CycleRecord, CycleError> {
        self.update_surfaces(state, 0.0);
        self.increase_load(state)
            .map_err(|source| CycleError::Increment {
                cycle: 0,
                increment: 0,
                halvings: 0,
                source,
            })?;
        let x = &self.pair.slave().x;
        state.contact.reference_height = Some(state.contact.height);
        state.mean_half_width = state.contact.half_width(x);
        state.neutral = Neutral::of(&state.contact, &self.pair);
        let contacts = vec![(Position::Neutral, state.contact.clone())];
        Ok(CycleRecord {
            friction_loop: FrictionLoop::default(),
            contacts,
        })
    }

    /// Increases the load from nothing, in steps that widen a parabolic contact evenly: between unlike bodies the shear
    /// that is locked in depends on the path of the load, because a node that slipped at the edge sticks once the edge
    /// has moved on (Spence 1975).
    fn increase_load(&mut self, state: &mut CycleState) -> Result<(), ContactError> {
        let Interface {
            load: full,
            tangential,
            friction,
            ..
        } = self.pair.interface;
        // Nothing is imposed that could slip: between unlike bodies friction holds the contact together.
        if friction > 0.0 {
            self.pair.interface.tangential = Tangential::StickSlip;
        }
        // Gross slip erases the locked-in shear.
        let steps = if self.pair.interface.sticks {
            self.scene.accuracy.load_steps()
        } else {
            1
        };
        let mut loaded = Ok(());
        for step in 1..=steps {
            self.pair.interface.load = full * (real(step) / real(steps)).powi(2);
            loaded = self.increment(state, FIRST_LOAD);
            if loaded.is_err() {
                break;
            }
        }
        self.pair.interface.load = full;
        self.pair.interface.tangential = tangential;
        loaded
    }

    /// Updates what follows from the worn surfaces, and the friction of so many cycles from now.
    fn update_surfaces(&mut self, state: &CycleState, cycles: f64) {
        self.slope = contact::slopes_of_both(self.pair.operators, &state.depth);
        self.update_friction(state, cycles);
    }

    /// The surfaces as worn in a state, with slopes.
    fn surfaces<'b>(
        friction: &'b CycleFriction,
        depth: &'b Sides<Vec<f64>>,
        slope: &'b Sides<Vec<f64>>,
    ) -> Surfaces<'b> {
        Surfaces {
            depth: depth.as_slices(),
            slope: slope.as_slices(),
            friction: friction.nodal(),
        }
    }

    /// Displaces the slider to the turning point where cycles begin, without wear.
    ///
    /// # Errors
    /// [`CycleError`] if an increment fails however small it is.
    pub fn initial_quarter(&mut self, state: &mut CycleState) -> Result<(), CycleError> {
        let steps = self.steps(self.scene.motion, state);
        for (increment, step) in increments::initial_quarter(&steps).iter().enumerate() {
            self.step(state, step, 0.0, increment, None)?;
        }
        Ok(())
    }

    /// Moves the slider from the turning point where the cycles of another motion end to that where those of this one begin,
    /// without wear.
    ///
    /// # Errors
    /// [`CycleError`] if an increment fails however small it is.
    pub(crate) fn change_motion(
        &mut self,
        state: &mut CycleState,
        from: Motion,
    ) -> Result<(), CycleError> {
        self.update_surfaces(state, 0.0);
        let steps = self.steps(from.outer(), state);
        for (increment, step) in increments::first_quarter(&steps).iter().enumerate() {
            self.step(state, step, 0.0, increment, None)?;
        }
        self.initial_quarter(state)
    }

    /// Integrates one computed cycle up to its end, or until a body is worn through; with additional points of the
    /// friction loop and replays at the turning points where `detailed`. So many cycles are extrapolated between its strokes.
    fn integrate(
        &mut self,
        state: &mut CycleState,
        plan: CyclePlan,
        jump: u64,
        extrapolated: u64,
        detailed: bool,
    ) -> Result<CycleRecord, CycleError> {
        let steps = &increments::steps(self.scene.motion, plan.steps)[..];
        let (mut before, mut energy) = (state.depth.receptacle.clone(), state.energy);
        let mut replays = Replays::new(plan.replays);
        let mut record = CycleRecord::default();
        let is_unskewed = plan.unskewed > 0 && state.skew.remains_after(jump);
        let mut passes = Passes::begin(self.equivalents(&state.depth));
        let warm_starts = std::mem::take(&mut state.warm_starts);
        let mut next_starts = WarmStarts::default();
        let mut half_widths = MeanHalfWidth::default();
        let (mut done, mut neutral) = (0, 0);
        let friction = self.pair.interface.friction;
        for (increment, step) in steps.iter().enumerate() {
            self.stroke = step.stroke;
            if increment > 0 && increments::begins_a_stroke(steps, increment) {
                state.wear_of_strokes[0] = self.wear_per_cycle(state, &before, jump);
                energy += self.extrapolate(state, extrapolated, jump);
                before.clone_from(&state.depth.receptacle);
            }
            replays.run(state, steps, increment, |state, to, parts| {
                self.replay_to(state, to, parts)
            });
            if detailed && increments::begins_a_stroke(steps, increment) {
                let points = self.reversal(state, step);
                record.friction_loop.extend(&points);
            }
            let start = warm_starts.of(IncrementNumber {
                number: increment,
                count: steps.len(),
            });
            self.step(state, step, real_cycles(jump), increment, start)?;
            next_starts.push(&state.contact);
            half_widths.push(state.contact.half_width(&self.pair.slave().x));
            let is_reported = !is_unskewed && !replays.are_planned();
            self.record(&mut record, state, step.at, &mut replays, is_reported);
            if step.at == Some(Position::Leftmost) {
                passes.between = Some(self.equivalents(&state.depth));
            }
            if step.at == Some(Position::Neutral) {
                neutral = record.friction_loop.displacement_mm.len();
            }
            done += 1;
            if self.spines.are_worn_through(&state.depth) {
                break;
            }
        }
        if is_unskewed && done == steps.len() {
            let after = self.equivalents(&state.depth);
            state.skew.update(&passes, &after, jump);
            let step = self.scene.motion.amplitude_mm().abs() * 4.0 / real(steps.len());
            self.remove_skew(state, &mut record, step, detailed);
        }
        let cycles = if done == steps.len() {
            record.friction_loop.begin_at(neutral);
            jump
        } else {
            cycles_at_least(real_cycles(jump) * real(done) / real(steps.len())).min(jump)
        };
        self.count(state, cycles);
        state.wear_of_strokes[1] = self.wear_per_cycle(state, &before, cycles);
        state.friction_per_cycle = 0.5 * (friction + self.pair.interface.friction);
        state.energy_per_cycle = (state.energy - energy) / real_cycles(cycles);
        state.mean_half_width = half_widths.mean_mm().unwrap_or(state.mean_half_width);
        state.computed_cycles += 1;
        state.warm_starts = next_starts;
        state.most_increments = state.most_increments.max(steps.len());
        Ok(record)
    }

    /// Counts cycles done.
    fn count(&self, state: &mut CycleState, cycles: u64) {
        state.cycle += cycles;
        state.sliding_distance += self.scene.motion.distance_per_cycle_mm() * real_cycles(cycles);
    }

    fn record(
        &mut self,
        record: &mut CycleRecord,
        state: &mut CycleState,
        at: Option<Position>,
        replays: &mut Replays,
        is_reported: bool,
    ) {
        let contact = &state.contact;
        let widths = &self.pair.slave().widths;
        let force = contact.tangential_force(&self.pair.interface, widths);
        let point = (contact.slider_x, force);
        record.friction_loop.extend(&[point]);
        let Some(position) = at else { return };
        let replayed = replays.take(position);
        if replayed.is_some() || is_reported {
            let end = replayed.as_ref().unwrap_or(state);
            let balance = self.force_balance_with_present_normals(end);
            let worst = &mut state.checks.force_balance_present_normals;
            *worst = worst.max(balance);
        }
        let contact = replayed.map_or_else(|| state.contact.clone(), |end| end.contact);
        if position == Position::Neutral {
            state.neutral = Neutral::of(&contact, &self.pair);
        }
        record.contacts.push((position, contact));
    }
}
