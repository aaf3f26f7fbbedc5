//! `GET /healthz` and `GET /readyz`: liveness and readiness checks.

use api::problem::Problem;
use axum::Json;
use axum::extract::State;
use serde_json::{Value, json};

use crate::clock::now_ms;
use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};

/// Liveness check: the process responds.
#[utoipa::path(get, path = "/healthz", tag = "operation", responses((status = 200, description = "The process responds")))]
pub(crate) async fn healthz() -> Json<Value> {
    Json(json!({ "status": "ok" }))
}

/// Readiness check: the tasks of the service run and the database accepts a write.
#[utoipa::path(
    get,
    path = "/readyz",
    tag = "operation",
    responses(
        (status = 200, description = "The service is ready"),
        (status = 500, description = "The service is not ready, and needs help", body = Problem),
        (status = 503, description = "The service is not ready at present", body = Problem),
    )
)]
pub(crate) async fn readyz(State(app): State<App>) -> Result<Json<Value>, ProblemResponse> {
    let failing = app.supervisor.failing();
    if !failing.is_empty() {
        let detail = format!("restarted repeatedly: {}", failing.join(", "));
        return Err(ProblemType::TASK_FAILING.with_detail(detail));
    }
    app.store.ready(now_ms()).await?;
    Ok(Json(json!({ "status": "ready" })))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;
    use crate::store;

    #[tokio::test]
    async fn a_working_service_is_alive_and_ready() {
        let service = Service::new().await;
        assert_eq!(service.get("/healthz").await.2["status"], "ok");
        assert_eq!(service.get("/readyz").await.2["status"], "ready");
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
    }
}
