//! Lookup of a batch, and the errors of its routes.

use std::sync::Arc;

use uuid::Uuid;

use crate::batch::{EvaluateError, ExpandError, Kind};
use crate::http::app::App;
use crate::http::extract::BatchId;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::store::{BatchDetail, BatchEnding, BatchPart, StoredBatch};

/// Jobs that are shown of a batch unless fewer are asked for.
pub(super) const MOST_JOBS: u32 = 1_000;

/// Error of a route about one batch.
#[derive(Debug, thiserror::Error)]
pub(crate) enum BatchError {
    /// No batch of this kind has this id.
    #[error("there is no {0}")]
    Missing(BatchId),
    /// A job of the batch has not ended.
    #[error("{0} has jobs that have not ended; cancel it first")]
    Active(BatchId),
    /// All jobs of the batch were deleted.
    #[error("the jobs of {0} were deleted, and with them its specification")]
    Empty(BatchId),
    /// No number of jobs.
    #[error("a part has 1 to {MOST_JOBS} jobs, not {0}")]
    Limit(u32),
}

impl RouteError for BatchError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Missing(batch) => match batch.kind {
                Kind::Sweep => ProblemType::NO_SUCH_SWEEP,
                Kind::AccuracyStudy => ProblemType::NO_SUCH_STUDY,
            },
            Self::Active(batch) => match batch.kind {
                Kind::Sweep => ProblemType::SWEEP_ACTIVE,
                Kind::AccuracyStudy => ProblemType::STUDY_ACTIVE,
            },
            Self::Empty(_) => ProblemType::NO_SUCH_RESULT,
            Self::Limit(_) => ProblemType::INVALID_QUERY,
        }
    }
}

impl RouteError for EvaluateError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Empty(_) => ProblemType::NO_SUCH_RESULT,
            Self::Format { .. } => ProblemType::STUDY_OUTDATED,
            Self::Corrupt { .. } | Self::Write(_) => ProblemType::INTERNAL,
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
    pub(super) async fn require_batch(&self, batch: BatchId) -> Result<(), ProblemResponse> {
        let exists = self
            .store
            .has_batch(batch.id, batch.kind.has_plan())
            .await?;
        Ok(exists.then_some(()).ok_or(BatchError::Missing(batch))?)
    }

    /// Cancels or deletes the first jobs of a batch, whether the client waits for it or not. A task of the service continues with those that are
    /// left.
    pub(super) async fn end_jobs_of(
        &self,
        batch: Uuid,
        ending: BatchEnding,
    ) -> Result<(), ProblemResponse> {
        let store = Arc::clone(&self.store);
        tokio::spawn(async move { store.end_jobs_of(batch, ending).await }).await??;
        Ok(())
    }

    /// Reads a batch and evaluates it on a thread of its own: dozens of profiles may be read and compared.
    pub(super) async fn evaluate_batch<T: Send + 'static>(
        &self,
        batch: BatchId,
        part: BatchPart,
        detail: BatchDetail,
        evaluate: impl FnOnce(StoredBatch) -> Result<T, EvaluateError> + Send + 'static,
    ) -> Result<T, ProblemResponse> {
        let BatchId { kind, id } = batch;
        let read = |stored: Option<StoredBatch>| {
            let stored = stored.filter(|stored| kind.includes(stored));
            stored.ok_or(BatchError::Missing(batch))
        };
        // The plan first: beside one of another format, results need not be readable.
        if kind.has_plan() {
            let statuses = read(
                self.store
                    .batch(id, BatchPart { from: 0, limit: 0 }, BatchDetail::Statuses)
                    .await?,
            )?;
            kind.check_plan(&statuses)?;
        }
        let stored = read(self.store.batch(id, part, detail).await?)?;
        Ok(tokio::task::spawn_blocking(move || evaluate(stored)).await??)
    }
}
