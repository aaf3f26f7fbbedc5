//! Extractors, with problem documents as rejections.

use std::fmt;
use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::extract::{FromRequest, FromRequestParts, Query, RawPathParams, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use futures_util::StreamExt;
use serde::de::DeserializeOwned;
use uuid::Uuid;

use crate::batch::Kind;
use crate::http::problem::{ProblemResponse, ProblemType};

/// Maximum size of a body, bytes.
pub(super) const MAX_BODY_BYTES: usize = 1 << 20;

/// Bytes of a body that are read at most, even if it is too large.
const MAX_DISCARDED_BYTES: usize = 64 << 20;
/// Timeout of a body.
const BODY_TIMEOUT: Duration = Duration::from_secs(30);

/// Id of a job, from the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct JobId(pub(super) Uuid);

impl<S: Send + Sync> FromRequestParts<S> for JobId {
    type Rejection = ProblemResponse;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ProblemResponse> {
        let id = path_id(parts, state, "job", ProblemType::NO_SUCH_JOB).await?;
        Ok(Self(id))
    }
}

/// Id of a token of workers, from the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct WorkerTokenId(pub(super) Uuid);

impl<S: Send + Sync> FromRequestParts<S> for WorkerTokenId {
    type Rejection = ProblemResponse;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ProblemResponse> {
        let id = path_id(parts, state, "token", ProblemType::NO_SUCH_TOKEN).await?;
        Ok(Self(id))
    }
}

/// Id of a remote worker, from the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct WorkerId(pub(super) Uuid);

impl<S: Send + Sync> FromRequestParts<S> for WorkerId {
    type Rejection = ProblemResponse;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ProblemResponse> {
        let id = path_id(parts, state, "worker", ProblemType::NO_SUCH_WORKER).await?;
        Ok(Self(id))
    }
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
        let body = receive_within(BODY_TIMEOUT, request.into_body()).await?;
        Ok(Self(body))
    }
}

/// Whether a body is declared as JSON. Forms and plain text are rejected: another site's page can make a browser send
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

async fn receive_within(timeout: Duration, body: Body) -> Result<Bytes, ProblemResponse> {
    tokio::time::timeout(timeout, receive(body))
        .await
        .unwrap_or_else(|_| {
            let limit_s = timeout.as_secs();
            let detail = format!("the body did not arrive within {limit_s} s");
            Err(ProblemType::REQUEST_TIMEOUT.with_detail(detail))
        })
}

/// Reads a body up to the limit. The rest of a larger one is read and discarded, up to a second limit: a client whose
/// connection closes while it sends does not read the response.
async fn receive(body: Body) -> Result<Bytes, ProblemResponse> {
    let mut chunks = body.into_data_stream();
    let (mut bytes, mut length) = (Vec::new(), 0_usize);
    while let Some(chunk) = chunks.next().await {
        let failed = |_| ProblemType::UNREADABLE_BODY.with_detail("the body could not be received");
        let chunk = chunk.map_err(failed)?;
        length = length.saturating_add(chunk.len());
        if length <= MAX_BODY_BYTES {
            bytes.extend_from_slice(&chunk);
        } else {
            bytes = Vec::new();
        }
        if length > MAX_DISCARDED_BYTES {
            break;
        }
    }
    if length > MAX_BODY_BYTES {
        let detail = format!("the body has more than {MAX_BODY_BYTES} bytes");
        return Err(ProblemType::BODY_TOO_LARGE.with_detail(detail));
    }
    Ok(bytes.into())
}

#[cfg(test)]
mod tests {
    use axum::response::IntoResponse;

    use super::*;

    #[tokio::test]
    async fn a_body_that_does_not_arrive_times_out() {
        let body = Body::from_stream(futures_util::stream::pending::<
            Result<Vec<u8>, std::io::Error>,
        >());
        let received = receive_within(Duration::from_millis(20), body).await;
        let response = received.expect_err("it never arrives").into_response();
        assert_eq!(response.status(), 408);
    }
}
