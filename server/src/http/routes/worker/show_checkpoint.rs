//! `GET /v1/worker/checkpoints/{job}/{lease}`: the checkpoint that an attempt resumes from, if it does not come with the claim.

use axum::Json;
use axum::extract::{Path, State};
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::Lease;

/// Returns it; null if it is missing or damaged, or if the lease was lost.
pub(crate) async fn show_checkpoint(
    State(app): State<App>,
    Path((job, number)): Path<(Uuid, i64)>,
) -> Result<Json<Option<EncodedCheckpoint>>, ProblemResponse> {
    Ok(Json(app.store.checkpoint(Lease { job, number }).await?))
}
