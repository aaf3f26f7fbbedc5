//! `POST /v1/worker/restarts`: the run of an attempt restarts at cycle 0.

use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::http::worker_body::WorkerBody;
use crate::store::LeaseState;
use crate::worker::protocol::RestartBody;

/// Deletes all results of the job.
pub(crate) async fn restart(
    State(app): State<App>,
    WorkerBody(body): WorkerBody<RestartBody>,
) -> Result<Json<LeaseState>, ProblemResponse> {
    Ok(Json(app.store.restart(body.lease, body.number).await?))
}
