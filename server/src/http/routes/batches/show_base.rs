//! `GET /v1/sweeps/{id}/base` and `GET /v1/studies/{id}/base`: the specification that the jobs of a batch are variations of, as it was sent.

use api::spec::Spec;
use axum::extract::State;

use crate::http::app::App;
use crate::http::extract::BatchId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::error::BatchError;
use crate::http::routes::jobs::show_spec::SentSpec;
use crate::store::BatchDetail;
use crate::store::BatchPart;

/// The base specification of a sweep as it was sent.
#[utoipa::path(
    get,
    path = "/v1/sweeps/{id}/base",
    tag = "sweeps",
    responses(
        (status = 200, description = "The specification", body = Spec, headers(
            ("Fretwear-Specification" = String, description = "`sent`, or `resolved`: that of the first job, of a sweep that was queued before specifications were stored as they were sent"),
        )),
    )
)]
pub(crate) async fn show_sweep_base(
    app: State<App>,
    batch: BatchId,
) -> Result<SentSpec, ProblemResponse> {
    base(&app, batch).await
}

/// The base specification of a study as it was sent.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/base",
    tag = "studies",
    responses(
        (status = 200, description = "The specification", body = Spec, headers(
            ("Fretwear-Specification" = String, description = "`sent`, or `resolved`: that of the first job, of a study that was queued before specifications were stored as they were sent"),
        )),
    )
)]
pub(crate) async fn show_study_base(
    app: State<App>,
    batch: BatchId,
) -> Result<SentSpec, ProblemResponse> {
    base(&app, batch).await
}

async fn base(app: &App, batch: BatchId) -> Result<SentSpec, ProblemResponse> {
    app.require_batch(batch).await?;
    if let Some(sent) = app.store.sent_base(batch.id).await? {
        return Ok(SentSpec::sent(sent));
    }
    let first = BatchPart { from: 0, limit: 1 };
    let jobs = app
        .store
        .batch_jobs(batch.id, first, BatchDetail::Statuses)
        .await?;
    let job = jobs.first().ok_or(BatchError::Empty(batch))?;
    app.sent_spec(job.id).await
}
