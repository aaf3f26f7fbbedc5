//! Running the engine in this process: its events as documents, and what it cost.

mod cost;

use api::job::{Outcome, Phase};
use api::results::{CycleRow, ResultFile, Snapshot, Summary};
use serde::{Deserialize, Serialize};
use solver::SolveError;
use solver::history::PlacedFields;
use solver::observer::{Event, Flow, Observer};
use solver::scene::Scene;

use crate::translate::{history, vtu};
use cost::Stopwatch;

/// Exit code of a solving process that could not write a result: the disk's fault, so it is tried again.
pub const UNWRITTEN: i32 = 4;

/// One line of a solving process, in order; the last one is `Summary` or `Failed`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", content = "data", rename_all = "snake_case")]
pub enum Line {
    /// Another phase begins.
    Phase(Phase),
    /// A computed cycle is done.
    Cycle(CycleRow),
    /// A requested snapshot.
    Snapshot(Box<Snapshot>),
    /// Fields inside the bodies at one position of a snapshot; never sent, but written where it was computed.
    #[serde(skip)]
    Fields(FieldsFile),
    /// A file was written into the attempt's folder.
    Kept(ResultFile),
    /// The run ended with a result.
    Summary(Box<Summary>),
    /// The run failed; the same input would fail again.
    Failed(Failure),
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
pub fn run(scene: &Scene, on: &mut dyn FnMut(Line) -> Flow) -> Result<Summary, Failure> {
    let mut recorder = Recorder {
        on,
        watch: Stopwatch::start(),
    };
    let summary = solver::run::solve(scene, &mut recorder)?;
    Ok(history::summary(&summary, recorder.watch.cost()))
}

struct Recorder<'a> {
    on: &'a mut dyn FnMut(Line) -> Flow,
    watch: Stopwatch,
}

impl Recorder<'_> {
    fn fields(&mut self, cycle: u64, fields: &PlacedFields) -> Flow {
        let name = vtu::file_name(cycle, fields.position);
        match vtu::bytes(fields) {
            Ok(bytes) => (self.on)(Line::Fields(FieldsFile { name, cycle, bytes })),
            Err(error) => {
                tracing::error!(%error, name, "fields were left out");
                Flow::Continue
            }
        }
    }
}

impl Observer for Recorder<'_> {
    fn on(&mut self, event: Event<'_>) -> Flow {
        let line = match event {
            Event::Phase(phase) => {
                let phase = history::phase(phase);
                self.watch.enter(phase);
                Line::Phase(phase)
            }
            Event::Cycle(report) => Line::Cycle(history::row(report)),
            Event::Snapshot(snapshot) => {
                for fields in &snapshot.fields {
                    if self.fields(snapshot.cycle, fields) == Flow::Stop {
                        return Flow::Stop;
                    }
                }
                Line::Snapshot(Box::new(history::snapshot(snapshot)))
            }
            Event::Checkpoint(_) => return Flow::Continue,
        };
        (self.on)(line)
    }
}
