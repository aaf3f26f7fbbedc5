//! `POST /v1/sweeps/{id}/cancel` and `POST /v1/studies/{id}/cancel`: cancels all jobs of a batch; always accepted.

use api::problem::Problem;
use api::study::StudyDocument;
use api::sweep::Sweep;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use crate::batch::Document;
use crate::http::app::App;
use crate::http::extract::BatchId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::show::document;
use crate::store::BatchEnding;

/// The batch in its current state.
type Cancelled = Result<(StatusCode, Json<Document>), ProblemResponse>;

/// Cancels all jobs of a sweep: those of more than a thousand after the answer.
#[utoipa::path(
    post,
    path = "/v1/sweeps/{id}/cancel",
    tag = "sweeps",
    responses(
        (status = 202, description = "Accepted; the sweep in its current state", body = Sweep),
    )
)]
pub(crate) async fn cancel_sweep(app: State<App>, batch: BatchId) -> Cancelled {
    cancel(&app, batch).await
}

/// Cancels all jobs of a study: those of more than a thousand after the answer.
#[utoipa::path(
    post,
    path = "/v1/studies/{id}/cancel",
    tag = "studies",
    responses(
        (status = 202, description = "Accepted; the study in its current state", body = StudyDocument),
        (status = 410, description = "Accepted, but queued by a version whose studies cannot be compared any more", body = Problem),
    )
)]
pub(crate) async fn cancel_study(app: State<App>, batch: BatchId) -> Cancelled {
    cancel(&app, batch).await
}

async fn cancel(app: &App, batch: BatchId) -> Cancelled {
    app.require_batch(batch).await?;
    app.store.note_cancellation(batch.id).await?;
    app.end_jobs_of(batch.id, BatchEnding::Cancel).await?;
    Ok((StatusCode::ACCEPTED, document(app, batch).await?))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{STUDY, SWEEP, Service};

    #[tokio::test]
    async fn waiting_jobs_end_at_once_and_running_ones_are_asked_to_end() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let claim = service.app.store.claim_next(i64::MAX).await;
        claim.expect("a job");
        let path = format!("/v1/sweeps/{}/cancel", sweep["id"].as_str().expect("an id"));
        let (status, _, sweep) = service.post(&path, "").await;
        assert_eq!(status, 202);
        assert_eq!(
            (&sweep["counts"]["cancelled"], &sweep["counts"]["running"]),
            (&3.into(), &1.into())
        );
        let (status, _, again) = service.post(&path, "").await;
        assert_eq!((status.as_u16(), again), (202, sweep));
        let nobody = "/v1/sweeps/00000000-0000-7000-8000-000000000000/cancel";
        assert_eq!(service.post(nobody, "").await.0, 404);
    }

    #[tokio::test]
    async fn all_jobs_of_a_study_are_cancelled_and_a_sweep_is_left_alone() {
        let service = Service::new().await;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let path = format!(
            "/v1/studies/{}/cancel",
            study["id"].as_str().expect("an id")
        );
        let (status, _, study) = service.post(&path, "").await;
        assert_eq!(status, 202);
        let jobs = study["jobs"].as_array().expect("jobs").len();
        assert_eq!(study["counts"]["cancelled"], jobs);
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let id = sweep["id"].as_str().expect("an id");
        let (status, _, _) = service.post(&format!("/v1/studies/{id}/cancel"), "").await;
        assert_eq!(status, 404);
        let (_, _, sweep) = service.get(&format!("/v1/sweeps/{id}")).await;
        assert_eq!(sweep["counts"]["cancelled"], 0);
    }
}
