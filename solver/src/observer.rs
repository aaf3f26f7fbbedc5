//! Events of a run, and how it is stopped from outside.

use std::ops::ControlFlow;

use crate::checkpoint::Resumable;
use crate::record::{CycleReport, Snapshot};

/// Receives a run's events, in order. The only dynamic dispatch of the engine.
pub trait Observer {
    /// Takes one event. `Break` ends the run at once with the outcome `Stopped`; no later event is delivered, so a
    /// checkpoint never lies beyond an event that was refused.
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()>;

    /// Another phase of the work begins.
    fn on_phase(&mut self, _phase: Phase) {}

    /// The finer run begins at cycle 0 or is resumed, because the first run has these errors.
    fn on_refined(&mut self, _errors: &str) {}
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
    Restart(&'a str),
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
