//! The table of problem types. A name, once given, is never changed.

use api::problem::{Fault, Problem};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::store::StoreError;

/// Media type of a problem document.
const MEDIA_TYPE: &str = "application/problem+json";

/// When a request that was put off may be sent again, s.
const BUSY_PAUSE_S: &str = "5";

/// Kinds of problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// The body is not JSON, or has a wrong type somewhere.
    Unreadable,
    /// The specification has faults.
    InvalidSpecification,
    /// The key of the request was used with another body.
    KeyTaken,
    /// The key of the request cannot be taken.
    InvalidKey,
    /// A query parameter cannot be read.
    InvalidQuery,
    /// The range lies outside the file.
    Range,
    /// The body is too large.
    TooLarge,
    /// The body is not declared as JSON.
    MediaType,
    /// There is nothing at this path.
    NoRoute,
    /// The path does not take this method.
    WrongMethod,
    /// There is no such job.
    NoJob,
    /// There is no such sweep.
    NoSweep,
    /// There is no such study.
    NoStudy,
    /// The study was queued by another version of the service.
    OldStudy,
    /// The job has no such result (yet).
    NoResult,
    /// There is no such system.
    NoSystem,
    /// The job has not ended.
    Active,
    /// A job of the sweep has not ended.
    SweepActive,
    /// The request was made for another host or from another origin.
    Host,
    /// The access token is missing or wrong.
    Token,
    /// The request did not arrive in time.
    Slow,
    /// The service has too much to do.
    Busy,
    /// The service failed.
    Internal,
}

/// Kinds of what is not there.
fn missing(name: &'static str, title: &'static str) -> (&'static str, &'static str, StatusCode) {
    (name, title, StatusCode::NOT_FOUND)
}

impl Kind {
    /// Type, title and status.
    fn row(self) -> (&'static str, &'static str, StatusCode) {
        match self {
            Self::Unreadable => (
                "unreadable-body",
                "the body cannot be read",
                StatusCode::BAD_REQUEST,
            ),
            Self::InvalidSpecification => (
                "invalid-specification",
                "the specification has faults",
                StatusCode::UNPROCESSABLE_ENTITY,
            ),
            Self::KeyTaken => (
                "idempotency-key-reused",
                "the key was used with another body",
                StatusCode::UNPROCESSABLE_ENTITY,
            ),
            Self::InvalidKey => (
                "invalid-idempotency-key",
                "the key cannot be taken",
                StatusCode::BAD_REQUEST,
            ),
            Self::InvalidQuery => (
                "invalid-query",
                "a query parameter cannot be read",
                StatusCode::BAD_REQUEST,
            ),
            Self::Range => (
                "range",
                "the range lies outside the file",
                StatusCode::RANGE_NOT_SATISFIABLE,
            ),
            Self::TooLarge => (
                "body-too-large",
                "the body is too large",
                StatusCode::PAYLOAD_TOO_LARGE,
            ),
            Self::MediaType => (
                "media-type",
                "the body is not declared as JSON",
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
            ),
            Self::NoRoute => missing("no-such-path", "nothing is here"),
            Self::WrongMethod => (
                "wrong-method",
                "the path does not take this method",
                StatusCode::METHOD_NOT_ALLOWED,
            ),
            Self::NoJob => missing("no-such-job", "there is no such job"),
            Self::NoSweep => missing("no-such-sweep", "there is no such sweep"),
            Self::NoStudy => missing("no-such-study", "there is no such study"),
            Self::OldStudy => (
                "study-outdated",
                "the study cannot be compared any more",
                StatusCode::GONE,
            ),
            Self::NoResult => missing("no-such-result", "the job has no such result"),
            Self::NoSystem => missing("no-such-system", "there is no such system"),
            Self::Active => ("job-active", "the job has not ended", StatusCode::CONFLICT),
            Self::SweepActive => (
                "sweep-active",
                "the sweep has jobs that have not ended",
                StatusCode::CONFLICT,
            ),
            Self::Host => (
                "foreign-host",
                "the request was not made for this service",
                StatusCode::FORBIDDEN,
            ),
            Self::Token => (
                "token-required",
                "the access token is missing or wrong",
                StatusCode::UNAUTHORIZED,
            ),
            Self::Slow => (
                "request-timeout",
                "the request did not arrive in time",
                StatusCode::REQUEST_TIMEOUT,
            ),
            Self::Busy => (
                "busy",
                "the service has too much to do",
                StatusCode::SERVICE_UNAVAILABLE,
            ),
            Self::Internal => (
                "internal",
                "the service failed",
                StatusCode::INTERNAL_SERVER_ERROR,
            ),
        }
    }

    /// This kind with this occurrence in words.
    pub(super) fn because(self, detail: impl Into<String>) -> Refusal {
        Refusal {
            kind: self,
            detail: Some(detail.into()),
            faults: Vec::new(),
        }
    }
}

/// A client's text short enough for a message.
pub(super) fn shortened(text: &str) -> String {
    const KEPT: usize = 40;
    if text.chars().count() <= KEPT {
        return text.to_owned();
    }
    text.chars().take(KEPT).chain(['\u{2026}']).collect()
}

/// A problem on its way to the client.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Refusal {
    kind: Kind,
    detail: Option<String>,
    faults: Vec<Fault>,
}

impl Refusal {
    /// With faults of the submitted document.
    pub(super) fn with_faults(mut self, faults: Vec<Fault>) -> Self {
        self.faults = faults;
        self
    }

    /// A failure of the service: logged here, hidden from the client.
    pub(super) fn internal(cause: &dyn std::error::Error) -> Self {
        tracing::error!(%cause, "a request failed");
        Self {
            kind: Kind::Internal,
            detail: None,
            faults: Vec::new(),
        }
    }
}

impl From<&StoreError> for Refusal {
    fn from(error: &StoreError) -> Self {
        if error.is_transient() {
            tracing::warn!(%error, "a request was put off");
            return Kind::Busy.because("the database does not take this at present; send it again");
        }
        Self::internal(error)
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        let (name, title, status) = self.kind.row();
        let problem = Problem {
            kind: format!("/problems/{name}"),
            title: title.to_owned(),
            status: status.as_u16(),
            detail: self.detail,
            faults: self.faults,
        };
        let mut response = (status, axum::Json(problem)).into_response();
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE));
        if self.kind == Kind::Busy {
            headers.insert(header::RETRY_AFTER, HeaderValue::from_static(BUSY_PAUSE_S));
        }
        response
    }
}

#[cfg(test)]
mod tests;
