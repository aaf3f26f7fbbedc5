//! `GET /v1/studies/{id}/picture`: the work-precision diagram.

use api::problem::Problem;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::{IntoParams, ToSchema};

use crate::batch::accuracy::{self, report};
use crate::export::documents::SVG;
use crate::http::app::App;
use crate::http::extract::{BatchId, Params};
use crate::http::problem::ProblemResponse;
use crate::store::BatchPart;

/// Format of a picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum PictureFormat {
    /// SVG.
    #[default]
    Svg,
}

/// Options of the picture.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct PictureQuery {
    /// `svg`.
    #[serde(default)]
    format: PictureFormat,
}

/// Errors of the runs so far over processor seconds, both axes logarithmic.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/picture",
    tag = "studies",
    params(PictureQuery),
    responses(
        (status = 200, description = "The picture", content_type = "image/svg+xml", body = Vec<u8>),
        (status = 404, description = "No such study, or no results so far", body = Problem),
        (status = 410, description = "Queued by a version whose studies cannot be compared any more", body = Problem),
    )
)]
pub(crate) async fn study_picture(
    State(app): State<App>,
    batch: BatchId,
    Params(query): Params<PictureQuery>,
) -> Result<Response, ProblemResponse> {
    let draw = move |stored| {
        let study = accuracy::study(&stored)?;
        Ok(match query.format {
            PictureFormat::Svg => (SVG, report::svg(&study)?.into_bytes()),
        })
    };
    let detail = batch.kind.document_detail();
    let (media_type, bytes) = app
        .evaluate_batch(batch, BatchPart::WHOLE, detail, draw)
        .await?;
    Ok(([(header::CONTENT_TYPE, media_type)], bytes).into_response())
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn an_unknown_format_is_refused_and_an_unknown_study_is_missing() {
        let service = Service::new().await;
        let nobody = "/v1/studies/00000000-0000-7000-8000-000000000000/picture";
        assert_eq!(service.get(nobody).await.0, 404);
        assert_eq!(service.get(&format!("{nobody}?format=gif")).await.0, 400);
    }
}
