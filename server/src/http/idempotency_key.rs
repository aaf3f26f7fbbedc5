//! `Idempotency-Key`: requests with the same key and meaning create one job, however often they are sent.
//!
//! The meaning is the JSON value of the body, whatever its spaces, the order of its fields and the form of its numbers, and
//! the options of the query.

use std::fmt::Display;

use axum::http::HeaderMap;
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::http::problem::{ProblemType, RouteError};
use crate::store::RequestKey;

/// Name of the header.
const HEADER: &str = "idempotency-key";
/// Maximum length of a key, characters.
const MAX_LENGTH: usize = 255;

/// Error of an `Idempotency-Key`.
#[derive(Debug, thiserror::Error)]
pub(crate) enum KeyError {
    /// Empty, or too long.
    #[error("the Idempotency-Key has {0} characters; it must have 1 to {MAX_LENGTH}")]
    Length(usize),
    /// Not printable ASCII.
    #[error("the Idempotency-Key must be printable ASCII characters")]
    Text,
    /// Used for another request.
    #[error(
        "the Idempotency-Key was used with another body or query; use a new key for another request"
    )]
    Reused,
}

impl RouteError for KeyError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Length(_) | Self::Text => ProblemType::INVALID_KEY,
            Self::Reused => ProblemType::KEY_REUSED,
        }
    }
}

/// Returns the key of a request with these options besides its body, if it has one.
pub(super) fn idempotency_key(
    headers: &HeaderMap,
    options: impl Display,
    body: &[u8],
) -> Result<Option<RequestKey>, KeyError> {
    let Some(value) = headers.get(HEADER) else {
        return Ok(None);
    };
    let key = value.to_str().map_err(|_| KeyError::Text)?;
    Ok(Some(RequestKey {
        key: checked(key)?,
        meaning_sha256: meaning(&options.to_string(), body),
        body_sha256: Sha256::digest(body).into(),
    }))
}

/// Returns a key without spaces around it if it can be used.
pub(crate) fn checked(key: &str) -> Result<String, KeyError> {
    let key = key.trim();
    if !key.chars().all(|character| matches!(character, ' '..='~')) {
        return Err(KeyError::Text);
    }
    if key.is_empty() || key.len() > MAX_LENGTH {
        return Err(KeyError::Length(key.len()));
    }
    Ok(key.to_owned())
}

/// Digest of the meaning of a request.
fn meaning(options: &str, body: &[u8]) -> [u8; 32] {
    let value = serde_json::from_slice(body).map(canonical);
    let canonical = value.and_then(|value| serde_json::to_vec(&value));
    // A body that is no JSON means nothing but itself.
    let body = canonical.unwrap_or_else(|_| body.to_vec());
    let digest = Sha256::new_with_prefix("meaning\0").chain_update(options);
    digest
        .chain_update("\0")
        .chain_update(body)
        .finalize()
        .into()
}

/// A value with each number in one form; objects are sorted by their keys anyway.
fn canonical(value: Value) -> Value {
    match value {
        Value::Number(number) => number
            .as_f64()
            .filter(|_| number.as_i64().is_none() && number.as_u64().is_none())
            .and_then(integer)
            .map_or(Value::Number(number), Value::from),
        Value::Array(values) => values.into_iter().map(canonical).collect(),
        Value::Object(fields) => fields
            .into_iter()
            .map(|(key, value)| (key, canonical(value)))
            .collect(),
        other => other,
    }
}

/// A number without a fraction as an integer, where every integer is exact.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the number is checked to be an integer in the range"
)]
fn integer(number: f64) -> Option<i64> {
    const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;
    (number.abs() <= LARGEST_EXACT && number.fract() == 0.0).then_some(number as i64)
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn the_same_key_and_body_create_one_job_and_another_body_is_rejected() {
        let service = Service::new().await;
        let body = r#"{"system":{"kind":"sd_card"}}"#;
        let json = ("content-type", "application/json");
        let keyed = [json, ("idempotency-key", "study-7")];
        let (status, _, first) = service.send("POST", "/v1/jobs", &keyed, body).await;
        assert_eq!(status, 202);
        let (status, _, second) = service.send("POST", "/v1/jobs", &keyed, body).await;
        assert_eq!((status.as_u16(), &second["id"]), (202, &first["id"]));
        let other = r#"{"system":{"kind":"zif"}}"#;
        let (status, _, problem) = service.send("POST", "/v1/jobs", &keyed, other).await;
        assert_eq!(status, 422);
        assert_eq!(problem["title"], "the key was used for another request");
        let urgent = "/v1/jobs?priority=7";
        let (status, _, problem) = service.send("POST", urgent, &keyed, body).await;
        assert_eq!(status, 422, "{problem}");
        let long = "k".repeat(256);
        let (status, _, problem) = service
            .send(
                "POST",
                "/v1/jobs",
                &[json, ("idempotency-key", &long)],
                body,
            )
            .await;
        assert_eq!(status, 400);
        assert_eq!(
            problem["detail"],
            "the Idempotency-Key has 256 characters; it must have 1 to 255"
        );
        for key in [" ", "a\tb"] {
            let headers = [json, ("idempotency-key", key)];
            let (status, ..) = service.send("POST", "/v1/jobs", &headers, body).await;
            assert_eq!(status, 400, "{key}");
        }
        let (_, _, page) = service.get("/v1/jobs").await;
        assert_eq!(page["jobs"].as_array().map_or(0, Vec::len), 1, "{page}");
    }

    #[test]
    fn the_meaning_of_a_body_does_not_depend_on_how_it_is_written() {
        let written = |text: &str| super::meaning("", text.as_bytes());
        let one = written(r#"{"cycles":1000,"system":{"kind":"dimm"}}"#);
        for same in [
            r#"{ "system" : {"kind": "dimm"}, "cycles": 1e3 }"#,
            r#"{"cycles":1000.0,"system":{"kind":"d\u0069mm"}}"#,
        ] {
            assert_eq!(written(same), one, "{same}");
        }
        for other in [
            r#"{"cycles":1000.5,"system":{"kind":"dimm"}}"#,
            "[]",
            "",
            "{",
        ] {
            assert_ne!(written(other), one, "{other}");
        }
        assert_ne!(super::meaning("5", b"{}"), super::meaning("", b"{}"));
    }
}
