//! `POST /v1/worker/ends`: the end of an attempt.

use api::job::Status;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};
use crate::http::worker_body::WorkerBody;
use crate::store::block::EncodedBlock;
use crate::worker::Employer;
use crate::worker::protocol::EndBody;

/// Ends the job, with documents of its results, or returns it to the queue; null if the lease was lost.
pub(crate) async fn finish(
    State(app): State<App>,
    WorkerBody(body): WorkerBody<EndBody>,
) -> Result<Json<Option<Status>>, ProblemResponse> {
    let EndBody { lease, update, end } = body;
    if let Some(Err(cause)) = update.block.as_ref().map(EncodedBlock::check) {
        let detail = format!("/update/block: {cause}");
        return Err(ProblemType::UNREADABLE_BODY.with_detail(detail));
    }
    Ok(Json(
        Employer::finish(&*app.store, lease, &update, &end).await?,
    ))
}
