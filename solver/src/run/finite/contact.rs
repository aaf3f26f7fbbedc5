//! A contact of finite width in a run: a point, a line or extruded bodies.

use crate::SolveError;
use crate::checkpoint::{Resumable, Run};
use crate::effects::EffectsPlan;
use crate::electrical::{AreaContact, ContactResistance};
use crate::record::{Checks, CycleReport, Exposed, Outcome, Resolution, Snapshot};
use crate::scene::Scene;
use crate::sides::Sides;

/// A contact of finite width that computes its cycles, with what a plan simulates.
pub(super) trait Contact: Sized {
    /// State between two computed cycles.
    type State: Clone;
    /// Worn depths of both bodies, read once a cycle.
    type Worn;
    /// The scar of a body.
    type Scar: Exposed;

    /// The loaded contact before any wear.
    fn start(scene: &Scene, plan: &EffectsPlan) -> Result<(Self, Self::State), SolveError>;
    /// For a state, which takes the laws of the plan.
    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut Self::State,
    ) -> Result<Self, SolveError>;
    /// Computes the next cycle up to a number of them.
    fn compute_cycle(&mut self, state: &mut Self::State, until: u64) -> Result<(), SolveError>;

    fn cycle(state: &Self::State) -> u64;
    /// Largest worn depth of each side, mm.
    fn max_depth_mm(state: &Self::State) -> Sides<f64>;
    /// Largest wear of a place of each side per cycle, as equivalent depth, mm.
    fn fastest_rate(state: &Self::State) -> Sides<f64>;
    /// Cycles in which a body would be worn through, and whether one is.
    fn cycles_left(&self) -> (f64, bool);
    /// Why it cannot be worn on besides.
    fn ending(&self) -> Option<Outcome>;
    /// The contact as its resistance depends on it after a part of the cycles between two states, with no place deeper than limits, mm; none of
    /// a contact whose resistance is not computed.
    fn areas<'a>(
        before: &'a Self::State,
        after: &'a Self::State,
    ) -> Option<impl Fn(f64, Sides<f64>) -> AreaContact + 'a>;

    fn worn(&self, state: &Self::State) -> Self::Worn;
    fn scars(worn: &Self::Worn) -> Sides<Self::Scar>;
    fn report(
        &self,
        scene: &Scene,
        state: &Self::State,
        worn: &Self::Worn,
        resistance: Option<&ContactResistance>,
    ) -> CycleReport;
    fn snapshot(
        &self,
        scene: &Scene,
        state: &Self::State,
        worn: Self::Worn,
    ) -> Result<Snapshot, SolveError>;
    fn resolution(&self, state: &Self::State) -> Resolution;
    fn checks(&self, state: &Self::State) -> Checks;

    /// The run as that of a checkpoint.
    fn resumable(run: &Run<Self::State, ()>) -> Resumable<'_>;
}
