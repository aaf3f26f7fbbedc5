//! `POST /v1/sweeps/{id}/retry` and `POST /v1/studies/{id}/retry`: queues the failed and cancelled jobs of a batch again.

use std::sync::Arc;

use api::job::RetriedJobs;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use crate::http::app::App;
use crate::http::extract::BatchId;
use crate::http::problem::ProblemResponse;
use crate::store::Filter;

type Retried = Result<(StatusCode, Json<RetriedJobs>), ProblemResponse>;

/// Queues the failed and cancelled jobs of a sweep again. Each continues from its last checkpoint, with all its attempts.
#[utoipa::path(
    post,
    path = "/v1/sweeps/{id}/retry",
    tag = "sweeps",
    responses(
        (status = 202, description = "Accepted; how many jobs are queued again", body = RetriedJobs),
    )
)]
pub(crate) async fn retry_sweep(app: State<App>, batch: BatchId) -> Retried {
    retry(&app, batch).await
}

/// Queues the failed and cancelled jobs of a study again. Each continues from its last checkpoint, with all its attempts.
#[utoipa::path(
    post,
    path = "/v1/studies/{id}/retry",
    tag = "studies",
    responses(
        (status = 202, description = "Accepted; how many jobs are queued again", body = RetriedJobs),
    )
)]
pub(crate) async fn retry_study(app: State<App>, batch: BatchId) -> Retried {
    retry(&app, batch).await
}

async fn retry(app: &App, batch: BatchId) -> Retried {
    app.require_batch(batch).await?;
    let filter = Filter {
        sweep: Some(batch.id),
        ..Filter::default()
    };
    // The retry continues if the client disconnects before its end.
    let store = Arc::clone(&app.store);
    let retried = tokio::spawn(async move { store.retry_all(filter).await }).await??;
    Ok((StatusCode::ACCEPTED, Json(RetriedJobs { retried })))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::{STUDY, SWEEP, Service};

    #[tokio::test]
    async fn the_jobs_of_a_batch_are_queued_again_and_no_others() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let of = |batch: &serde_json::Value| batch["id"].as_str().expect("an id").to_owned();
        let (sweep, study) = (of(&sweep), of(&study));
        for batch in [&sweep, &study] {
            service
                .post(&format!("/v1/sweeps/{batch}/cancel"), "")
                .await;
        }
        let (status, _, retried) = service.post(&format!("/v1/sweeps/{sweep}/retry"), "").await;
        assert_eq!((status.as_u16(), retried), (202, json!({"retried": 4})));
        let (_, _, sweep) = service.get(&format!("/v1/sweeps/{sweep}")).await;
        assert_eq!(sweep["counts"]["queued"], 4);
        let (_, _, shown) = service.get(&format!("/v1/studies/{study}")).await;
        assert_eq!(shown["counts"]["queued"], 0);
        let (_, _, retried) = service
            .post(&format!("/v1/studies/{study}/retry"), "")
            .await;
        assert_eq!(retried["retried"], shown["counts"]["cancelled"]);
        let nobody = "/v1/studies/00000000-0000-7000-8000-000000000000/retry";
        assert_eq!(service.post(nobody, "").await.0, 404);
    }
}
