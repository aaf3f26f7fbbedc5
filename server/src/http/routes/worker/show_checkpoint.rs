//! `GET /v1/worker/checkpoints/{job}/{lease}`: the checkpoint that an attempt resumes from, if it does not come with the claim.

use axum::extract::{Path, State};
use axum::{Extension, Json};
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::http::worker_access::WorkerToken;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::Lease;

/// Returns it; null if it is missing or damaged, or if the lease was lost.
pub(crate) async fn show_checkpoint(
    State(app): State<App>,
    Extension(token): Extension<WorkerToken>,
    Path((job, number)): Path<(Uuid, i64)>,
) -> Result<Json<Option<EncodedCheckpoint>>, ProblemResponse> {
    let lease = Lease { job, number };
    if !token.owns(&app.store, lease).await? {
        return Ok(Json(None));
    }
    Ok(Json(app.store.checkpoint(lease).await?))
}
