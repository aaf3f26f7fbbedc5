//! Errors of expanding and evaluating a batch.

use uuid::Uuid;

use crate::export::documents::DocumentError;
use crate::spec::Refused;

/// Why a request cannot be expanded.
#[derive(Debug, thiserror::Error)]
pub enum ExpandError {
    /// The batch, or a job of it, has faults.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// Runs are chosen by their expected time, and the machine's speed is unknown.
    #[error("the machine that the runs are chosen for could not be measured")]
    Unmeasured,
    /// The evaluation plan cannot be encoded.
    #[error("writing the evaluation plan: {0}")]
    Write(#[from] serde_json::Error),
}

/// Why a batch cannot be evaluated.
#[derive(Debug, thiserror::Error)]
pub enum EvaluateError {
    /// There is nothing to compare with yet.
    #[error("no job of study {0} has a result that others can be compared with so far")]
    Empty(Uuid),
    /// The evaluation plan was stored by another version of this program.
    #[error("study {id} was stored in format {found}, this program compares format {supported}")]
    Format {
        /// The study.
        id: Uuid,
        /// Format.
        found: u32,
        /// The format that can be compared.
        supported: u32,
    },
    /// A stored document cannot be read.
    #[error("{id}: stored {what} cannot be read: {cause}")]
    Corrupt {
        /// The study or job.
        id: Uuid,
        /// The document.
        what: &'static str,
        /// Why.
        cause: serde_json::Error,
    },
    /// The table or picture cannot be made.
    #[error(transparent)]
    Write(#[from] DocumentError),
}
