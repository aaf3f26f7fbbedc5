//! Extractors, with problem documents as rejections.

use std::fmt;

use axum::body::{Bytes, to_bytes};
use axum::extract::{FromRequest, FromRequestParts, Query, RawPathParams, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use serde::de::DeserializeOwned;
use uuid::Uuid;

use crate::batch::Kind;
use crate::http::problem::{ProblemResponse, ProblemType};

/// Defines an id from the path: of what, and the problem of an unknown one.
macro_rules! path_ids {
    ($($(#[$doc:meta])* $name:ident, $noun:literal, $missing:ident;)+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        pub(super) struct $name(pub(super) Uuid);

        impl<S: Send + Sync> FromRequestParts<S> for $name {
            type Rejection = ProblemResponse;

            async fn from_request_parts(
                parts: &mut Parts,
                state: &S,
            ) -> Result<Self, ProblemResponse> {
                Ok(Self(path_id(parts, state, $noun, ProblemType::$missing).await?))
            }
        }
    )+};
}

path_ids! {
    /// Id of a job, from the path.
    JobId, "job", NO_SUCH_JOB;
    /// Id of a token of workers, from the path.
    WorkerTokenId, "token", NO_SUCH_TOKEN;
    /// Id of a remote worker, from the path.
    WorkerId, "worker", NO_SUCH_WORKER;
}

/// A batch, from the path: its kind is that of the collection.
#[derive(Debug, Clone, Copy)]
pub(super) struct BatchId {
    pub(super) kind: Kind,
    pub(super) id: Uuid,
}

impl fmt::Display for BatchId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.kind, self.id)
    }
}

impl<S: Send + Sync> FromRequestParts<S> for BatchId {
    type Rejection = ProblemResponse;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ProblemResponse> {
        let (kind, missing) = if parts.uri.path().starts_with("/v1/studies/") {
            (Kind::AccuracyStudy, ProblemType::NO_SUCH_STUDY)
        } else {
            (Kind::Sweep, ProblemType::NO_SUCH_SWEEP)
        };
        let id = path_id(parts, state, &kind.to_string(), missing).await?;
        Ok(Self { kind, id })
    }
}

/// Name of a file or of a kind, from the path. It is compared with known names and never used as a path.
#[derive(Debug, Clone)]
pub(super) struct Name(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for Name {
    type Rejection = ProblemResponse;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ProblemResponse> {
        let name = path_parameter(parts, state, &["name", "kind"]).await;
        Ok(Self(name))
    }
}

/// Parses the id in the path; the problem is that of an unknown id.
async fn path_id<S: Send + Sync>(
    parts: &mut Parts,
    state: &S,
    noun: &str,
    missing: ProblemType,
) -> Result<Uuid, ProblemResponse> {
    let text = path_parameter(parts, state, &["id"]).await;
    Uuid::parse_str(&text)
        .map_err(|_| missing.with_detail(format!("the id in the path is not the id of a {noun}")))
}

/// A parameter of the path by any of these names; empty, which matches no name, if it is not valid UTF-8.
async fn path_parameter<S: Send + Sync>(parts: &mut Parts, state: &S, names: &[&str]) -> String {
    let Ok(parameters) = RawPathParams::from_request_parts(parts, state).await else {
        return String::new();
    };
    let mut named = parameters.iter().filter(|(name, _)| names.contains(name));
    named
        .next()
        .map_or_else(String::new, |(_, value)| value.to_owned())
}

/// Query parameters.
#[derive(Debug, Clone)]
pub(super) struct Params<T>(pub(super) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Params<T> {
    type Rejection = ProblemResponse;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ProblemResponse> {
        Query::<T>::from_request_parts(parts, state)
            .await
            .map(|query| Self(query.0))
            .map_err(|rejection| {
                let text = rejection.body_text();
                let detail = text.strip_prefix("Failed to deserialize query string: ");
                ProblemType::INVALID_QUERY.with_detail(detail.unwrap_or(&text))
            })
    }
}

/// A body declared as JSON, not yet parsed.
#[derive(Debug, Clone)]
pub(super) struct JsonBody(pub(super) Bytes);

impl<S: Send + Sync> FromRequest<S> for JsonBody {
    type Rejection = ProblemResponse;

    async fn from_request(request: Request, _: &S) -> Result<Self, ProblemResponse> {
        if !declared_as_json(request.headers()) {
            return Err(ProblemType::MEDIA_TYPE
                .with_detail("send the specification with `content-type: application/json`"));
        }
        Ok(Self(received(request).await?))
    }
}

/// Returns `true` if a body is declared as JSON. Forms and plain text are rejected: another site's page can make a browser send
/// them.
fn declared_as_json(headers: &HeaderMap) -> bool {
    let Some(value) = headers.get(header::CONTENT_TYPE) else {
        return true;
    };
    let text = value.to_str().unwrap_or_default();
    let (essence, _) = text.split_once(';').unwrap_or((text, ""));
    let essence = essence.trim().to_ascii_lowercase();
    essence == "application/json"
        || (essence.starts_with("application/") && essence.ends_with("+json"))
}

/// The body of a request, which [`crate::http::bodies`] has received.
pub(super) async fn received(request: Request) -> Result<Bytes, ProblemResponse> {
    let bytes = to_bytes(request.into_body(), usize::MAX).await;
    bytes.map_err(|cause| ProblemType::UNREADABLE_BODY.with_detail(cause.to_string()))
}
