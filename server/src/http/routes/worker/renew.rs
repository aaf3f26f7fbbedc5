//! `POST /v1/worker/leases`: the heartbeat of a worker for all its jobs.

use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::http::worker_body::WorkerBody;
use crate::store::LeaseState;
use crate::worker::protocol::{LeasesBody, lease_length};

/// Renews leases; answers with their states, in the same order.
pub(crate) async fn renew(
    State(app): State<App>,
    WorkerBody(body): WorkerBody<LeasesBody>,
) -> Result<Json<Vec<LeaseState>>, ProblemResponse> {
    app.workers.beats(body.worker, body.failing.as_deref());
    Ok(Json(
        app.store
            .heartbeat(&body.leases, lease_length(body.length))
            .await?,
    ))
}
