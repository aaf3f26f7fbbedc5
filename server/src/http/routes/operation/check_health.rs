//! `GET /healthz` and `GET /readyz`: liveness and readiness checks.

use api::problem::Problem;
use api::service::SERVICE;
use axum::Json;
use axum::extract::State;
use serde_json::{Value, json};

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};

/// Liveness check: the process responds.
#[utoipa::path(get, path = "/healthz", tag = "operation", responses((status = 200, description = "The process responds")))]
pub(crate) async fn healthz() -> Json<Value> {
    Json(json!({ "status": "ok" }))
}

/// Readiness check: the tasks of the service run, its workers start solving processes, the data disk has space for more jobs, and the database accepts a write.
#[utoipa::path(
    get,
    path = "/readyz",
    tag = "operation",
    responses(
        (status = 200, description = "The service is ready"),
        (status = 500, description = "The service is not ready, and needs help", body = Problem),
        (status = 503, description = "The service is not ready at present; the detail names each part that is not", body = Problem),
    )
)]
pub(crate) async fn readyz(State(app): State<App>) -> Result<Json<Value>, ProblemResponse> {
    let failing = app.supervisor.failing();
    let disk = app.store.disk();
    let written = match app.store.ready().await {
        // Then the disk fails, not the database.
        Err(error) if error.is_disk_full() => {
            disk.release_after(&error);
            Ok(())
        }
        written => written,
    };
    let shortage = disk.shortage();
    let mut parts = Vec::new();
    if !failing.is_empty() {
        let detail = format!("tasks: restarted repeatedly: {}", failing.join(", "));
        parts.push((ProblemType::TASK_FAILING, detail));
    }
    if let Some(cause) = app.health.failing() {
        parts.push((ProblemType::WORKERS_FAILING, format!("workers: {cause}")));
    }
    if let Some(shortage) = shortage {
        parts.push((ProblemType::DISK_FULL, format!("disk: {shortage}")));
    }
    match (written, parts.first()) {
        (Ok(()), None) => Ok(Json(json!({ "status": "ready", "service": SERVICE }))),
        (Err(error), None) => Err(error.into()),
        (written, Some(&(problem, _))) => {
            let written = written.err().map(|error| format!("database: {error}"));
            let details = parts.into_iter().map(|(_, detail)| detail).chain(written);
            Err(problem.with_detail(details.collect::<Vec<_>>().join("; ")))
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::Service;
    use crate::store;

    #[tokio::test]
    async fn a_working_service_is_alive_and_ready() {
        let service = Service::new().await;
        assert_eq!(service.get("/healthz").await.2["status"], "ok");
        let (_, _, ready) = service.get("/readyz").await;
        assert_eq!(ready, json!({"status": "ready", "service": "fretwear"}));
    }

    #[tokio::test]
    async fn a_service_whose_workers_start_no_solves_is_not_ready_and_says_why() {
        let service = Service::new().await;
        let health = &service.app.health;
        health.decline("too many open files");
        let (status, _, problem) = service.get("/readyz").await;
        assert_eq!(
            (status.as_u16(), &problem["type"], &problem["detail"]),
            (
                503,
                &json!("/problems/workers-failing"),
                &json!("workers: too many open files")
            )
        );
        let (_, _, text) = service.text("GET", "/metrics", &[], "").await;
        assert!(text.contains("fretwear_workers_failing 1\n"), "{text}");
        health.start();
        assert_eq!(service.get("/readyz").await.0, 200);
    }

    #[tokio::test]
    async fn a_service_whose_database_accepts_no_write_is_not_ready() {
        let service = Service::new().await;
        let path = service.results_folder().with_file_name("test.db");
        let _other = store::tests::hold_write_lock(&path).await;
        let (status, _, problem) = service.get("/readyz").await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (503, Some("/problems/busy"))
        );
        assert_eq!(
            problem["detail"],
            "another program has locked the database; send the request again"
        );
    }
}
