//! `POST /v1/worker/updates`: rows, snapshots, files, checkpoint and events of an attempt.

use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::http::worker_body::WorkerBody;
use crate::store::LeaseState;
use crate::worker::Employer;
use crate::worker::protocol::{UpdateBody, lease_length};

/// Records an update whose files were sent before.
pub(crate) async fn record(
    State(app): State<App>,
    WorkerBody(body): WorkerBody<UpdateBody>,
) -> Result<Json<LeaseState>, ProblemResponse> {
    let UpdateBody {
        lease,
        update,
        length,
    } = body;
    let length = lease_length(length);
    Ok(Json(
        Employer::record(&*app.store, lease, &update, length).await?,
    ))
}
