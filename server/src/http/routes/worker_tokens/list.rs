//! `GET /v1/worker-tokens`: tokens of remote workers.

use api::worker::WorkerTokens;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;

/// Tokens of remote workers, without the tokens themselves.
#[utoipa::path(
    get,
    path = "/v1/worker-tokens",
    tag = "operation",
    responses((status = 200, description = "The tokens", body = WorkerTokens))
)]
pub(crate) async fn worker_tokens(
    State(app): State<App>,
) -> Result<Json<WorkerTokens>, ProblemResponse> {
    let tokens = app.store.worker_tokens().await?;
    Ok(Json(WorkerTokens { tokens }))
}
