//! `GET /healthz` and `GET /readyz`: whether the service lives, and whether it can work.

use api::problem::Problem;
use axum::Json;
use axum::extract::State;
use axum::response::{IntoResponse, Response};
use serde_json::{Value, json};

use crate::clock::now_ms;
use crate::http::App;
use crate::http::problem::Refusal;
use crate::store::StoreError;

/// Why the service cannot work.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum ReadyError {
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl IntoResponse for ReadyError {
    fn into_response(self) -> Response {
        let Self::Store(error) = &self;
        Refusal::from(error).into_response()
    }
}

/// Whether the service lives.
#[utoipa::path(get, path = "/healthz", tag = "operation", responses((status = 200, description = "It does")))]
pub(in crate::http) async fn healthz() -> Json<Value> {
    Json(json!({ "status": "ok" }))
}

/// Whether the service can work: its database takes a write.
#[utoipa::path(
    get,
    path = "/readyz",
    tag = "operation",
    responses(
        (status = 200, description = "It can"),
        (status = 500, description = "It cannot, and will not by itself", body = Problem),
        (status = 503, description = "It cannot at present", body = Problem),
    )
)]
pub(in crate::http) async fn readyz(State(app): State<App>) -> Result<Json<Value>, ReadyError> {
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
    async fn a_service_whose_database_takes_no_write_is_not_ready() {
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
