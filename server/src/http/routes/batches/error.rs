//! Access to one batch, and why it fails.

use axum::response::{IntoResponse, Response};
use uuid::Uuid;

use crate::batch::{EvaluateError, Kind};
use crate::http::App;
use crate::http::problem::{self, Refusal};
use crate::store::{BatchDetail, StoreError, StoredBatch};

/// Why a request about one batch fails.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum BatchError {
    /// There is no batch of that kind and id.
    #[error("there is no {0} {1}")]
    Missing(Kind, Uuid),
    /// A job of it has not ended.
    #[error("{0} {1} has jobs that have not ended; cancel it first")]
    Active(Kind, Uuid),
    /// It cannot be evaluated.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// The evaluation was interrupted.
    #[error("the batch was not evaluated: {0}")]
    Interrupted(#[from] tokio::task::JoinError),
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl IntoResponse for BatchError {
    fn into_response(self) -> Response {
        let kind = match &self {
            Self::Missing(Kind::Sweep, _) => problem::Kind::NoSweep,
            Self::Missing(Kind::AccuracyStudy, _) => problem::Kind::NoStudy,
            Self::Active(Kind::Sweep, _) => problem::Kind::SweepActive,
            Self::Active(Kind::AccuracyStudy, _) => problem::Kind::StudyActive,
            Self::Evaluate(EvaluateError::Empty(_)) => problem::Kind::NoResult,
            Self::Evaluate(EvaluateError::Format { .. }) => problem::Kind::OldStudy,
            Self::Evaluate(error) => return Refusal::internal(error).into_response(),
            Self::Interrupted(error) => return Refusal::internal(error).into_response(),
            Self::Store(error) => return Refusal::from(error).into_response(),
        };
        kind.because(self.to_string()).into_response()
    }
}

impl App {
    /// Checks that a batch of this kind exists.
    pub(super) async fn require_batch(&self, kind: Kind, id: Uuid) -> Result<(), BatchError> {
        if self.store.has_batch(id, kind.has_plan()).await? {
            Ok(())
        } else {
            Err(BatchError::Missing(kind, id))
        }
    }

    /// Reads a batch and evaluates it on a thread of its own: dozens of profiles may be read and compared.
    pub(super) async fn evaluate_batch<T: Send + 'static>(
        &self,
        kind: Kind,
        id: Uuid,
        detail: BatchDetail,
        evaluate: impl FnOnce(StoredBatch) -> Result<T, EvaluateError> + Send + 'static,
    ) -> Result<T, BatchError> {
        let batch = self.store.batch(id, detail).await?;
        let batch = batch.filter(|batch| kind.includes(batch));
        let batch = batch.ok_or(BatchError::Missing(kind, id))?;
        Ok(tokio::task::spawn_blocking(move || evaluate(batch)).await??)
    }
}
