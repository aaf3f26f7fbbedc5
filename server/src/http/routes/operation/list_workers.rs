//! `GET /v1/workers`: local and remote workers.

use api::service::Workers;
use api::worker::WorkerList;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;

/// Workers in the process of the service, and remote processes with what they hold, of all services of the database.
#[utoipa::path(
    get,
    path = "/v1/workers",
    tag = "operation",
    responses((status = 200, description = "The workers", body = WorkerList))
)]
pub(crate) async fn workers(State(app): State<App>) -> Result<Json<WorkerList>, ProblemResponse> {
    let total = app.supervisor.running_workers();
    app.workers.note_shown(&app.store).await;
    Ok(Json(WorkerList {
        local: Workers {
            total: u64::try_from(total).unwrap_or(u64::MAX),
            busy: app.store.metrics().busy_workers(),
        },
        remote: app.store.workers().await?,
    }))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use serde_json::json;

    use crate::http::tests::Service;
    use crate::store::tests::request;
    use crate::worker::protocol::PROGRAM;

    #[tokio::test]
    async fn a_remote_worker_is_listed_with_its_memory_and_jobs() {
        let service = Service::new().await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let asked = request(1_000, Duration::from_secs(9));
        let claim = json!({"program": PROGRAM, "host": "n1", "slots": 2, "request": asked, "wait": Duration::ZERO});
        let (_, _, claims) = service.post("/v1/worker/claims", &claim.to_string()).await;
        let lease = json!({"job": claims[0]["id"], "number": claims[0]["lease"]});
        let beat = json!({
            "worker": asked.request.worker, "leases": [lease], "length": Duration::from_secs(9), "failing": "no space"
        });
        let (_, _, states) = service.post("/v1/worker/leases", &beat.to_string()).await;
        assert_eq!(states, json!([{"held": {"cancel_requested": false}}]));
        let (status, _, list) = service.get("/v1/workers").await;
        assert_eq!(status, 200);
        let found = &list["remote"][0];
        assert_eq!(found["id"], json!(asked.request.worker));
        assert_eq!(
            (&found["host"], &found["slots"], &found["jobs"]),
            (&json!("n1"), &json!(2), &json!(1))
        );
        assert_eq!(found["failing"], "no space");
        let (_, _, text) = service.text("GET", "/metrics", &[], "").await;
        assert!(text.contains("fretwear_workers_failing 1\n"), "{text}");
        let (_, _, service) = service.get("/v1/service").await;
        assert_eq!(service["workers"], json!({"total": 2, "busy": 1}));
        assert_eq!(
            (&found["memory_mb"], &found["free_memory_mb"]),
            (&json!(1_000), &json!(1_000))
        );
        assert_eq!(list["local"], json!({"total": 0, "busy": 0}));
    }
}
