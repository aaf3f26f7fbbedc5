//! The protocol between a solving process (`fretwear solve-child`) and its supervisor.
//!
//! Standard input: two lines of JSON, the resolved specification and the checkpoint to resume from (`null` for none).
//! The pipe is open as long as the supervisor lives; the process ends when it closes. Standard output: one [`ChildMessage`] (JSON)
//! a line, the first of them [`ChildMessage::Ready`]: a process that ends before it was not started, whatever its job is. Files are written into the attempt's folder, and the lines only name them. SIGTERM asks for a checkpoint
//! after the current cycle and the end of the process.

use std::io::BufRead;

use api::job::{Outcome, Phase};
use api::results::{ResultFile, Snapshot, Summary};
use serde::{Deserialize, Serialize};
use solver::SolveError;
use solver::record::CycleReport;

use crate::export::documents::Document;
use crate::solve::checkpoint::{Checkpoint, EncodedCheckpoint};

/// The command of a solving process, its first argument.
pub(crate) const COMMAND: &str = "solve-child";
/// Exit code of a solving process whose supervisor has ended.
pub(crate) const EXIT_ORPHANED: i32 = 3;
/// Exit code of a solving process that could not write a file: not a failure of the solve, so the job is tried again.
pub(crate) const EXIT_FILE_NOT_WRITTEN: i32 = 4;

/// Exit code of a solving process whose files have no space on the disk: a fault of the machine, which releases the job.
pub(crate) const EXIT_DISK_FULL: i32 = 5;

/// One line of a solving process, in order; the last one is `Summary`, `Failed` or `Stopped`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", content = "data", rename_all = "snake_case")]
pub enum ChildMessage {
    /// The process has started, and reads its input.
    Ready,
    /// The next phase starts.
    Phase(Phase),
    /// A computed cycle.
    Cycle(Box<CycleReport>),
    /// A requested snapshot.
    Snapshot(Box<Snapshot>),
    /// Fields inside the bodies at one position of a snapshot, or maps of the contact; written by the solving process, never sent.
    #[serde(skip)]
    Fields(Document),
    /// A file in the attempt's folder.
    File(ResultFile),
    /// The run restarts at cycle 0, with the cause: it cannot resume from its checkpoint, or its estimated error
    /// exceeds the tolerance. Earlier lines are discarded.
    Restarted(String),
    /// The run that follows is the finer one, from cycle 0 or a checkpoint; with the errors of the first one.
    Refined(String),
    /// A checkpoint, sent after all lines up to its cycle.
    Checkpoint(EncodedCheckpoint),
    /// The result of the run.
    Summary(Box<Summary>),
    /// The failure of the run; the same input would fail again.
    Failed(Failure),
    /// The process was asked to end and has sent its last checkpoint.
    Stopped,
}

impl ChildMessage {
    /// Returns `true` if it is the last line of a run.
    pub(crate) fn is_last(&self) -> bool {
        matches!(self, Self::Summary(_) | Self::Failed(_) | Self::Stopped)
    }
}

/// A failure of the solve itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[error("{reason}")]
pub struct Failure {
    /// Outcome of the job.
    pub outcome: Outcome,
    /// The cause, with its numbers.
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

/// Input of a solving process.
#[derive(Debug)]
pub(crate) struct Input {
    /// The resolved specification, JSON.
    pub(crate) spec: String,
    checkpoint: String,
}

impl Input {
    /// Returns the input as lines.
    pub(super) fn lines(
        spec: &str,
        checkpoint: Option<&EncodedCheckpoint>,
    ) -> serde_json::Result<String> {
        let checkpoint = serde_json::to_string(&checkpoint)?;
        Ok(format!("{spec}\n{checkpoint}\n"))
    }

    /// Reads the input from standard input.
    pub(crate) fn read(mut from: impl BufRead) -> std::io::Result<Self> {
        let (mut spec, mut checkpoint) = (String::new(), String::new());
        from.read_line(&mut spec)?;
        from.read_line(&mut checkpoint)?;
        Ok(Self { spec, checkpoint })
    }

    /// Returns the checkpoint to resume from, or why it cannot be decoded.
    pub(crate) fn checkpoint(&self) -> Result<Option<Checkpoint>, String> {
        let encoded: Option<EncodedCheckpoint> =
            serde_json::from_str(&self.checkpoint).map_err(|cause| cause.to_string())?;
        let decoded = encoded.map(|encoded| Checkpoint::decode(&encoded.state));
        decoded.transpose().map_err(|cause| cause.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_is_read_as_it_was_written() {
        let checkpoint = EncodedCheckpoint {
            cycle: 1,
            state: vec![0xff],
        };
        let read = |checkpoint| {
            let text = Input::lines("{}", checkpoint).expect("JSON");
            Input::read(text.as_bytes()).expect("two lines")
        };
        let without = read(None);
        assert_eq!(
            (without.spec.trim(), without.checkpoint()),
            ("{}", Ok(None))
        );
        let with = read(Some(&checkpoint));
        let cause = with.checkpoint().expect_err("no valid checkpoint");
        assert!(cause.starts_with("it cannot be decoded"), "{cause}");
    }
}
