//! `GET /v1/sweeps/{id}/outcomes` and `GET /v1/studies/{id}/table`: the results of a batch as a table.

use api::problem::Problem;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use crate::export::documents::CSV;
use crate::http::app::App;
use crate::http::extract::BatchId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::results::download_file::attachment;

/// The results of a sweep so far as CSV: changes, status and figures, one line per job.
#[utoipa::path(
    get,
    path = "/v1/sweeps/{id}/outcomes",
    tag = "sweeps",
    responses(
        (status = 200, description = "The table", content_type = "text/csv", body = String),
    )
)]
pub(crate) async fn sweep_outcomes(
    app: State<App>,
    batch: BatchId,
) -> Result<Response, ProblemResponse> {
    table(&app, batch).await
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
    let BatchId { kind, id } = batch;
    let evaluate = move |stored| kind.table(&stored);
    let table = app
        .evaluate_batch(batch, kind.table_detail(), evaluate)
        .await?;
    let name = attachment(&format!("{kind}-{id}.csv"));
    let headers = [
        (header::CONTENT_TYPE, CSV.to_owned()),
        (header::CONTENT_DISPOSITION, name),
    ];
    Ok((headers, table).into_response())
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
