//! Problem documents (RFC 9457), and the table of their types. A type, once published, is never renamed.

use api::problem::{Fault, Problem};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::export::csv::CsvError;
use crate::export::documents::DocumentError;
use crate::export::parquet::ParquetError;
use crate::spec::Refused;
use crate::store::StoreError;

/// Media type of a problem document.
const MEDIA_TYPE: &str = "application/problem+json";

/// `Retry-After` of a request that the service cannot take at present, s.
const RETRY_AFTER_S: &str = "5";

/// Type of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ProblemType {
    /// The body is not JSON, or a value in it has the wrong type.
    UnreadableBody,
    /// The specification has faults.
    InvalidSpecification,
    /// The `Idempotency-Key` was used with another body.
    KeyReused,
    /// The `Idempotency-Key` is not valid.
    InvalidKey,
    /// A query parameter is not valid.
    InvalidQuery,
    /// The range lies outside the file.
    Range,
    /// The body is too large.
    BodyTooLarge,
    /// The body is not declared as JSON.
    MediaType,
    /// No route has this path.
    NoSuchPath,
    /// The path does not support this method.
    WrongMethod,
    /// No job has this id.
    NoSuchJob,
    /// No sweep has this id.
    NoSuchSweep,
    /// No accuracy study has this id.
    NoSuchStudy,
    /// The study was stored in a format that this version cannot compare.
    StudyOutdated,
    /// The job has no such result (yet).
    NoSuchResult,
    /// No contact system has this name.
    NoSuchSystem,
    /// The job has not ended.
    JobActive,
    /// A job of the sweep has not ended.
    SweepActive,
    /// A job of the study has not ended.
    StudyActive,
    /// The request was sent for another host or from another origin.
    ForeignHost,
    /// The access token is missing or wrong.
    TokenRequired,
    /// The request did not arrive in time.
    RequestTimeout,
    /// The service cannot take the request at present.
    Busy,
    /// Internal error.
    Internal,
}

impl ProblemType {
    /// Status, name and title.
    fn row(self) -> (u16, &'static str, &'static str) {
        match self {
            Self::UnreadableBody => (400, "unreadable-body", "the body cannot be read"),
            Self::InvalidSpecification => {
                (422, "invalid-specification", "the specification has faults")
            }
            Self::KeyReused => (
                422,
                "idempotency-key-reused",
                "the key was used with another body",
            ),
            Self::InvalidKey => (400, "invalid-idempotency-key", "the key is not valid"),
            Self::InvalidQuery => (400, "invalid-query", "a query parameter is not valid"),
            Self::Range => (416, "range", "the range lies outside the file"),
            Self::BodyTooLarge => (413, "body-too-large", "the body is too large"),
            Self::MediaType => (415, "media-type", "the body is not declared as JSON"),
            Self::NoSuchPath => (404, "no-such-path", "there is no such path"),
            Self::WrongMethod => (405, "wrong-method", "the path does not support this method"),
            Self::NoSuchJob => (404, "no-such-job", "there is no such job"),
            Self::NoSuchSweep => (404, "no-such-sweep", "there is no such sweep"),
            Self::NoSuchStudy => (404, "no-such-study", "there is no such study"),
            Self::StudyOutdated => (
                410,
                "study-outdated",
                "the study cannot be compared any more",
            ),
            Self::NoSuchResult => (404, "no-such-result", "the job has no such result"),
            Self::NoSuchSystem => (404, "no-such-system", "there is no such system"),
            Self::JobActive => (409, "job-active", "the job has not ended"),
            Self::SweepActive => (
                409,
                "sweep-active",
                "the sweep has jobs that have not ended",
            ),
            Self::StudyActive => (
                409,
                "study-active",
                "the study has jobs that have not ended",
            ),
            Self::ForeignHost => (403, "foreign-host", "the request is for another host"),
            Self::TokenRequired => (
                401,
                "token-required",
                "the access token is missing or wrong",
            ),
            Self::RequestTimeout => (408, "request-timeout", "the request did not arrive in time"),
            Self::Busy => (
                503,
                "busy",
                "the service cannot take the request at present",
            ),
            Self::Internal => (500, "internal", "internal error"),
        }
    }

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

    /// An internal error: the cause is logged here and hidden from the client.
    pub(super) fn internal(cause: &dyn std::error::Error) -> Self {
        tracing::error!(%cause, "a request failed");
        Self {
            problem_type: ProblemType::Internal,
            detail: None,
            faults: Vec::new(),
        }
    }
}

/// An error of a route. `?` in a handler turns it into the response, with the error's text as detail.
pub(super) trait RouteError: std::error::Error {
    /// Type of the problem.
    fn problem_type(&self) -> ProblemType {
        ProblemType::Internal
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
            ProblemType::Internal => Self::internal(&error),
            problem_type => problem_type.with_detail(error.to_string()),
        }
    }
}

impl From<StoreError> for ProblemResponse {
    fn from(error: StoreError) -> Self {
        let detail = match &error {
            error if error.is_disk_full() => "no space left on the data disk",
            error if error.is_transient() => "the database is busy; send the request again",
            error => return Self::internal(error),
        };
        tracing::warn!(%error, "a request was rejected for now");
        ProblemType::Busy.with_detail(detail)
    }
}

impl From<Refused> for ProblemResponse {
    fn from(refused: Refused) -> Self {
        match refused {
            Refused::Parse(error) => {
                let detail = error.to_string();
                let fault = Fault::new(error.pointer, error.detail);
                ProblemType::UnreadableBody
                    .with_detail(detail)
                    .with_faults(vec![fault])
            }
            Refused::Faults(faults) => ProblemType::InvalidSpecification
                .with_detail(format!("{} fault(s) in the specification", faults.len()))
                .with_faults(faults),
        }
    }
}

impl IntoResponse for ProblemResponse {
    fn into_response(self) -> Response {
        let (status, name, title) = self.problem_type.row();
        let problem = Problem {
            kind: format!("/problems/{name}"),
            title: title.to_owned(),
            status,
            detail: self.detail,
            faults: self.faults,
        };
        let status = StatusCode::from_u16(status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut response = (status, axum::Json(problem)).into_response();
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE));
        if self.problem_type == ProblemType::Busy {
            headers.insert(header::RETRY_AFTER, HeaderValue::from_static(RETRY_AFTER_S));
        }
        response
    }
}

#[cfg(test)]
mod tests;
