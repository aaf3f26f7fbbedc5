//! What routes about one job share: finding it, and why it cannot be had.

use axum::response::{IntoResponse, Response};
use uuid::Uuid;

use crate::http::App;
use crate::http::problem::{Kind, Refusal};
use crate::store::{StoreError, StoredJob};

/// Why a job cannot be had.
#[derive(Debug, thiserror::Error)]
pub(super) enum JobError {
    /// There is none of that id.
    #[error("there is no job {0}")]
    Missing(Uuid),
    /// It has not ended.
    #[error("job {0} has not ended; cancel it first, or wait")]
    Active(Uuid),
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl From<&JobError> for Refusal {
    fn from(error: &JobError) -> Self {
        match error {
            JobError::Missing(_) => Kind::NoJob.because(error.to_string()),
            JobError::Active(_) => Kind::Active.because(error.to_string()),
            JobError::Store(error) => Self::from(error),
        }
    }
}

impl IntoResponse for JobError {
    fn into_response(self) -> Response {
        Refusal::from(&self).into_response()
    }
}

impl App {
    /// A job that is there.
    pub(super) async fn job(&self, id: Uuid) -> Result<StoredJob, JobError> {
        self.store.job(id).await?.ok_or(JobError::Missing(id))
    }
}
