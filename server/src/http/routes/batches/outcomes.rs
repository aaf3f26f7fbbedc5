//! `GET /v1/sweeps/{id}/outcomes` and `GET /v1/studies/{id}/table`: the results of a batch as a table.

use std::io;

use api::problem::Problem;
use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use futures_util::{StreamExt, stream};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::batch;
use crate::export::documents::CSV;
use crate::http::app::App;
use crate::http::extract::{BatchId, Params};
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::error::{BatchError, MOST_JOBS};
use crate::http::routes::results::download_file::attachment;
use crate::store::{BatchJob, BatchPart, StoredBatch};

/// Part of the table.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutcomesQuery {
    /// Position of the first job, from 0.
    #[serde(default)]
    #[param(value_type = Option<u64>)]
    from: u64,
    /// Largest number of jobs; all unless given.
    #[param(minimum = 1)]
    limit: Option<u32>,
}

/// The results of a sweep so far as CSV: changes, status and figures, one line per job.
#[utoipa::path(
    get,
    path = "/v1/sweeps/{id}/outcomes",
    tag = "sweeps",
    params(OutcomesQuery),
    responses(
        (status = 200, description = "The table", content_type = "text/csv", body = String),
    )
)]
pub(crate) async fn sweep_outcomes(
    State(app): State<App>,
    batch: BatchId,
    Params(query): Params<OutcomesQuery>,
) -> Result<Response, ProblemResponse> {
    let OutcomesQuery { from, limit } = query;
    if limit == Some(0) {
        return Err(BatchError::Limit(0).into());
    }
    let whole = limit.unwrap_or(u32::MAX);
    let part = BatchPart {
        from,
        limit: whole.min(MOST_JOBS),
    };
    let evaluate = move |stored: StoredBatch| {
        let table = batch.kind.table(&stored)?;
        Ok((table, followed_by(&stored.jobs)))
    };
    let detail = batch.kind.table_detail();
    let (table, first) = app.evaluate_batch(batch, part, detail, evaluate).await?;
    // The rest of a long table is read while the client takes it.
    let rest = first.next.filter(|_| whole > first.jobs);
    let Some(next) = rest else {
        return Ok(csv(batch, Body::from(table)));
    };
    let start = Rest {
        next: Some(next),
        jobs: whole - first.jobs,
    };
    let rest = stream::try_unfold(start, move |rest| next_rows(app.clone(), batch, rest));
    let first = stream::once(async { Ok(Bytes::from(table)) });
    Ok(csv(batch, Body::from_stream(first.chain(rest))))
}

/// The runs of a study so far as CSV: settings, errors, cost.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/table",
    tag = "studies",
    responses(
        (status = 200, description = "The table", content_type = "text/csv", body = String),
        (status = 404, description = "No such study, or no results so far", body = Problem),
        (status = 410, description = "Queued by a version whose studies cannot be compared any more", body = Problem),
    )
)]
pub(crate) async fn study_table(
    app: State<App>,
    batch: BatchId,
) -> Result<Response, ProblemResponse> {
    table(&app, batch).await
}

async fn table(app: &App, batch: BatchId) -> Result<Response, ProblemResponse> {
    let evaluate = move |stored| batch.kind.table(&stored);
    let detail = batch.kind.table_detail();
    let table = app
        .evaluate_batch(batch, BatchPart::WHOLE, detail, evaluate)
        .await?;
    Ok(csv(batch, Body::from(table)))
}

/// The jobs of a table that follow.
#[derive(Debug, Clone, Copy)]
struct Rest {
    /// Position of the first of them.
    next: Option<u64>,
    /// Number of them at most; of those that were read, their number.
    jobs: u32,
}

/// How many jobs a part has, and where the next one begins if it is a whole part.
fn followed_by(jobs: &[BatchJob]) -> Rest {
    let number = u32::try_from(jobs.len()).unwrap_or(u32::MAX);
    let last = jobs.last().filter(|_| number >= MOST_JOBS);
    Rest {
        next: last.map(|last| last.position + 1),
        jobs: number,
    }
}

/// The next rows of a long table; an error ends the body early.
async fn next_rows(app: App, batch: BatchId, rest: Rest) -> io::Result<Option<(Bytes, Rest)>> {
    let Some(from) = rest.next.filter(|_| rest.jobs > 0) else {
        return Ok(None);
    };
    let part = BatchPart {
        from,
        limit: rest.jobs.min(MOST_JOBS),
    };
    let detail = batch.kind.table_detail();
    let jobs = app.store.batch_jobs(batch.id, part, detail).await;
    let jobs = jobs.map_err(io::Error::other)?;
    let found = followed_by(&jobs);
    let rows = tokio::task::spawn_blocking(move || batch::rows(&jobs)).await?;
    let rows = rows.map_err(io::Error::other)?;
    let rest = Rest {
        next: found.next,
        jobs: rest.jobs - found.jobs,
    };
    Ok(Some((Bytes::from(rows), rest)))
}

fn csv(batch: BatchId, body: Body) -> Response {
    let BatchId { kind, id } = batch;
    let headers = [
        (header::CONTENT_TYPE, CSV.to_owned()),
        (
            header::CONTENT_DISPOSITION,
            attachment(&format!("{kind}-{id}.csv")),
        ),
    ];
    (headers, body).into_response()
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{SWEEP, Service};

    #[tokio::test]
    async fn the_table_has_a_line_for_every_job() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let path = format!(
            "/v1/sweeps/{}/outcomes",
            sweep["id"].as_str().expect("an id")
        );
        let (status, headers, text) = service.text("GET", &path, &[], "").await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "text/csv; charset=utf-8");
        assert_eq!(text.lines().count(), 5);
        assert!(
            text.starts_with("job,status,outcome,/cycles,/load/n,cycles_done,"),
            "{text}"
        );
        assert!(text.contains(",queued,,10,0.3,"), "{text}");
        let nobody = "/v1/sweeps/00000000-0000-7000-8000-000000000000/outcomes";
        assert_eq!(service.get(nobody).await.0, 404);
    }

    #[tokio::test]
    async fn an_unknown_study_has_no_table() {
        let service = Service::new().await;
        let nobody = "/v1/studies/00000000-0000-7000-8000-000000000000/table";
        assert_eq!(service.get(nobody).await.0, 404);
    }
}
