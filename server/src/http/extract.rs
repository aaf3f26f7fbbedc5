//! What routes take out of requests, with problem documents for what cannot be taken.

use axum::extract::rejection::BytesRejection;
use axum::extract::{FromRequest, FromRequestParts, Query, RawPathParams, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, header};
use serde::de::DeserializeOwned;
use uuid::Uuid;

use super::BODY_LIMIT;
use super::problem::{Kind, Refusal};

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

/// The name of a file, out of the path. It is compared with names in the database and never becomes a path.
#[derive(Debug, Clone)]
pub(super) struct FileName(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for FileName {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        Ok(Self(path_parameter(parts, state, "name").await))
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
            .map_err(|rejection| Kind::InvalidQuery.because(rejection.body_text()))
    }
}

/// A body declared as JSON, not yet read.
#[derive(Debug, Clone)]
pub(super) struct JsonBody(pub(super) axum::body::Bytes);

impl<S: Send + Sync> FromRequest<S> for JsonBody {
    type Rejection = Refusal;

    async fn from_request(request: Request, state: &S) -> Result<Self, Refusal> {
        if !declared_as_json(request.headers()) {
            return Err(Kind::MediaType
                .because("send the specification with `content-type: application/json`"));
        }
        axum::body::Bytes::from_request(request, state)
            .await
            .map(Self)
            .map_err(|rejection| refused(&rejection))
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

fn refused(rejection: &BytesRejection) -> Refusal {
    if rejection.status() == StatusCode::PAYLOAD_TOO_LARGE {
        Kind::TooLarge.because(format!("a body may have {BODY_LIMIT} bytes"))
    } else {
        Kind::Unreadable.because("the body could not be received")
    }
}
