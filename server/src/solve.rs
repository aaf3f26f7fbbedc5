//! Running the engine in this process: its events as documents, and what it cost.

pub mod checkpoint;
mod cost;

use std::ops::ControlFlow;

use api::job::{Outcome, Phase};
use api::results::{Cost, ResultFile, Snapshot, Summary};
use serde::{Deserialize, Serialize};
use solver::SolveError;
use solver::checkpoint::Checkpoint;
use solver::observer::{self, Event, Observer};
use solver::record::{CycleReport, PlacedFields};
use solver::scene::Scene;

use crate::export::{history, vtu};
use checkpoint::{Encoded, Keeping, Saved};
use cost::Stopwatch;
pub use cost::{children_cpu_s, cpu_s, thread_cpu_s};

/// Exit code of a solving process that could not write a result: the disk's fault, so it is tried again.
pub const UNWRITTEN: i32 = 4;

/// One line of a solving process, in order; the last one is `Summary`, `Failed` or `Stopped`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", content = "data", rename_all = "snake_case")]
pub enum Line {
    /// Another phase begins.
    Phase(Phase),
    /// A computed cycle is done.
    Cycle(CycleReport),
    /// A requested snapshot.
    Snapshot(Box<Snapshot>),
    /// Fields inside the bodies at one position of a snapshot; never sent, but written where it was computed.
    #[serde(skip)]
    Fields(FieldsFile),
    /// A file was written into the attempt's folder.
    Kept(ResultFile),
    /// The first line, where the checkpoint that was to be gone on from cannot be: the run begins anew.
    Anew(String),
    /// A place to go on from; what belongs to its cycle came before.
    Checkpoint(Encoded),
    /// The run ended with a result.
    Summary(Box<Summary>),
    /// The run failed; the same input would fail again.
    Failed(Failure),
    /// The process was asked to end, and did so after a checkpoint.
    Stopped,
}

/// Fields as a file.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldsFile {
    /// Its name.
    pub name: String,
    /// The cycle.
    pub cycle: u64,
    /// Its content, VTU.
    pub bytes: Vec<u8>,
}

/// A solver's own failure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[error("{reason}")]
pub struct Failure {
    /// How the solve ended.
    pub outcome: Outcome,
    /// Why, with numbers.
    pub reason: String,
}

impl From<SolveError> for Failure {
    fn from(error: SolveError) -> Self {
        Self {
            outcome: Outcome::NotConverged,
            reason: error.to_string(),
        }
    }
}

/// Solves a scene. `on` receives each line but the last, and may stop the run.
///
/// # Errors
/// [`Failure`] with the engine's numbers.
pub fn run(scene: &Scene, on: &mut dyn FnMut(Line) -> ControlFlow<()>) -> Result<Summary, Failure> {
    run_from(scene, None, &Keeping::default(), on)
}

/// Solves a scene from a checkpoint, if there is one, and tells checkpoints on the way. A checkpoint that does not fit
/// the scene is told, and the run begins anew.
///
/// # Errors
/// [`Failure`] with the engine's numbers.
pub fn run_from(
    scene: &Scene,
    from: Option<Saved>,
    keeping: &Keeping,
    on: &mut dyn FnMut(Line) -> ControlFlow<()>,
) -> Result<Summary, Failure> {
    let Some(Saved { cost, run }) = from else {
        return anew(scene, Recorder::new(on, keeping, Cost::default()));
    };
    let mut recorder = Recorder::new(on, keeping, cost);
    match solver::run::resume(scene, run, &mut recorder) {
        Err(SolveError::Checkpoint(misfit)) => {
            let mut recorder = Recorder::new(on, keeping, Cost::default());
            recorder.note(Line::Anew(misfit.to_string()));
            anew(scene, recorder)
        }
        ended => Ok(history::summary(&ended?, recorder.watch.cost())),
    }
}

fn anew(scene: &Scene, mut recorder: Recorder<'_>) -> Result<Summary, Failure> {
    let summary = solver::run::solve(scene, &mut recorder)?;
    Ok(history::summary(&summary, recorder.watch.cost()))
}

struct Recorder<'a> {
    on: &'a mut dyn FnMut(Line) -> ControlFlow<()>,
    keeping: &'a Keeping,
    watch: Stopwatch,
    /// Set by a line that was refused where the run could not be stopped; the next event stops it.
    refused: bool,
}

impl<'a> Recorder<'a> {
    fn new(
        on: &'a mut dyn FnMut(Line) -> ControlFlow<()>,
        keeping: &'a Keeping,
        earlier: Cost,
    ) -> Self {
        Self {
            on,
            keeping,
            watch: Stopwatch::start(earlier),
            refused: false,
        }
    }

    /// Sends a line that belongs to no event of the run.
    fn note(&mut self, line: Line) {
        self.refused |= (self.on)(line).is_break();
    }

    /// Tells a checkpoint if one is due, and stops the run if it is asked to.
    fn keep(&mut self, run: &Checkpoint) -> ControlFlow<()> {
        if !self.keeping.is_due() {
            return ControlFlow::Continue(());
        }
        let saved = Saved {
            cost: self.watch.cost(),
            run: run.clone(),
        };
        let told = match saved.encode() {
            Ok(state) => (self.on)(Line::Checkpoint(Encoded {
                cycle: run.cycle(),
                state,
            })),
            Err(error) => {
                tracing::error!(%error, "a checkpoint was left out");
                ControlFlow::Continue(())
            }
        };
        if self.keeping.stops() {
            ControlFlow::Break(())
        } else {
            told
        }
    }
}

impl Recorder<'_> {
    fn fields(&mut self, cycle: u64, fields: &PlacedFields) -> ControlFlow<()> {
        let name = vtu::file_name(cycle, fields.position);
        match vtu::bytes(fields) {
            Ok(bytes) => (self.on)(Line::Fields(FieldsFile { name, cycle, bytes })),
            Err(error) => {
                tracing::error!(%error, name, "fields were left out");
                ControlFlow::Continue(())
            }
        }
    }
}

impl Observer for Recorder<'_> {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        if self.refused {
            return ControlFlow::Break(());
        }
        let line = match event {
            Event::Cycle(report) => Line::Cycle(report.clone()),
            Event::Snapshot(snapshot) => {
                for fields in &snapshot.fields {
                    self.fields(snapshot.cycle, fields)?;
                }
                Line::Snapshot(Box::new(history::snapshot(snapshot)))
            }
            Event::Checkpoint(run) => return self.keep(run),
        };
        (self.on)(line)
    }

    fn on_phase(&mut self, phase: observer::Phase) {
        let phase = history::phase(phase);
        self.watch.enter(phase);
        self.note(Line::Phase(phase));
    }
}
