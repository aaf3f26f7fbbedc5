//! What the routes of stored snapshots share: the nearest stored cycle, as JSON or CSV.

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use utoipa::{IntoParams, ToSchema};
use uuid::Uuid;

use super::App;
use super::problem::{Kind, Refusal};
use crate::store::{SnapshotPart, StoreError};
use crate::translate::csv::CsvError;

/// Media types of results.
pub(super) const JSON: &str = "application/json";
pub(super) const CSV: &str = "text/csv; charset=utf-8";

/// Why there is no such result.
#[derive(Debug, thiserror::Error)]
pub(super) enum ResultError {
    /// There is no job of that id.
    #[error("there is no job {0}")]
    Missing(Uuid),
    /// Nothing is stored yet.
    #[error("job {0} has no stored snapshot so far")]
    Empty(Uuid),
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A stored document cannot be read.
    #[error(transparent)]
    Read(#[from] serde_json::Error),
    /// It could not be written as CSV.
    #[error(transparent)]
    Csv(#[from] CsvError),
}

impl IntoResponse for ResultError {
    fn into_response(self) -> Response {
        match &self {
            Self::Missing(_) => Kind::NoJob.because(self.to_string()),
            Self::Empty(_) => Kind::NoResult.because(self.to_string()),
            Self::Store(error) => Refusal::from(error),
            Self::Read(error) => Refusal::internal(error),
            Self::Csv(error) => Refusal::internal(error),
        }
        .into_response()
    }
}

/// How a result is written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Format {
    /// JSON.
    #[default]
    Json,
    /// CSV, units in the header.
    Csv,
}

/// Which snapshot, and how.
#[derive(Debug, Clone, Copy, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(super) struct SnapshotQuery {
    /// The cycle; the nearest stored one is returned, the last one if none is named.
    cycle: Option<u64>,
    /// `json` or `csv`.
    #[serde(default)]
    format: Format,
}

/// A part of the stored snapshot nearest to the named cycle.
pub(super) async fn respond<T: DeserializeOwned>(
    State(app): State<App>,
    id: Uuid,
    query: SnapshotQuery,
    part: SnapshotPart,
    csv: fn(&T) -> Result<Vec<u8>, CsvError>,
) -> Result<Response, ResultError> {
    let Some(document) = app.store.snapshot(id, part, query.cycle).await? else {
        let known = app.store.job(id).await?.is_some();
        return Err(if known {
            ResultError::Empty(id)
        } else {
            ResultError::Missing(id)
        });
    };
    Ok(match query.format {
        Format::Json => ([(header::CONTENT_TYPE, JSON)], document).into_response(),
        Format::Csv => (
            [(header::CONTENT_TYPE, CSV)],
            csv(&serde_json::from_str(&document)?)?,
        )
            .into_response(),
    })
}
