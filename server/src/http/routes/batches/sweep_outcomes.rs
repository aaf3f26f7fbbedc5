//! `GET /v1/sweeps/{id}/outcomes`: what came out of a sweep, one line a job.

use api::problem::Problem;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use crate::batch::outcomes::{Row, table};
use crate::export::documents::CSV;
use crate::http::App;
use crate::http::extract::SweepId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::show_sweep::SweepError;
use crate::http::routes::results::download_file::attachment;

/// What came out of a sweep so far, as CSV: what sets each job apart, where it stands, and its result.
#[utoipa::path(
    get,
    path = "/v1/sweeps/{id}/outcomes",
    tag = "sweeps",
    params(("id" = Uuid, Path, description = "The sweep")),
    responses(
        (status = 200, description = "The table", content_type = "text/csv", body = String),
        (status = 404, description = "No such sweep", body = Problem),
    )
)]
pub(in crate::http) async fn sweep_outcomes(
    State(app): State<App>,
    SweepId(id): SweepId,
) -> Result<Response, ProblemResponse> {
    let outcomes = app.store.sweep_outcomes(id).await?;
    let outcomes = outcomes.ok_or(SweepError::Missing(id))?;
    let rows: Vec<Row<'_>> = outcomes
        .iter()
        .map(|outcome| Row {
            id: outcome.job.id,
            overrides: &outcome.job.overrides,
            status: outcome.job.status,
            outcome: outcome.job.outcome,
            summary: outcome.summary.as_ref(),
        })
        .collect();
    let headers = [
        (header::CONTENT_TYPE, CSV.to_owned()),
        (
            header::CONTENT_DISPOSITION,
            attachment(&format!("sweep-{id}.csv")),
        ),
    ];
    Ok((headers, table(&rows)?).into_response())
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
}
