//! Problem documents (RFC 9457).

use api::problem::{Fault, Problem};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::export::csv::CsvError;
use crate::export::documents::DocumentError;
use crate::export::parquet::ParquetError;
pub(super) use crate::http::problem_type::ProblemType;
use crate::objects::ObjectsError;
use crate::spec::Refused;
use crate::store::{ContentError, StoreError};
use crate::worker::JobSourceError;

/// Media type of a problem document.
pub(in crate::http) const MEDIA_TYPE: &str = "application/problem+json";

/// `Retry-After` of a request that the service cannot take at present, s.
const RETRY_AFTER_S: &str = "5";

/// Marks a response with the problem of a full disk; [`crate::http::disk_space`] adds the free space to it.
#[derive(Debug, Clone, Copy)]
pub(super) struct DiskFull;

impl ProblemType {
    /// A problem of this type with its explanation.
    pub(super) fn with_detail(self, detail: impl Into<String>) -> ProblemResponse {
        ProblemResponse {
            problem_type: self,
            detail: Some(detail.into()),
            faults: Vec::new(),
        }
    }
}

/// A problem as the response of a route.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ProblemResponse {
    problem_type: ProblemType,
    detail: Option<String>,
    faults: Vec<Fault>,
}

impl ProblemResponse {
    /// Adds the faults of the submitted document.
    fn with_faults(mut self, faults: Vec<Fault>) -> Self {
        self.faults = faults;
        self
    }

    /// Document.
    pub(super) fn document(self) -> Problem {
        let ProblemType {
            status,
            name,
            title,
            ..
        } = self.problem_type;
        Problem {
            kind: format!("/problems/{name}"),
            title: title.to_owned(),
            status,
            detail: self.detail,
            faults: self.faults,
        }
    }

    /// An internal error: the cause is logged here and hidden from the client.
    pub(super) fn internal(cause: &dyn std::error::Error) -> Self {
        tracing::error!(%cause, "a request failed");
        Self {
            problem_type: ProblemType::INTERNAL,
            detail: None,
            faults: Vec::new(),
        }
    }
}

/// An error of a route. `?` in a handler turns it into the response, with the error's text as detail.
pub(super) trait RouteError: std::error::Error {
    /// Type of the problem, if all variants of the error have the same.
    const TYPE: ProblemType = ProblemType::INTERNAL;

    /// Type of the problem.
    fn problem_type(&self) -> ProblemType {
        Self::TYPE
    }
}

impl RouteError for serde_json::Error {}
impl RouteError for std::fmt::Error {}
impl RouteError for tokio::task::JoinError {}
impl RouteError for CsvError {}
impl RouteError for ParquetError {}
impl RouteError for DocumentError {}

impl<E: RouteError> From<E> for ProblemResponse {
    fn from(error: E) -> Self {
        match error.problem_type() {
            ProblemType::INTERNAL => Self::internal(&error),
            problem_type => problem_type.with_detail(error.to_string()),
        }
    }
}

impl From<JobSourceError> for ProblemResponse {
    fn from(error: JobSourceError) -> Self {
        match error {
            JobSourceError::Store(error) => error.into(),
            JobSourceError::Remote(error) => Self::internal(&error),
        }
    }
}

impl From<StoreError> for ProblemResponse {
    fn from(error: StoreError) -> Self {
        let problem = match &error {
            error if error.is_disk_full() => {
                ProblemType::DISK_FULL.with_detail(StoreError::DiskFull.to_string())
            }
            StoreError::DamagedResults { .. } => {
                tracing::error!(%error, "results are damaged");
                return ProblemType::RESULT_DAMAGED.with_detail(error.to_string());
            }
            StoreError::Objects(cause @ ObjectsError::Missing(_)) => {
                tracing::error!(%cause, "results are missing");
                return ProblemType::RESULT_DAMAGED.with_detail(cause.to_string());
            }
            StoreError::Objects(ObjectsError::Unmarked(_)) => ProblemType::RESULTS_UNREACHABLE
                .with_detail(
                    "the store of objects has lost its mark: it is another one, or is not mounted",
                ),
            StoreError::Objects(ObjectsError::Damaged { .. }) => {
                tracing::error!(%error, "stored file is corrupt");
                return ProblemType::FILE_DIFFERS.with_detail(error.to_string());
            }
            StoreError::LostFile(_) | StoreError::NoFile { .. } => {
                ProblemType::RESULTS_UNREACHABLE.with_detail(error.to_string())
            }
            StoreError::Objects(_) => ProblemType::RESULTS_UNREACHABLE
                .with_detail("the store of objects does not answer; send the request again"),
            error if error.is_locked() => ProblemType::BUSY
                .with_detail("another program has locked the database; send the request again"),
            error if error.is_transient() => {
                ProblemType::BUSY.with_detail("the database is busy; send the request again")
            }
            error => return Self::internal(error),
        };
        tracing::warn!(%error, "a request was rejected for now");
        problem
    }
}

impl From<ContentError> for ProblemResponse {
    fn from(error: ContentError) -> Self {
        match error {
            ContentError::Object(cause) => StoreError::Objects(cause).into(),
            ContentError::File(cause) => Self::internal(&cause),
        }
    }
}

impl From<Refused> for ProblemResponse {
    fn from(refused: Refused) -> Self {
        match refused {
            Refused::Parse(error) => {
                let detail = error.to_string();
                let mut faults = vec![Fault::new(error.pointer, error.detail)];
                faults.extend(error.others);
                ProblemType::UNREADABLE_BODY
                    .with_detail(detail)
                    .with_faults(faults)
            }
            Refused::Faults(faults) => ProblemType::INVALID_SPECIFICATION
                .with_detail(format!("{} fault(s) in the specification", faults.len()))
                .with_faults(faults),
        }
    }
}

impl IntoResponse for ProblemResponse {
    fn into_response(self) -> Response {
        let problem_type = self.problem_type;
        let is_full = self.detail == Some(StoreError::DiskFull.to_string());
        let status = StatusCode::from_u16(problem_type.status);
        let status = status.unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut response = (status, axum::Json(self.document())).into_response();
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE));
        let is_temporary = [
            ProblemType::BUSY,
            ProblemType::DISK_FULL,
            ProblemType::RESULTS_UNREACHABLE,
        ];
        if is_temporary.contains(&problem_type) {
            headers.insert(header::RETRY_AFTER, HeaderValue::from_static(RETRY_AFTER_S));
        }
        if is_full {
            response.extensions_mut().insert(DiskFull);
        }
        response
    }
}

#[cfg(test)]
mod tests;
