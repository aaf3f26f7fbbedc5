//! Lookup of a batch, and the errors of its routes.

use uuid::Uuid;

use crate::batch::{EvaluateError, ExpandError, Kind};
use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::store::{BatchDetail, StoredBatch};

/// Error of a route about one batch.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum BatchError {
    /// No batch of this kind has this id.
    #[error("there is no {0} {1}")]
    Missing(Kind, Uuid),
    /// A job of the batch has not ended.
    #[error("{0} {1} has jobs that have not ended; cancel it first")]
    Active(Kind, Uuid),
}

impl RouteError for BatchError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Missing(Kind::Sweep, _) => ProblemType::NoSuchSweep,
            Self::Missing(Kind::AccuracyStudy, _) => ProblemType::NoSuchStudy,
            Self::Active(Kind::Sweep, _) => ProblemType::SweepActive,
            Self::Active(Kind::AccuracyStudy, _) => ProblemType::StudyActive,
        }
    }
}

impl RouteError for EvaluateError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Empty(_) => ProblemType::NoSuchResult,
            Self::Format { .. } => ProblemType::StudyOutdated,
            Self::Corrupt { .. } | Self::Write(_) => ProblemType::Internal,
        }
    }
}

impl From<ExpandError> for ProblemResponse {
    fn from(error: ExpandError) -> Self {
        match error {
            ExpandError::Refused(refused) => refused.into(),
            ExpandError::Unmeasured | ExpandError::Write(_) => Self::internal(&error),
        }
    }
}

impl App {
    /// Checks that a batch of this kind exists.
    pub(super) async fn require_batch(&self, kind: Kind, id: Uuid) -> Result<(), ProblemResponse> {
        if self.store.has_batch(id, kind.has_plan()).await? {
            Ok(())
        } else {
            Err(BatchError::Missing(kind, id).into())
        }
    }

    /// Reads a batch and evaluates it on a thread of its own: dozens of profiles may be read and compared.
    pub(super) async fn evaluate_batch<T: Send + 'static>(
        &self,
        kind: Kind,
        id: Uuid,
        detail: BatchDetail,
        evaluate: impl FnOnce(StoredBatch) -> Result<T, EvaluateError> + Send + 'static,
    ) -> Result<T, ProblemResponse> {
        let missing = || BatchError::Missing(kind, id);
        let read = |batch: Option<StoredBatch>| {
            let batch = batch.filter(|batch| kind.includes(batch));
            batch.ok_or_else(missing)
        };
        // The plan first: beside one of another format, results need not be readable.
        if kind.has_plan() {
            let statuses = read(self.store.batch(id, BatchDetail::Statuses).await?)?;
            kind.check_plan(&statuses)?;
        }
        let batch = read(self.store.batch(id, detail).await?)?;
        Ok(tokio::task::spawn_blocking(move || evaluate(batch)).await??)
    }
}
