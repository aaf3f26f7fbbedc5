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

/// Type of a problem: a row of the table below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ProblemType {
    status: u16,
    name: &'static str,
    /// Title, the same for every problem of the type.
    title: &'static str,
}

const fn row(status: u16, name: &'static str, title: &'static str) -> ProblemType {
    ProblemType {
        status,
        name,
        title,
    }
}

impl ProblemType {
    pub(super) const UNREADABLE_BODY: Self = row(400, "unreadable-body", "the body cannot be read");
    pub(super) const INVALID_SPECIFICATION: Self =
        row(422, "invalid-specification", "the specification has faults");
    pub(super) const KEY_REUSED: Self = row(
        422,
        "idempotency-key-reused",
        "the key was used with another body",
    );
    pub(super) const INVALID_KEY: Self =
        row(400, "invalid-idempotency-key", "the key is not valid");
    pub(super) const INVALID_QUERY: Self =
        row(400, "invalid-query", "a query parameter is not valid");
    pub(super) const RANGE: Self = row(416, "range", "the range lies outside the file");
    pub(super) const BODY_TOO_LARGE: Self = row(413, "body-too-large", "the body is too large");
    pub(super) const MEDIA_TYPE: Self = row(415, "media-type", "the body is not declared as JSON");
    pub(super) const NO_SUCH_PATH: Self = row(404, "no-such-path", "there is no such path");
    pub(super) const WRONG_METHOD: Self =
        row(405, "wrong-method", "the path does not support this method");
    pub(super) const NO_SUCH_JOB: Self = row(404, "no-such-job", "there is no such job");
    pub(super) const NO_SUCH_SWEEP: Self = row(404, "no-such-sweep", "there is no such sweep");
    pub(super) const NO_SUCH_STUDY: Self = row(404, "no-such-study", "there is no such study");
    pub(super) const STUDY_OUTDATED: Self = row(
        410,
        "study-outdated",
        "the study cannot be compared any more",
    );
    pub(super) const NO_SUCH_RESULT: Self =
        row(404, "no-such-result", "the job has no such result");
    pub(super) const NO_SUCH_SYSTEM: Self = row(404, "no-such-system", "there is no such system");
    pub(super) const JOB_ACTIVE: Self = row(409, "job-active", "the job has not ended");
    pub(super) const SWEEP_ACTIVE: Self = row(
        409,
        "sweep-active",
        "the sweep has jobs that have not ended",
    );
    pub(super) const STUDY_ACTIVE: Self = row(
        409,
        "study-active",
        "the study has jobs that have not ended",
    );
    pub(super) const FOREIGN_HOST: Self =
        row(403, "foreign-host", "the request is for another host");
    pub(super) const TOKEN_REQUIRED: Self = row(
        401,
        "token-required",
        "the access token is missing or wrong",
    );
    pub(super) const REQUEST_TIMEOUT: Self =
        row(408, "request-timeout", "the request did not arrive in time");
    pub(super) const BUSY: Self = row(
        503,
        "busy",
        "the service cannot take the request at present",
    );
    pub(super) const INTERNAL: Self = row(500, "internal", "internal error");

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

impl From<StoreError> for ProblemResponse {
    fn from(error: StoreError) -> Self {
        let detail = match &error {
            error if error.is_disk_full() => "no space left on the data disk",
            error if error.is_transient() => "the database is busy; send the request again",
            error => return Self::internal(error),
        };
        tracing::warn!(%error, "a request was rejected for now");
        ProblemType::BUSY.with_detail(detail)
    }
}

impl From<Refused> for ProblemResponse {
    fn from(refused: Refused) -> Self {
        match refused {
            Refused::Parse(error) => {
                let detail = error.to_string();
                let fault = Fault::new(error.pointer, error.detail);
                ProblemType::UNREADABLE_BODY
                    .with_detail(detail)
                    .with_faults(vec![fault])
            }
            Refused::Faults(faults) => ProblemType::INVALID_SPECIFICATION
                .with_detail(format!("{} fault(s) in the specification", faults.len()))
                .with_faults(faults),
        }
    }
}

impl IntoResponse for ProblemResponse {
    fn into_response(self) -> Response {
        let ProblemType {
            status,
            name,
            title,
        } = self.problem_type;
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
        if self.problem_type == ProblemType::BUSY {
            headers.insert(header::RETRY_AFTER, HeaderValue::from_static(RETRY_AFTER_S));
        }
        response
    }
}

#[cfg(test)]
mod tests;
