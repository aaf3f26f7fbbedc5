//! `DELETE /v1/jobs/{id}`: deletes a job that has ended.

use api::problem::Problem;
use axum::extract::State;
use axum::http::StatusCode;

use crate::http::app::App;
use crate::http::extract::JobId;
use crate::http::job_error::JobError;
use crate::http::problem::ProblemResponse;
use crate::store::Deleted;

/// Deletes a job that has ended, with its events and results.
#[utoipa::path(
    delete,
    path = "/v1/jobs/{id}",
    tag = "jobs",
    responses(
        (status = 204, description = "Deleted"),
        (status = 409, description = "The job has not ended", body = Problem),
    )
)]
pub(crate) async fn remove(
    State(app): State<App>,
    JobId(id): JobId,
) -> Result<StatusCode, ProblemResponse> {
    match app.store.delete(id).await? {
        Deleted::Done => Ok(StatusCode::NO_CONTENT),
        Deleted::Active => Err(JobError::Active(id).into()),
        Deleted::Missing => Err(JobError::Missing(id).into()),
    }
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn only_ended_jobs_can_be_deleted() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}");
        let (status, _, problem) = service.send("DELETE", &path, &[], "").await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (409, Some("/problems/job-active"))
        );
        service.post(&format!("{path}/cancel"), "").await;
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 204);
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 404);
        assert_eq!(service.get(&path).await.0, 404);
    }
}
