//! `GET /v1/jobs/{id}/results/wear-history`: wear over the cycles, also while the job runs.

use api::results::WearHistory;
use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use solver::record::{CycleReport, Record};
use utoipa::{IntoParams, ToSchema};

use crate::export::documents::{CSV, PARQUET};
use crate::export::{csv, history, parquet, thin};
use crate::http::app::App;
use crate::http::extract::{JobId, Params};
use crate::http::problem::ProblemResponse;
use crate::http::routes::results::max_points;

/// Format and length of a history.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct HistoryQuery {
    /// `json`, `csv` or `parquet`.
    #[serde(default)]
    format: HistoryFormat,
    /// Maximum number of rows; extrema of every column are preserved.
    #[param(minimum = 16, maximum = 100_000)]
    max_points: Option<usize>,
}

/// Format of a history.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum HistoryFormat {
    /// JSON.
    #[default]
    Json,
    /// CSV, units in the header.
    Csv,
    /// Apache Parquet, units in the names of the columns.
    Parquet,
}

/// Wear over the cycles computed so far, as columns.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/wear-history",
    tag = "results",
    params(HistoryQuery),
    responses(
        (status = 200, description = "The history", content(
            (WearHistory = "application/json"),
            (String = "text/csv"),
            (Vec<u8> = "application/vnd.apache.parquet"),
        )),
    )
)]
pub(crate) async fn wear_history(
    State(app): State<App>,
    JobId(id): JobId,
    Params(query): Params<HistoryQuery>,
) -> Result<Response, ProblemResponse> {
    let job = app.job(id).await?;
    max_points::check(query.max_points)?;
    let rows = app.store.history(id).await?;
    let stations = job.document.spec.output.stations_mm.unwrap_or_default();
    // Writing a long history blocks; other requests are served meanwhile.
    let write = move || write(rows, &stations, query);
    tokio::task::spawn_blocking(write).await?
}

fn write(
    mut rows: Vec<CycleReport>,
    stations: &[f64],
    query: HistoryQuery,
) -> Result<Response, ProblemResponse> {
    if let Some(points) = query.max_points {
        rows = thin::rows(rows, points);
    }
    let record = Record::new(&rows, stations);
    Ok(match query.format {
        HistoryFormat::Json => Json(history::wear_history(record)).into_response(),
        HistoryFormat::Csv => {
            let table = csv::wear_history(&record)?;
            ([(header::CONTENT_TYPE, CSV)], table).into_response()
        }
        HistoryFormat::Parquet => {
            let table = parquet::wear_history(&record)?;
            ([(header::CONTENT_TYPE, PARQUET)], table).into_response()
        }
    })
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn the_rows_so_far_are_returned_as_columns() {
        let service = Service::new().await;
        let id = service.with_results().await;
        let (status, _, history) = service
            .get(&format!("/v1/jobs/{id}/results/wear-history"))
            .await;
        assert_eq!(status, 200);
        assert_eq!(history["cycle"], serde_json::json!([10, 20]));
        assert_eq!(
            history["stations"][1]["depth_mm"],
            serde_json::json!([0.5, 0.5])
        );
        assert_eq!(history["stations"][1]["side"], "receptacle");
    }

    #[tokio::test]
    async fn csv_has_the_same_columns() {
        let service = Service::new().await;
        let id = service.with_results().await;
        let path = format!("/v1/jobs/{id}/results/wear-history?format=csv");
        let (_, headers, text) = service.text("GET", &path, &[], "").await;
        assert_eq!(headers["content-type"], "text/csv; charset=utf-8");
        let header = text.lines().next().expect("a header");
        assert!(
            header.starts_with("cycle,jump,sliding_distance_mm,receptacle_depth_at_"),
            "{header}"
        );
        assert!(
            header.ends_with(
                "peak_pressure_mpa,contact_half_width_mm,dissipated_energy_mj_per_mm,friction_coefficient"
            ),
            "{header}"
        );
        assert_eq!(text.lines().count(), 3);
    }

    #[tokio::test]
    async fn before_the_first_row_the_columns_are_empty() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}/results/wear-history");
        assert_eq!(service.get(&path).await.2["cycle"], serde_json::json!([]));
        for query in ["format=xml", "max_points=1", "max_point=20"] {
            assert_eq!(
                service.get(&format!("{path}?{query}")).await.0,
                400,
                "{query}"
            );
        }
    }

    #[tokio::test]
    async fn parquet_has_the_magic_bytes_of_its_format() {
        let service = Service::new().await;
        let id = service.with_results().await;
        let path = format!("/v1/jobs/{id}/results/wear-history?format=parquet&max_points=16");
        let (status, headers, bytes) = service.bytes("GET", &path, &[], "").await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "application/vnd.apache.parquet");
        assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
    }
}
