//! `POST /v1/jobs/{id}/retry`: queues a failed or cancelled job again.

use api::job::Job;
use api::problem::Problem;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};

use crate::http::app::App;
use crate::http::extract::JobId;
use crate::http::job_error::JobError;
use crate::http::problem::ProblemResponse;
use crate::store::Retried;

/// Queues a failed or cancelled job again. It continues from its last checkpoint, with all its attempts; a deadline is as far
/// away as it was at the submission. A job that is queued or running stays as it is.
#[utoipa::path(
    post,
    path = "/v1/jobs/{id}/retry",
    tag = "jobs",
    responses(
        (status = 202, description = "Accepted; the job in its current state", body = Job),
        (status = 409, description = "The job has succeeded", body = Problem),
    )
)]
pub(crate) async fn retry(
    State(app): State<App>,
    JobId(id): JobId,
) -> Result<Response, ProblemResponse> {
    let retried = app.store.retry(id).await?;
    if retried.ok_or(JobError::Missing(id))? == Retried::Succeeded {
        return Err(JobError::Succeeded(id).into());
    }
    let job = app.job(id).await?;
    Ok((StatusCode::ACCEPTED, Json(job.document)).into_response())
}

#[cfg(test)]
mod tests {
    use uuid::Uuid;

    use crate::http::tests::Service;
    use crate::queue::Transition;
    use crate::store::{Claim, End, JobUpdate};

    async fn claimed(service: &Service) -> Claim {
        let claim = service.app.store.claim_next(i64::MAX).await;
        claim.expect("a queued job")
    }

    async fn end(service: &Service, claim: &Claim, transition: Transition) {
        let end = End::without_result(transition, "as the test asked for");
        let store = &service.app.store;
        store.end_next(claim, &JobUpdate::default(), &end).await;
    }

    #[tokio::test]
    async fn a_failed_job_is_queued_again_and_asking_twice_changes_nothing() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        end(&service, &claimed(&service).await, Transition::Fail).await;
        let path = format!("/v1/jobs/{id}/retry");
        let (status, _, first) = service.post(&path, "").await;
        assert_eq!(
            (status.as_u16(), first["status"].as_str()),
            (202, Some("queued"))
        );
        assert!(
            first["finished_at"].is_null() && first["outcome"].is_null(),
            "{first}"
        );
        let (status, _, second) = service.post(&path, "").await;
        assert_eq!((status.as_u16(), second), (202, first));
        assert_eq!(claimed(&service).await.id.to_string(), id);
    }

    #[tokio::test]
    async fn a_cancelled_job_is_queued_again() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        service.post(&format!("/v1/jobs/{id}/cancel"), "").await;
        let (status, _, job) = service.post(&format!("/v1/jobs/{id}/retry"), "").await;
        assert_eq!(
            (status.as_u16(), job["status"].as_str()),
            (202, Some("queued"))
        );
        // The cancel request is forgotten.
        end(&service, &claimed(&service).await, Transition::Release).await;
        let (_, _, job) = service.get(&format!("/v1/jobs/{id}")).await;
        assert_eq!(job["status"], "queued");
    }

    #[tokio::test]
    async fn a_job_that_succeeded_is_a_409() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        end(&service, &claimed(&service).await, Transition::Succeed).await;
        let (status, _, problem) = service.post(&format!("/v1/jobs/{id}/retry"), "").await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (409, Some("/problems/job-succeeded"))
        );
    }

    #[tokio::test]
    async fn an_unknown_job_is_a_404() {
        let service = Service::new().await;
        let path = format!("/v1/jobs/{}/retry", Uuid::nil());
        assert_eq!(service.post(&path, "").await.0, 404);
    }
}
