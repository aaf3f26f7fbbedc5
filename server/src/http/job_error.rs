//! Lookup of a job, and its errors.

use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::store::StoredJob;

/// Error of a route about one job.
#[derive(Debug, thiserror::Error)]
pub(super) enum JobError {
    /// No job has this id.
    #[error("there is no job {0}")]
    Missing(Uuid),
    /// The job has not ended.
    #[error("job {0} has not ended; cancel it first, or wait")]
    Active(Uuid),
    /// The job has succeeded.
    #[error("job {0} has succeeded; there is nothing to try again")]
    Succeeded(Uuid),
    /// The job was deleted between its submission and the response.
    #[error("job {0} was deleted right after its submission")]
    Deleted(Uuid),
}

impl RouteError for JobError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Missing(_) | Self::Deleted(_) => ProblemType::NO_SUCH_JOB,
            Self::Active(_) => ProblemType::JOB_ACTIVE,
            Self::Succeeded(_) => ProblemType::JOB_SUCCEEDED,
        }
    }
}

impl App {
    /// Returns a job, or the problem that there is none.
    pub(super) async fn job(&self, id: Uuid) -> Result<StoredJob, ProblemResponse> {
        Ok(self.store.job(id).await?.ok_or(JobError::Missing(id))?)
    }
}
