//! Events of a run, and how it is stopped from outside.

use std::ops::ControlFlow;

use crate::SolveError;
use crate::checkpoint::Resumable;
use crate::record::{CycleReport, Excess, Snapshot};
use crate::scene::Effect;

/// Receives a run's events, in order. The only dynamic dispatch of the engine.
pub trait Observer {
    /// Takes one event. `Break` ends the run at once with the outcome `Stopped`; no later event is delivered, so a
    /// checkpoint never lies beyond an event that was refused.
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()>;

    /// Another phase of the work begins.
    fn on_phase(&mut self, _phase: Phase) {}

    /// The finer run begins at cycle 0 or is resumed, because the first run has these errors.
    fn on_refined(&mut self, _errors: &[Excess]) {}
}

/// Event of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event<'a> {
    /// A computed cycle (or cycle 0, the unworn loaded state) is done.
    Cycle(&'a CycleReport),
    /// A requested snapshot.
    Snapshot(&'a Snapshot),
    /// A state that the run can be resumed from; every event up to its cycle was delivered before.
    Checkpoint(Resumable<'a>),
    /// The run restarts at cycle 0, for this reason; what was delivered before is to be discarded.
    Restart(Restart<'a>),
}

/// Why a run restarts at cycle 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Restart<'a> {
    /// The unworn contact is too wide for its zones of fine elements; it is loaded with wider ones.
    WiderZones(&'a SolveError),
    /// The load has no solution without an effect that was skipped; it is loaded with it.
    Without(Effect, &'a SolveError),
    /// The first run has errors outside of the tolerance; a finer one follows.
    Finer(&'a [Excess]),
    /// The finer run has no solution; the first one is solved again.
    NoFinerRun(&'a SolveError),
}

/// Phases of a run, for progress and cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Geometry and meshes.
    Mesh,
    /// Condensed operators.
    Condense,
    /// Contact increments and wear.
    Cycles,
    /// Moving the mesh after the worn surface.
    Relocate,
    /// Coarse companions of the run, which its error is estimated by.
    Companions,
}
