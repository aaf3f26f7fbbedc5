//! `POST /v1/workers/{id}/drain`: a remote worker takes no more jobs.

use api::worker::RemoteWorker;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use crate::http::app::App;
use crate::http::extract::WorkerId;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};

/// No process of this id is there.
#[derive(Debug, thiserror::Error)]
#[error("no remote worker {} was in contact within the last minute", .0.0)]
pub(crate) struct Missing(WorkerId);

impl RouteError for Missing {
    const TYPE: ProblemType = ProblemType::NO_SUCH_WORKER;
}

/// Lets a remote process take no more jobs: it ends when it has solved those that it holds. Other services learn of it within seconds.
#[utoipa::path(
    post,
    path = "/v1/workers/{id}/drain",
    tag = "operation",
    responses(
        (status = 202, description = "Accepted; the worker in its current state", body = RemoteWorker),
    )
)]
pub(crate) async fn drain_worker(
    State(app): State<App>,
    worker: WorkerId,
) -> Result<(StatusCode, Json<RemoteWorker>), ProblemResponse> {
    app.workers.note_shown(&app.store).await;
    if !app.store.drain_worker(worker.0).await? {
        return Err(Missing(worker).into());
    }
    app.workers.exchange(&app.store).await;
    let workers = app.store.workers().await?;
    let drained = workers.into_iter().find(|found| found.id == worker.0);
    let drained = drained.ok_or(Missing(worker))?;
    Ok((StatusCode::ACCEPTED, Json(drained)))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use serde_json::{Value, json};

    use crate::http::tests::Service;
    use crate::store::ClaimRequest;
    use crate::store::tests::request;
    use crate::worker::protocol::PROGRAM;

    async fn claim(service: &Service, request: &ClaimRequest) -> (u16, Value) {
        let body = json!({"program": PROGRAM, "host": "n1", "slots": 2, "request": request, "wait": Duration::ZERO});
        let (status, _, claims) = service.post("/v1/worker/claims", &body.to_string()).await;
        (status.as_u16(), claims)
    }

    #[tokio::test]
    async fn a_drained_worker_keeps_its_jobs_and_gets_no_more() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let asked = request(1_000, Duration::from_secs(9));
        let worker = asked.request.worker;
        assert_eq!(claim(&service, &asked).await.1[0]["id"], id);
        let path = format!("/v1/workers/{worker}/drain");
        for _ in 0..2 {
            let (status, _, drained) = service.post(&path, "").await;
            assert_eq!(status, 202, "{drained}");
            let found = (&drained["id"], &drained["jobs"], &drained["is_draining"]);
            assert_eq!(found, (&json!(worker), &json!(1), &json!(true)));
        }
        let repeated = claim(&service, &asked).await;
        assert_eq!((repeated.0, &repeated.1[0]["id"]), (200, &json!(id)));
        let mut next = asked;
        next.request.number += 1;
        let (status, problem) = claim(&service, &next).await;
        let found = (status, problem["type"].as_str());
        assert_eq!(found, (409, Some("/problems/worker-drained")));
        let (status, _) = claim(&service, &request(1_000, Duration::from_secs(9))).await;
        assert_eq!(status, 200, "another worker gets the other job");
        let (_, _, list) = service.get("/v1/workers").await;
        let workers = list["remote"].as_array().expect("workers").iter();
        let draining: Vec<_> = workers
            .map(|worker| worker["is_draining"].clone())
            .collect();
        assert_eq!(draining, [true, false]);
    }

    #[tokio::test]
    async fn an_unknown_worker_is_a_404() {
        let service = Service::new().await;
        for id in ["00000000-0000-7000-8000-000000000000", "1"] {
            let (status, _, problem) = service.post(&format!("/v1/workers/{id}/drain"), "").await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (404, Some("/problems/no-such-worker")), "{id}");
        }
    }
}
