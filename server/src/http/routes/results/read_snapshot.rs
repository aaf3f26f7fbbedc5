//! `GET /v1/jobs/{id}/results/{profile,pressure,loop}`: parts of the stored snapshot nearest to a cycle, as JSON or
//! CSV.

use api::problem::Problem;
use api::results::{Loop, Pressure, Profile};
use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};
use uuid::Uuid;

use crate::export::csv::CsvError;
use crate::export::documents::{CSV, JSON};
use crate::export::{csv, thin};
use crate::http::app::App;
use crate::http::extract::{JobId, Params};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::results::max_points;
use crate::store::SnapshotPart;

/// Error of a job without a stored snapshot.
#[derive(Debug, thiserror::Error)]
#[error("job {0} has no stored snapshot so far")]
struct NoSnapshotError(Uuid);

impl RouteError for NoSnapshotError {
    const TYPE: ProblemType = ProblemType::NO_SUCH_RESULT;
}

/// Format of a snapshot.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Format {
    /// JSON.
    #[default]
    Json,
    /// CSV, units in the header.
    Csv,
}

/// Cycle and format of a snapshot.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct SnapshotQuery {
    /// Cycle; the nearest stored one is returned. Default: the last one.
    cycle: Option<u64>,
    /// `json` or `csv`.
    #[serde(default)]
    format: Format,
    /// Maximum number of points of each curve; extrema are preserved.
    #[param(minimum = 16, maximum = 100_000)]
    max_points: Option<usize>,
}

/// Worn depth along both surfaces, at the stored cycle nearest to the requested one.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/profile",
    tag = "results",
    params(SnapshotQuery),
    responses(
        (status = 200, description = "The document", content((Profile = "application/json"), (String = "text/csv"))),
        (status = 404, description = "No such job, or no snapshot stored so far", body = Problem),
    )
)]
pub(crate) async fn profile(
    State(app): State<App>,
    JobId(id): JobId,
    Params(query): Params<SnapshotQuery>,
) -> Result<Response, ProblemResponse> {
    let part = SnapshotPart::Profile;
    read_part(&app, id, query, part, csv::profile, thin::profile).await
}

/// Contact pressure and shear stress, at the stored cycle nearest to the requested one.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/pressure",
    tag = "results",
    params(SnapshotQuery),
    responses(
        (status = 200, description = "The document", content((Pressure = "application/json"), (String = "text/csv"))),
        (status = 404, description = "No such job, or no snapshot stored so far", body = Problem),
    )
)]
pub(crate) async fn pressure(
    State(app): State<App>,
    JobId(id): JobId,
    Params(query): Params<SnapshotQuery>,
) -> Result<Response, ProblemResponse> {
    let part = SnapshotPart::Pressure;
    read_part(&app, id, query, part, csv::pressure, thin::pressure).await
}

/// Friction loop: tangential force over displacement, at the stored cycle nearest to the requested one.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/loop",
    tag = "results",
    params(SnapshotQuery),
    responses(
        (status = 200, description = "The document", content((Loop = "application/json"), (String = "text/csv"))),
        (status = 404, description = "No such job, or no snapshot stored so far", body = Problem),
    )
)]
pub(crate) async fn friction_loop(
    State(app): State<App>,
    JobId(id): JobId,
    Params(query): Params<SnapshotQuery>,
) -> Result<Response, ProblemResponse> {
    let part = SnapshotPart::Loop;
    read_part(
        &app,
        id,
        query,
        part,
        csv::friction_loop,
        thin::friction_loop,
    )
    .await
}

/// Returns a part of the stored snapshot nearest to the requested cycle. `write` writes it as CSV, `thin` reduces its
/// number of points.
async fn read_part<T: DeserializeOwned + Serialize>(
    app: &App,
    id: Uuid,
    query: SnapshotQuery,
    part: SnapshotPart,
    write: fn(&T) -> Result<Vec<u8>, CsvError>,
    thin: fn(T, usize) -> T,
) -> Result<Response, ProblemResponse> {
    max_points::check(query.max_points)?;
    let Some(json) = app.store.snapshot(id, part, query.cycle).await? else {
        app.job(id).await?;
        return Err(NoSnapshotError(id).into());
    };
    if (query.format, query.max_points) == (Format::Json, None) {
        return Ok(([(header::CONTENT_TYPE, JSON)], json).into_response());
    }
    let mut document: T = serde_json::from_str(&json)?;
    if let Some(points) = query.max_points {
        document = thin(document, points);
    }
    Ok(match query.format {
        Format::Json => Json(document).into_response(),
        Format::Csv => {
            let table = write(&document)?;
            ([(header::CONTENT_TYPE, CSV)], table).into_response()
        }
    })
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    /// Last segment of the path, header of the CSV, lines of the CSV.
    const PARTS: [(&str, &str, usize); 3] = [
        ("profile", "side,x_mm,depth_mm", 3),
        (
            "pressure",
            "phase,slider_x_mm,x_mm,pressure_mpa,shear_mpa",
            3,
        ),
        ("loop", "displacement_mm,tangential_force_n_per_mm", 3),
    ];

    fn path(id: &str, part: &str) -> String {
        format!("/v1/jobs/{id}/results/{part}")
    }

    #[tokio::test]
    async fn the_nearest_stored_cycle_is_returned() {
        let service = Service::new().await;
        let id = service.with_results().await;
        for (part, _, _) in PARTS {
            for (query, cycle) in [
                ("", 20),
                ("?cycle=0", 10),
                ("?cycle=14", 10),
                ("?cycle=16", 20),
                ("?cycle=999", 20),
            ] {
                let path = format!("{}{query}", path(&id, part));
                let (status, _, document) = service.get(&path).await;
                let found = (status.as_u16(), document["cycle"].as_u64());
                assert_eq!(found, (200, Some(cycle)), "{path}");
            }
        }
    }

    #[tokio::test]
    async fn csv_has_units_in_its_header() {
        let service = Service::new().await;
        let id = service.with_results().await;
        for (part, header, lines) in PARTS {
            let path = format!("{}?format=csv", path(&id, part));
            let (status, headers, text) = service.text("GET", &path, &[], "").await;
            assert_eq!(status, 200);
            assert_eq!(headers["content-type"], "text/csv; charset=utf-8");
            assert_eq!(text.lines().next(), Some(header));
            assert_eq!(text.lines().count(), lines);
        }
    }

    #[tokio::test]
    async fn missing_snapshots_and_invalid_queries_are_problems() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        for (part, _, _) in PARTS {
            let (status, _, problem) = service.get(&path(&id, part)).await;
            let found = (status.as_u16(), problem["type"].as_str());
            assert_eq!(found, (404, Some("/problems/no-such-result")));
            let unknown = path("00000000-0000-7000-8000-000000000000", part);
            let (_, _, problem) = service.get(&unknown).await;
            assert_eq!(problem["type"], "/problems/no-such-job");
            for query in ["cycle=-1", "max_points=15", "max_points=100001", "cycles=1"] {
                let path = format!("{}?{query}", path(&id, part));
                assert_eq!(service.get(&path).await.0, 400, "{query}");
            }
        }
    }
}
