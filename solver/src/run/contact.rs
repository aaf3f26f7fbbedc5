//! Bodies in contact as a run drives them, and their contact: of a section, a point, a line or extruded bodies.

mod computed;
mod extruded;
mod line;
pub(super) mod plane;
mod point;
mod sections;

use std::borrow::Cow;

use crate::SolveError;
use crate::change::Change;
use crate::checkpoint::{Resumable, Run};
use crate::effects::EffectsPlan;
use crate::electrical::{ContactResistance, ElectricalState, Evaluation, Touching};
use crate::observer::Observer;
use crate::record::{Checks, CycleReport, Exposed, Outcome, Resolution, Snapshot, WornArea};
use crate::scene::{Motion, Scene};
use crate::schedule::mission_state::BlockWear;
use crate::sides::{Side, Sides};

/// The run of bodies.
pub(super) type RunOf<B> = Run<<B as Bodies>::State, <B as Bodies>::History>;

/// The run of a contact.
pub(super) type RunOfContact<C> = Run<<C as Contact>::State, <C as Contact>::History>;

/// Two bodies with the stiffness and the effects that their contact is computed with, both of which outlive a computed cycle.
pub(super) trait Bodies: Sized {
    /// State between two computed cycles.
    type State: Clone;
    /// History that the cycles of a motion leave for later ones of the same motion.
    type History: Default;
    /// Their contact.
    type Contact<'a>: Contact<State = Self::State, History = Self::History>
    where
        Self: 'a;

    /// True if meshing and condensing them are phases of their own; all of the run is one phase otherwise.
    const HAS_PHASES: bool = false;

    /// The unworn bodies without load, by a plan.
    fn unworn(
        scene: &Scene,
        plan: &EffectsPlan,
        observer: &mut dyn Observer,
    ) -> Result<Self, SolveError>;

    /// The bodies of a checkpoint's state, which takes the laws of the plan.
    ///
    /// # Errors
    /// Among others if the state is not one of this scene.
    fn resumed(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut Self::State,
        observer: &mut dyn Observer,
    ) -> Result<Self, SolveError>;

    /// The bodies with the effects of another plan, in a state if they are loaded.
    fn with_effects(
        self,
        scene: &Scene,
        plan: &EffectsPlan,
        state: Option<&mut Self::State>,
        observer: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        match state {
            Some(state) => Self::resumed(scene, plan, state, observer),
            None => Self::unworn(scene, plan, observer),
        }
    }

    /// The unworn bodies with wider zones of fine elements.
    fn widened(self, _: &Scene) -> Result<Self, SolveError> {
        Ok(self)
    }

    /// The bodies with the stiffness of their worn shapes.
    fn renewed(
        self,
        _: &Scene,
        _: &mut Self::State,
        _: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        Ok(self)
    }

    /// Their contact in a block of a mission, or in the whole run.
    fn contact<'a>(&'a mut self, block: &'a Scene) -> Self::Contact<'a>;
}

/// A contact that computes its cycles. Methods with a default are of features that not every contact has.
pub(super) trait Contact: Sized {
    /// State between two computed cycles.
    type State: Clone;
    /// History that the cycles of a motion leave for later ones of the same motion.
    type History: Default;
    /// Worn surfaces, read once a cycle.
    type Worn;

    /// Applies the load to the unworn bodies: cycle 0.
    fn load(&mut self) -> Result<Self::State, SolveError>;

    /// Moves the slider to the turning point where cycles begin, unless the first cycle does.
    fn initial_quarter(&mut self, _: &mut Self::State) -> Result<(), SolveError> {
        Ok(())
    }

    /// Computes the next cycle up to a number of them; the state after these may be reported in detail.
    fn compute_cycle(
        &mut self,
        state: &mut Self::State,
        until: u64,
        is_reported: bool,
    ) -> Result<(), SolveError>;

    /// Returns `true` if the stiffness must follow the worn shapes before the next cycle.
    fn has_drifted(&self, _: &Scene, _: &Self::State) -> bool {
        false
    }

    /// Records that the zones of fine elements must be wider.
    fn widen(_: &mut Self::State) {}

    /// Restores the state before a cycle that has passed a limit by too much; effort of both counts.
    fn restore(state: &mut Self::State, before: Self::State) {
        *state = before;
    }

    fn cycle(state: &Self::State) -> u64;
    /// Largest worn depth of each side, mm.
    fn max_depth_mm(state: &Self::State) -> Sides<f64>;
    /// Largest wear of a place of each side per cycle, as equivalent depth, mm.
    fn fastest_rate(state: &Self::State) -> Sides<f64>;
    /// Wear per cycle by which the deepest place of a side would come to an equivalent depth in mm as soon as the first place does, mm; by default the
    /// largest.
    fn rate_toward(state: &Self::State, side: Side, _limit: f64) -> f64 {
        *Self::fastest_rate(state).of(side)
    }
    /// Cycles in which a body would be worn through at the present rates.
    fn cycles_left(&self, _: &Self::State) -> f64 {
        f64::INFINITY
    }
    /// Returns `true` if a body is worn through.
    fn is_worn_through(&self, _: &Self::State) -> bool {
        false
    }
    /// Why it cannot be worn on besides.
    fn ending(&self) -> Option<Outcome> {
        None
    }

    /// Moves the slider from the turning point of another motion to that of the present one, without wear.
    fn change_motion(&mut self, state: &mut Self::State, from: Motion) -> Result<(), SolveError>;
    /// Totals of the wear so far, for the blocks of a mission.
    fn totals(&self, state: &Self::State) -> BlockWear;
    /// Worn depths of the nodes that the totals are given at, mm, or values that grow with these.
    fn nodal_depths<'a>(&self, state: &'a Self::State) -> Sides<Cow<'a, [f64]>>;
    /// Cycles in which a body would be worn through at these rates of the nodes, mm a cycle.
    fn cycles_left_at(&self, _: &Self::State, _rates: Sides<&[f64]>) -> f64 {
        f64::INFINITY
    }
    /// Takes out what belongs to the present motion.
    fn take_history(state: &mut Self::State) -> Self::History;
    /// Continues with what cycles of the next motion have left.
    fn continue_motion(state: &mut Self::State, history: Self::History);

    /// The contact as its resistance depends on it at a moment between two states.
    fn touching(
        &self,
        scene: &Scene,
        evaluation: &Evaluation<'_>,
        states: Change<&Self::State>,
        moment: Moment,
    ) -> Touching;
    /// Takes the resistance of the contact, which a current heats.
    fn follow_resistance(_: &mut Self::State, _: &ElectricalState) {}

    fn worn(&self, state: &Self::State) -> Self::Worn;
    /// The worn surface of a side.
    fn surface<'a>(
        &'a self,
        state: &'a Self::State,
        worn: &'a Self::Worn,
        side: Side,
    ) -> impl Exposed + 'a;
    fn report(
        &self,
        scene: &Scene,
        state: &Self::State,
        worn: &Self::Worn,
        resistance: Option<&ContactResistance>,
    ) -> CycleReport;
    /// The snapshot of the state after the last computed cycle.
    fn snapshot(
        &self,
        scene: &Scene,
        state: &Self::State,
        worn: &Self::Worn,
    ) -> Result<Snapshot, SolveError>;
    fn resolution(&self, run: &RunOfContact<Self>) -> Resolution;
    /// Worst residuals so far, with the last report.
    fn checks(&self, state: &Self::State, last: &CycleReport) -> Checks;
    /// The run as that of a checkpoint.
    fn resumable(run: &RunOfContact<Self>) -> Resumable<'_>;
}

/// Worn surfaces of a contact of a width: its places, and the scars that they form.
pub(super) struct Worn<P> {
    places: P,
    scars: Sides<WornArea>,
}

/// Moment of a computed cycle that stands for many.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    /// Part of the cycles that is done.
    pub(super) part: f64,
    /// Time since the run began, s; 0 of a continuous motion.
    pub(super) time_s: f64,
    /// Depths of both sides that no place has passed, mm.
    pub(super) deepest: Sides<f64>,
}
