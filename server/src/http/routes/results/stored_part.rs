//! What the routes of stored snapshots share: the nearest stored cycle, as JSON or CSV.

use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};
use uuid::Uuid;

use crate::export::csv::CsvError;
use crate::export::documents::{CSV, DocumentError, JSON};
use crate::export::thin::FEWEST_POINTS;
use crate::http::App;
use crate::http::job_error::JobError;
use crate::http::problem::{Kind, Refusal};
use crate::store::SnapshotPart;

/// Why there is no such result.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum ResultError {
    /// There is no such job.
    #[error(transparent)]
    Job(#[from] JobError),
    /// Nothing is stored yet.
    #[error("job {0} has no stored snapshot so far")]
    Empty(Uuid),
    /// Too few points, or too many.
    #[error("max_points is {0}; it can be {FEWEST_POINTS} to {MOST_POINTS}")]
    Points(usize),
    /// A stored document cannot be read.
    #[error(transparent)]
    Read(#[from] serde_json::Error),
    /// Its writing was broken off.
    #[error("the result was not written: {0}")]
    Broken(#[from] tokio::task::JoinError),
    /// It could not be written.
    #[error(transparent)]
    Write(#[from] DocumentError),
}

impl IntoResponse for ResultError {
    fn into_response(self) -> Response {
        match &self {
            Self::Job(error) => Refusal::from(error),
            Self::Empty(_) => Kind::NoResult.because(self.to_string()),
            Self::Read(error) => Refusal::internal(error),
            Self::Points(_) => Kind::InvalidQuery.because(self.to_string()),
            Self::Write(error) => Refusal::internal(error),
            Self::Broken(error) => Refusal::internal(error),
        }
        .into_response()
    }
}

/// Most points that a client may ask for; whoever wants more can have all.
const MOST_POINTS: usize = 100_000;

/// How a result is written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(in crate::http) enum Format {
    /// JSON.
    #[default]
    Json,
    /// CSV, units in the header.
    Csv,
}

/// Which snapshot, and how.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(in crate::http) struct SnapshotQuery {
    /// The cycle; the nearest stored one is returned, the last one if none is named.
    cycle: Option<u64>,
    /// `json` or `csv`.
    #[serde(default)]
    format: Format,
    /// At most so many points of each curve; extremes stay.
    #[param(minimum = 16, maximum = 100_000)]
    max_points: Option<usize>,
}

/// Checks how many points are wanted.
pub(in crate::http) fn points(wanted: Option<usize>) -> Result<Option<usize>, ResultError> {
    match wanted {
        Some(points) if !(FEWEST_POINTS..=MOST_POINTS).contains(&points) => {
            Err(ResultError::Points(points))
        }
        other => Ok(other),
    }
}

/// What can be done with a stored document of a kind.
pub(in crate::http) struct Forms<T> {
    /// As CSV.
    pub(in crate::http) csv: fn(&T) -> Result<Vec<u8>, CsvError>,
    /// With fewer points.
    pub(in crate::http) thin: fn(T, usize) -> T,
}

/// A part of the stored snapshot nearest to the named cycle.
pub(in crate::http) async fn respond<T: DeserializeOwned + Serialize>(
    State(app): State<App>,
    id: Uuid,
    query: SnapshotQuery,
    part: SnapshotPart,
    forms: Forms<T>,
) -> Result<Response, ResultError> {
    let points = points(query.max_points)?;
    let stored = app.store.snapshot(id, part, query.cycle).await;
    let Some(document) = stored.map_err(JobError::from)? else {
        app.job(id).await?;
        return Err(ResultError::Empty(id));
    };
    if (query.format, points) == (Format::Json, None) {
        return Ok(([(header::CONTENT_TYPE, JSON)], document).into_response());
    }
    let mut document: T = serde_json::from_str(&document)?;
    if let Some(points) = points {
        document = (forms.thin)(document, points);
    }
    Ok(match query.format {
        Format::Json => Json(document).into_response(),
        Format::Csv => {
            let table = (forms.csv)(&document).map_err(DocumentError::from)?;
            ([(header::CONTENT_TYPE, CSV)], table).into_response()
        }
    })
}

/// What every route of a stored part must do, whichever part it is.
#[cfg(test)]
pub(in crate::http) mod checks {
    use crate::http::tests::Service;

    fn path(id: &str, part: &str) -> String {
        format!("/v1/jobs/{id}/results/{part}")
    }

    pub(in crate::http) async fn nearest(part: &str) {
        let service = Service::new().await;
        let id = service.with_results().await;
        let asked = [
            ("", 20),
            ("?cycle=0", 10),
            ("?cycle=14", 10),
            ("?cycle=16", 20),
            ("?cycle=999", 20),
        ];
        for (query, cycle) in asked {
            let (status, _, document) = service.get(&format!("{}{query}", path(&id, part))).await;
            let found = (status.as_u16(), document["cycle"].as_u64());
            assert_eq!(found, (200, Some(cycle)), "{query}");
        }
    }

    pub(in crate::http) async fn csv(part: &str, header: &str, lines: usize) {
        let service = Service::new().await;
        let id = service.with_results().await;
        let asked = format!("{}?format=csv", path(&id, part));
        let (status, headers, text) = service.text("GET", &asked, &[], "").await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "text/csv; charset=utf-8");
        assert_eq!(text.lines().next(), Some(header));
        assert_eq!(text.lines().count(), lines);
    }

    pub(in crate::http) async fn missing(part: &str) {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (status, _, problem) = service.get(&path(&id, part)).await;
        let found = (status.as_u16(), problem["type"].as_str());
        assert_eq!(found, (404, Some("/problems/no-such-result")));
        let nobody = path("00000000-0000-7000-8000-000000000000", part);
        assert_eq!(
            service.get(&nobody).await.2["type"],
            "/problems/no-such-job"
        );
        for query in ["cycle=-1", "max_points=15", "max_points=100001", "cycles=1"] {
            let unreadable = format!("{}?{query}", path(&id, part));
            assert_eq!(service.get(&unreadable).await.0, 400, "{query}");
        }
    }
}
