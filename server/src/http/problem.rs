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

/// Marks a response with the problem of a full disk; [`crate::http::disk_space`] adds the free space to it.
#[derive(Debug, Clone, Copy)]
pub(super) struct DiskFull;

/// Type of a problem: a row of the table below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ProblemType {
    status: u16,
    name: &'static str,
    /// Title, the same for every problem of the type.
    title: &'static str,
}

/// Declares the types: constant, status, name, title.
macro_rules! problem_types {
    ($($constant:ident, $status:literal, $name:literal, $title:literal;)+) => {
        impl ProblemType {
            $(
                #[doc = concat!("Problem: ", $title, ".")]
                pub(super) const $constant: Self = Self {
                    status: $status,
                    name: $name,
                    title: $title,
                };
            )+
        }
    };
}

problem_types! {
    UNREADABLE_BODY, 400, "unreadable-body", "the body cannot be read";
    INVALID_SPECIFICATION, 422, "invalid-specification", "the specification has faults";
    KEY_REUSED, 422, "idempotency-key-reused", "the key was used for another request";
    INVALID_KEY, 400, "invalid-idempotency-key", "the key is not valid";
    INVALID_QUERY, 400, "invalid-query", "a query parameter is not valid";
    RANGE, 416, "range", "the range lies outside the file";
    BODY_TOO_LARGE, 413, "body-too-large", "the body is too large";
    MEDIA_TYPE, 415, "media-type", "the body is not declared as JSON";
    NO_SUCH_PATH, 404, "no-such-path", "there is no such path";
    WRONG_METHOD, 405, "wrong-method", "the path does not support this method";
    NO_SUCH_JOB, 404, "no-such-job", "there is no such job";
    NO_SUCH_SWEEP, 404, "no-such-sweep", "there is no such sweep";
    NO_SUCH_STUDY, 404, "no-such-study", "there is no such study";
    STUDY_OUTDATED, 410, "study-outdated", "the study cannot be compared any more";
    NO_SUCH_RESULT, 404, "no-such-result", "the job has no such result";
    NO_SUCH_SYSTEM, 404, "no-such-system", "there is no such system";
    JOB_ACTIVE, 409, "job-active", "the job has not ended";
    JOB_SUCCEEDED, 409, "job-succeeded", "the job has succeeded";
    SWEEP_ACTIVE, 409, "sweep-active", "the sweep has jobs that have not ended";
    STUDY_ACTIVE, 409, "study-active", "the study has jobs that have not ended";
    INVALID_HOST, 400, "invalid-host", "the Host header is missing or repeated";
    FOREIGN_HOST, 403, "foreign-host", "the request is for another host";
    TOKEN_REQUIRED, 401, "token-required", "the access token is missing or wrong";
    REQUEST_TIMEOUT, 408, "request-timeout", "the request did not arrive in time";
    BUSY, 503, "busy", "the service cannot take the request at present";
    DISK_FULL, 503, "disk-full", "the data disk is full";
    RESULT_DAMAGED, 500, "result-damaged", "a stored result is damaged";
    TASK_FAILING, 503, "task-failing", "a task of the service fails repeatedly";
    INTERNAL, 500, "internal", "internal error";
}

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
        let problem = match &error {
            error if error.is_disk_full() => {
                ProblemType::DISK_FULL.with_detail(StoreError::DiskFull.to_string())
            }
            error if error.is_transient() => {
                ProblemType::BUSY.with_detail("the database is busy; send the request again")
            }
            error => return Self::internal(error),
        };
        tracing::warn!(%error, "a request was rejected for now");
        problem
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
        let ProblemType {
            status,
            name,
            title,
        } = self.problem_type;
        let is_full = self.detail == Some(StoreError::DiskFull.to_string());
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
        if [ProblemType::BUSY, ProblemType::DISK_FULL].contains(&self.problem_type) {
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
