//! `GET /v1/jobs/{id}/results/{profile,pressure,loop}`: parts of the stored snapshot nearest to a cycle, as JSON or
//! CSV.

use api::problem::Problem;
use api::results::{LineProfile, LineProfiles, Loop, Pressure, Profile};
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
use crate::export::{csv, line, thin};
use crate::http::app::App;
use crate::http::extract::{JobId, Params};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::results::max_points;
use crate::store::SnapshotPart;

/// Error of a part that a job does not have.
#[derive(Debug, thiserror::Error)]
enum SnapshotError {
    /// The job has no such section.
    #[error("job {id} has {stations} sections along a line at cycle {cycle}, no number {station}")]
    NoStation {
        id: Uuid,
        cycle: u64,
        stations: usize,
        station: u32,
    },
    /// Sections have no loop.
    #[error("the friction loop is that of the whole line; sections have a profile and a pressure")]
    WholeLine,
    /// The job has no stored snapshot.
    #[error("job {0} has no stored snapshot so far")]
    NoSnapshot(Uuid),
}

impl RouteError for SnapshotError {
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
    /// Number of a section along a `line` or a `ring`, from 0 on. Default: that in the middle of the line, or across the motion of the ring.
    #[param(maximum = 4_294_967_295_i64)]
    station: Option<u32>,
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
    let read = Read {
        part: SnapshotPart::Profile,
        write: csv::profile,
        thin: thin::profile,
        of_station: Some(|cycle, found| Profile {
            cycle,
            receptacle: found.receptacle_profile,
            slider: found.slider_profile,
        }),
    };
    read_part(&app, id, query, read).await
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
    let read = Read {
        part: SnapshotPart::Pressure,
        write: csv::pressure,
        thin: thin::pressure,
        of_station: Some(|cycle, found| Pressure {
            cycle,
            positions: found.positions,
        }),
    };
    read_part(&app, id, query, read).await
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
    let read = Read {
        part: SnapshotPart::Loop,
        write: csv::friction_loop,
        thin: thin::friction_loop,
        of_station: None,
    };
    read_part(&app, id, query, read).await
}

/// How a part of a snapshot is read.
struct Read<T> {
    part: SnapshotPart,
    /// Writes it as CSV.
    write: fn(&T) -> Result<Vec<u8>, CsvError>,
    /// Reduces its number of points.
    thin: fn(T, usize) -> T,
    /// Reads a section along a line at a cycle; the loop is that of the whole line.
    of_station: Option<fn(u64, LineProfile) -> T>,
}

/// Returns a part of the stored snapshot nearest to the requested cycle.
async fn read_part<T: DeserializeOwned + Serialize>(
    app: &App,
    id: Uuid,
    query: SnapshotQuery,
    read: Read<T>,
) -> Result<Response, ProblemResponse> {
    max_points::check(query.max_points)?;
    if query.station.is_some() && read.of_station.is_none() {
        app.job(id).await?;
        return Err(SnapshotError::WholeLine.into());
    }
    let Some(json) = app.store.snapshot(id, read.part, query.cycle).await? else {
        app.job(id).await?;
        return Err(SnapshotError::NoSnapshot(id).into());
    };
    let of_station = query.station.zip(read.of_station);
    if (query.format, query.max_points, of_station) == (Format::Json, None, None) {
        return Ok(([(header::CONTENT_TYPE, JSON)], json).into_response());
    }
    let mut document: T = match of_station {
        Some((station, part)) => {
            let At { cycle } = serde_json::from_str(&json)?;
            part(cycle, section(app, id, cycle, station).await?)
        }
        None => serde_json::from_str(&json)?,
    };
    if let Some(points) = query.max_points {
        document = (read.thin)(document, points);
    }
    Ok(match query.format {
        Format::Json => Json(document).into_response(),
        Format::Csv => {
            let table = (read.write)(&document)?;
            ([(header::CONTENT_TYPE, CSV)], table).into_response()
        }
    })
}

/// The cycle of a document.
#[derive(Deserialize)]
struct At {
    cycle: u64,
}

/// A section along a line at a stored cycle.
async fn section(
    app: &App,
    id: Uuid,
    cycle: u64,
    station: u32,
) -> Result<LineProfile, ProblemResponse> {
    let missing = |stations| SnapshotError::NoStation {
        id,
        cycle,
        stations,
        station,
    };
    let Some(file) = app.verified_file(id, &line::file_name(cycle)).await? else {
        return Err(missing(0).into());
    };
    let bytes = file.content.read().await?;
    let found: LineProfiles = serde_json::from_slice(&bytes)?;
    let stations = found.stations.len();
    let of_number = usize::try_from(station)
        .ok()
        .and_then(|number| found.stations.into_iter().nth(number));
    of_number.ok_or_else(|| missing(stations).into())
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
