//! `GET /v1/studies/{id}/table`: what accuracy costs, one line a run.

use api::problem::Problem;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use crate::export::csv;
use crate::export::documents::{CSV, DocumentError};
use crate::http::App;
use crate::http::extract::StudyId;
use crate::http::problem::ProblemResponse;
use crate::http::routes::batches::show_study::evaluated;
use crate::http::routes::results::download_file::attachment;

/// The runs of a study so far as CSV: settings, errors, cost.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/table",
    tag = "studies",
    params(("id" = Uuid, Path, description = "The study")),
    responses(
        (status = 200, description = "The table", content_type = "text/csv", body = String),
        (status = 404, description = "No such study, or no results so far", body = Problem),
        (status = 410, description = "Queued by a version whose studies cannot be compared any more", body = Problem),
    )
)]
pub(in crate::http) async fn study_table(
    State(app): State<App>,
    StudyId(id): StudyId,
) -> Result<Response, ProblemResponse> {
    let study = evaluated(&app, id).await?;
    let table = csv::study(&study).map_err(DocumentError::from)?;
    let headers = [
        (header::CONTENT_TYPE, CSV.to_owned()),
        (
            header::CONTENT_DISPOSITION,
            attachment(&format!("study-{id}.csv")),
        ),
    ];
    Ok((headers, table).into_response())
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn an_unknown_study_has_no_table() {
        let service = Service::new().await;
        let nobody = "/v1/studies/00000000-0000-7000-8000-000000000000/table";
        assert_eq!(service.get(nobody).await.0, 404);
    }
}
