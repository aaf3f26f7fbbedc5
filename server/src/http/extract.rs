//! What routes take out of requests, with problem documents for what cannot be taken.

use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::extract::{FromRequest, FromRequestParts, Query, RawPathParams, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use futures_util::StreamExt;
use serde::de::DeserializeOwned;
use uuid::Uuid;

use crate::http::BODY_LIMIT;
use crate::http::problem::{Kind, Refusal};

/// Bytes of a body that is too large which are still read.
const THROWN_AWAY_LIMIT: usize = 64 << 20;
/// How long a body may take to arrive.
const BODY_TIME: Duration = Duration::from_secs(30);

/// The id of a job, out of the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct JobId(pub(super) Uuid);

impl<S: Send + Sync> FromRequestParts<S> for JobId {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        let text = path_parameter(parts, state, "id").await;
        Uuid::parse_str(&text)
            .map(Self)
            .map_err(|_| Kind::NoJob.because("the id in the path is not the id of a job"))
    }
}

/// The id of a sweep, out of the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct SweepId(pub(super) Uuid);

impl<S: Send + Sync> FromRequestParts<S> for SweepId {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        let text = path_parameter(parts, state, "id").await;
        Uuid::parse_str(&text)
            .map(Self)
            .map_err(|_| Kind::NoSweep.because("the id in the path is not the id of a sweep"))
    }
}

/// The id of a study, out of the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct StudyId(pub(super) Uuid);

impl<S: Send + Sync> FromRequestParts<S> for StudyId {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        let text = path_parameter(parts, state, "id").await;
        Uuid::parse_str(&text)
            .map(Self)
            .map_err(|_| Kind::NoStudy.because("the id in the path is not the id of a study"))
    }
}

/// The name of a file, out of the path. It is compared with names in the database and never becomes a path.
#[derive(Debug, Clone)]
pub(super) struct FileName(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for FileName {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        Ok(Self(path_parameter(parts, state, "name").await))
    }
}

/// The name of a kind of system, out of the path.
#[derive(Debug, Clone)]
pub(super) struct SystemName(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for SystemName {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        Ok(Self(path_parameter(parts, state, "kind").await))
    }
}

/// A parameter of the path; empty, which names nothing, if it is no text.
async fn path_parameter<S: Send + Sync>(parts: &mut Parts, state: &S, name: &str) -> String {
    let Ok(parameters) = RawPathParams::from_request_parts(parts, state).await else {
        return String::new();
    };
    parameters
        .iter()
        .find(|(found, _)| *found == name)
        .map(|(_, value)| value.to_owned())
        .unwrap_or_default()
}

/// Query parameters.
#[derive(Debug, Clone)]
pub(super) struct Params<T>(pub(super) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Params<T> {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        Query::<T>::from_request_parts(parts, state)
            .await
            .map(|query| Self(query.0))
            .map_err(|rejection| {
                let text = rejection.body_text();
                let detail = text.strip_prefix("Failed to deserialize query string: ");
                Kind::InvalidQuery.because(detail.unwrap_or(&text))
            })
    }
}

/// A body declared as JSON, not yet read.
#[derive(Debug, Clone)]
pub(super) struct JsonBody(pub(super) Bytes);

impl<S: Send + Sync> FromRequest<S> for JsonBody {
    type Rejection = Refusal;

    async fn from_request(request: Request, _: &S) -> Result<Self, Refusal> {
        if !declared_as_json(request.headers()) {
            return Err(Kind::MediaType
                .because("send the specification with `content-type: application/json`"));
        }
        received_within(BODY_TIME, request.into_body())
            .await
            .map(Self)
    }
}

/// A form or plain text is what a foreign page can make a browser send; it is refused.
fn declared_as_json(headers: &HeaderMap) -> bool {
    let Some(value) = headers.get(header::CONTENT_TYPE) else {
        return true;
    };
    let essence = value
        .to_str()
        .unwrap_or_default()
        .split(';')
        .next()
        .unwrap_or_default()
        .trim()
        .to_ascii_lowercase();
    essence == "application/json"
        || (essence.starts_with("application/") && essence.ends_with("+json"))
}

async fn received_within(time: Duration, body: Body) -> Result<Bytes, Refusal> {
    let received = tokio::time::timeout(time, received(body)).await;
    received.unwrap_or_else(|_| {
        Err(Kind::Slow.because(format!("a body may take {} s", time.as_secs())))
    })
}

/// The bytes of a body up to the limit. The rest of a larger one is read and thrown away, within reason, because a client
/// that is hung up on while it sends does not learn why.
async fn received(body: Body) -> Result<Bytes, Refusal> {
    let mut pieces = body.into_data_stream();
    let (mut kept, mut length) = (Vec::new(), 0_usize);
    while let Some(piece) = pieces.next().await {
        let piece =
            piece.map_err(|_| Kind::Unreadable.because("the body could not be received"))?;
        length = length.saturating_add(piece.len());
        if length <= BODY_LIMIT {
            kept.extend_from_slice(&piece);
        } else {
            kept = Vec::new();
        }
        if length > THROWN_AWAY_LIMIT {
            break;
        }
    }
    if length > BODY_LIMIT {
        return Err(Kind::TooLarge.because(format!("a body may have {BODY_LIMIT} bytes")));
    }
    Ok(kept.into())
}

#[cfg(test)]
mod tests {
    use axum::response::IntoResponse;

    use super::*;

    #[tokio::test]
    async fn a_body_that_does_not_arrive_is_given_up() {
        let body = Body::from_stream(futures_util::stream::pending::<
            Result<Vec<u8>, std::io::Error>,
        >());
        let refusal = received_within(Duration::from_millis(20), body).await;
        let answer = refusal.expect_err("it never arrives").into_response();
        assert_eq!(answer.status(), 408);
    }
}
