//! `POST /v1/worker/restarts`: the run of an attempt restarts at cycle 0.

use axum::extract::State;
use axum::{Extension, Json};

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::http::worker_access::WorkerToken;
use crate::http::worker_body::WorkerBody;
use crate::store::LeaseState;
use crate::worker::protocol::RestartBody;

/// Deletes all results of the job.
pub(crate) async fn restart(
    State(app): State<App>,
    Extension(token): Extension<WorkerToken>,
    WorkerBody(body): WorkerBody<RestartBody>,
) -> Result<Json<LeaseState>, ProblemResponse> {
    if !token.owns(&app.store, body.lease).await? {
        return Ok(Json(LeaseState::Lost));
    }
    Ok(Json(app.store.restart(body.lease, body.number).await?))
}
