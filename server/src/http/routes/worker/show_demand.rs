//! `GET /v1/worker/demand`: what waits and runs.

use api::service::Demand;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;

/// Returns the demand for workers.
pub(crate) async fn show_demand(State(app): State<App>) -> Result<Json<Demand>, ProblemResponse> {
    Ok(Json(app.store.demand().await?))
}
