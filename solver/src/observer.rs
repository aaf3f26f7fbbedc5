//! What a run tells while it goes on, and how it is stopped from outside.

use crate::checkpoint::Checkpoint;
use crate::record::{CycleReport, Snapshot};

/// Receives a run's events, in order. The only dynamic dispatch of the engine.
pub trait Observer {
    /// Takes one event; `Flow::Stop` ends the run after the current increment with its histories kept.
    fn on(&mut self, event: Event<'_>) -> Flow;
}

/// Whether a run goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// End the run with the outcome `Stopped`.
    Stop,
}

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event<'a> {
    /// Another phase of the work begins.
    Phase(Phase),
    /// A computed cycle (or cycle 0, the unworn loaded state) is done.
    Cycle(&'a CycleReport),
    /// A requested snapshot.
    Snapshot(&'a Snapshot),
    /// A place from which the run could go on; what belongs to its cycle was told before. `Flow::Stop` is obeyed.
    Checkpoint(&'a Checkpoint),
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
}
