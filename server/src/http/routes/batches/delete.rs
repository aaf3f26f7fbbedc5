//! `DELETE /v1/sweeps/{id}` and `DELETE /v1/studies/{id}`: deletes a batch whose jobs have ended.

use api::problem::Problem;
use axum::extract::State;
use axum::http::StatusCode;

use crate::http::app::App;
use crate::http::extract::BatchId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::error::BatchError;
use crate::store::{BatchEnding, Deleted};

/// Deletes a sweep whose jobs have all ended, with the jobs, their events and results: those of more than a thousand jobs after the answer.
#[utoipa::path(
    delete,
    path = "/v1/sweeps/{id}",
    tag = "sweeps",
    responses(
        (status = 204, description = "Deleted"),
        (status = 409, description = "A job of it has not ended", body = Problem),
    )
)]
pub(crate) async fn remove_sweep(
    app: State<App>,
    batch: BatchId,
) -> Result<StatusCode, ProblemResponse> {
    remove(&app, batch).await
}

/// Deletes a study whose jobs have all ended, with the jobs, their events and results: those of more than a thousand jobs after the answer.
#[utoipa::path(
    delete,
    path = "/v1/studies/{id}",
    tag = "studies",
    responses(
        (status = 204, description = "Deleted"),
        (status = 409, description = "A job of it has not ended", body = Problem),
    )
)]
pub(crate) async fn remove_study(
    app: State<App>,
    batch: BatchId,
) -> Result<StatusCode, ProblemResponse> {
    remove(&app, batch).await
}

async fn remove(app: &App, batch: BatchId) -> Result<StatusCode, ProblemResponse> {
    app.require_batch(batch).await?;
    match app.store.note_deletion(batch.id).await? {
        Deleted::Done => {
            app.end_jobs_of(batch.id, BatchEnding::Delete).await?;
            Ok(StatusCode::NO_CONTENT)
        }
        Deleted::Active => Err(BatchError::Active(batch).into()),
        Deleted::Missing => Err(BatchError::Missing(batch).into()),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::{STUDY, SWEEP, Service};

    #[tokio::test]
    async fn only_ended_sweeps_can_be_deleted_and_their_jobs_are_deleted_too() {
        let service = Service::new().await;
        let other = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let path = format!("/v1/sweeps/{}", sweep["id"].as_str().expect("an id"));
        let (status, _, problem) = service.send("DELETE", &path, &[], "").await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (409, Some("/problems/sweep-active"))
        );
        service.post(&format!("{path}/cancel"), "").await;
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 204);
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 404);
        assert_eq!(service.get(&path).await.0, 404);
        let (_, _, list) = service.get("/v1/jobs").await;
        let left: Vec<_> = list["jobs"].as_array().expect("jobs").iter().collect();
        assert_eq!(left.len(), 1);
        assert_eq!(left[0]["id"], json!(other));
    }

    #[tokio::test]
    async fn only_ended_studies_can_be_deleted_and_sweeps_are_not_deleted_as_studies() {
        let service = Service::new().await;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let path = format!("/v1/studies/{}", study["id"].as_str().expect("an id"));
        let (status, _, problem) = service.send("DELETE", &path, &[], "").await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (409, Some("/problems/study-active"))
        );
        service.post(&format!("{path}/cancel"), "").await;
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 204);
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 404);
        assert_eq!(service.get("/v1/jobs").await.2["jobs"], json!([]));
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let id = sweep["id"].as_str().expect("an id");
        service.post(&format!("/v1/sweeps/{id}/cancel"), "").await;
        let path = format!("/v1/studies/{id}");
        assert_eq!(service.send("DELETE", &path, &[], "").await.0, 404);
        assert_eq!(service.get(&format!("/v1/sweeps/{id}")).await.0, 200);
    }
}
