//! `POST /v1/jobs/{id}/cancel`: requests the cancellation of a job; always accepted.

use api::job::Job;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};

use crate::http::app::App;
use crate::http::extract::JobId;
use crate::http::job_error::JobError;
use crate::http::problem::ProblemResponse;

/// Requests the cancellation of a job: a queued one ends at once, a running one within a second.
#[utoipa::path(
    post,
    path = "/v1/jobs/{id}/cancel",
    tag = "jobs",
    responses(
        (status = 202, description = "Accepted; the job in its current state", body = Job),
    )
)]
pub(crate) async fn cancel(
    State(app): State<App>,
    JobId(id): JobId,
) -> Result<Response, ProblemResponse> {
    let cancelled = app.store.cancel(id).await?;
    cancelled.ok_or(JobError::Missing(id))?;
    let job = app.job(id).await?;
    Ok((StatusCode::ACCEPTED, Json(job.document)).into_response())
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn a_queued_job_ends_at_once_and_cancelling_again_changes_nothing() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}/cancel");
        let (status, _, first) = service.post(&path, "").await;
        assert_eq!(
            (status.as_u16(), first["status"].as_str()),
            (202, Some("cancelled"))
        );
        let (status, _, second) = service.post(&path, "").await;
        assert_eq!((status.as_u16(), second), (202, first));
    }

    #[tokio::test]
    async fn a_running_job_ends_later() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let claim = service.app.store.claim_next(i64::MAX).await;
        claim.expect("a job");
        let (status, _, job) = service.post(&format!("/v1/jobs/{id}/cancel"), "").await;
        assert_eq!(
            (status.as_u16(), job["status"].as_str()),
            (202, Some("running"))
        );
        assert_eq!(job["status_reason"], "cancel requested");
    }

    #[tokio::test]
    async fn an_unknown_job_is_a_404() {
        let service = Service::new().await;
        assert_eq!(
            service
                .post("/v1/jobs/00000000-0000-7000-8000-000000000000/cancel", "")
                .await
                .0,
            404
        );
    }
}
