//! `DELETE /v1/worker-tokens/{id}`: revokes a token of remote workers.

use axum::extract::State;
use axum::http::StatusCode;
use uuid::Uuid;

use crate::http::app::App;
use crate::http::extract::WorkerTokenId;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};

/// There is no such token.
#[derive(Debug, thiserror::Error)]
#[error("there is no token {0}")]
pub(crate) struct Missing(Uuid);

impl RouteError for Missing {
    const TYPE: ProblemType = ProblemType::NO_SUCH_TOKEN;
}

/// Revokes a token: its workers are refused from now on, and their jobs are given to others when their leases end.
#[utoipa::path(
    delete,
    path = "/v1/worker-tokens/{id}",
    tag = "operation",
    responses((status = 204, description = "Revoked, now or before"))
)]
pub(crate) async fn revoke_worker_token(
    State(app): State<App>,
    WorkerTokenId(id): WorkerTokenId,
) -> Result<StatusCode, ProblemResponse> {
    if app.store.revoke_worker_token(id).await? {
        tracing::info!(%id, "a token for workers was revoked");
        return Ok(StatusCode::NO_CONTENT);
    }
    Err(Missing(id).into())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::Service;

    #[tokio::test]
    async fn a_token_is_shown_once_and_can_be_revoked() {
        let service = Service::new().await;
        let body = json!({"name": "cluster"}).to_string();
        let (status, _, made) = service.post("/v1/worker-tokens", &body).await;
        assert_eq!((status.as_u16(), &made["name"]), (201, &json!("cluster")));
        let token = made["token"].as_str().expect("a token");
        assert_eq!(token.len(), 43, "32 bytes");
        let (_, _, list) = service.get("/v1/worker-tokens").await;
        assert!(!list.to_string().contains(token), "{list}");
        assert_eq!(list["tokens"][0]["revoked_at"], json!(null));
        let path = format!("/v1/worker-tokens/{}", made["id"].as_str().expect("an id"));
        for _ in 0..2 {
            let (status, ..) = service.send("DELETE", &path, &[], "").await;
            assert_eq!(status, 204);
        }
        let (_, _, list) = service.get("/v1/worker-tokens").await;
        assert!(list["tokens"][0]["revoked_at"].is_string(), "{list}");
        let other = "/v1/worker-tokens/00000000-0000-7000-8000-000000000000";
        assert_eq!(service.send("DELETE", other, &[], "").await.0, 404);
    }

    #[tokio::test]
    async fn a_token_has_a_name() {
        let service = Service::new().await;
        for body in ["{}", r#"{"name": " "}"#, r#"{"name": "a", "scope": "all"}"#] {
            assert_eq!(
                service.post("/v1/worker-tokens", body).await.0,
                400,
                "{body}"
            );
        }
    }
}
