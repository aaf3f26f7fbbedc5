//! Checkpoints: everything that the rest of a run depends on besides its scene.

mod earlier;
mod mismatch;
mod run;
mod section;

use serde::{Deserialize, Serialize};

pub(crate) use earlier::EarlierRuns;
pub(crate) use earlier::Finished;
pub use mismatch::CheckpointMismatch;
pub use run::{ExtrudedRun, LineRun, PointRun, Run, SectionRun};
pub use section::SectionState;

/// A run between two computed cycles. It survives serialisation bit for bit in any format that preserves `f64`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Checkpoint {
    /// Of a section.
    Section(Box<SectionRun>),
    /// Of a point contact.
    Point(Box<PointRun>),
    /// Of a contact along a line.
    Line(Box<LineRun>),
    /// Of extruded bodies.
    Extruded(Box<ExtrudedRun>),
}

/// A run that a checkpoint can be taken of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Resumable<'a> {
    /// Of a section.
    Section(&'a SectionRun),
    /// Of a point contact.
    Point(&'a PointRun),
    /// Of a contact along a line.
    Line(&'a LineRun),
    /// Of extruded bodies.
    Extruded(&'a ExtrudedRun),
}

impl Resumable<'_> {
    /// Physical cycles whose results were delivered.
    pub fn cycle(self) -> u64 {
        let (earlier, cycle) = match self {
            Self::Section(run) => (&run.earlier, run.state.cycle_state.cycle),
            Self::Point(run) => (&run.earlier, run.state.cycle()),
            Self::Line(run) => (&run.earlier, run.state.cycle()),
            Self::Extruded(run) => (&run.earlier, run.state.cycle()),
        };
        let finished = earlier.finished.as_ref();
        finished.map_or(cycle, |finished| finished.summary.last.cycle)
    }

    /// The checkpoint of the run.
    pub fn checkpoint(self) -> Checkpoint {
        match self {
            Self::Section(run) => Checkpoint::Section(Box::new(run.clone())),
            Self::Point(run) => Checkpoint::Point(Box::new(run.clone())),
            Self::Line(run) => Checkpoint::Line(Box::new(run.clone())),
            Self::Extruded(run) => Checkpoint::Extruded(Box::new(run.clone())),
        }
    }
}

impl Checkpoint {
    /// Physical cycles whose results were delivered.
    pub fn cycle(&self) -> u64 {
        self.as_resumable().cycle()
    }

    /// The run of the checkpoint, as an event delivers it.
    pub(crate) fn as_resumable(&self) -> Resumable<'_> {
        match self {
            Self::Section(run) => Resumable::Section(run),
            Self::Point(run) => Resumable::Point(run),
            Self::Line(run) => Resumable::Line(run),
            Self::Extruded(run) => Resumable::Extruded(run),
        }
    }

    /// The runs before it.
    pub(crate) fn earlier(&self) -> &EarlierRuns {
        match self {
            Self::Section(run) => &run.earlier,
            Self::Point(run) => &run.earlier,
            Self::Line(run) => &run.earlier,
            Self::Extruded(run) => &run.earlier,
        }
    }

    /// The same, to be changed.
    pub(crate) fn earlier_mut(&mut self) -> &mut EarlierRuns {
        match self {
            Self::Section(run) => &mut run.earlier,
            Self::Point(run) => &mut run.earlier,
            Self::Line(run) => &mut run.earlier,
            Self::Extruded(run) => &mut run.earlier,
        }
    }
}
