//! `Idempotency-Key`: requests with the same key and body create one job, however often they are sent.

use axum::http::HeaderMap;
use sha2::{Digest, Sha256};

use crate::http::problem::{ProblemType, RouteError};
use crate::store::RequestKey;

/// Name of the header.
const HEADER: &str = "idempotency-key";
/// Maximum length of a key, characters.
const MAX_LENGTH: usize = 255;

/// Error of an `Idempotency-Key`.
#[derive(Debug, thiserror::Error)]
pub(super) enum KeyError {
    /// Empty, or too long.
    #[error("the Idempotency-Key has {0} characters; it must have 1 to {MAX_LENGTH}")]
    Length(usize),
    /// Not printable ASCII.
    #[error("the Idempotency-Key must be printable ASCII characters")]
    Text,
    /// Used with another body.
    #[error("the Idempotency-Key was used with another body; use a new key for another body")]
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

/// Returns the key of a request, if it has one.
pub(super) fn idempotency_key(
    headers: &HeaderMap,
    body: &[u8],
) -> Result<Option<RequestKey>, KeyError> {
    let Some(value) = headers.get(HEADER) else {
        return Ok(None);
    };
    let key = value.to_str().map_err(|_| KeyError::Text)?.trim();
    if key.is_empty() || key.len() > MAX_LENGTH {
        return Err(KeyError::Length(key.len()));
    }
    Ok(Some(RequestKey {
        key: key.to_owned(),
        body_sha256: Sha256::digest(body).into(),
    }))
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
        assert_eq!(problem["title"], "the key was used with another body");
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
        let empty = [json, ("idempotency-key", " ")];
        assert_eq!(service.send("POST", "/v1/jobs", &empty, body).await.0, 400);
        let (_, _, page) = service.get("/v1/jobs").await;
        assert_eq!(page["jobs"].as_array().map_or(0, Vec::len), 1, "{page}");
    }
}
