//! Bodies of remote workers: JSON as others, but of any length that a solving process can write.

use std::time::Duration;

use axum::body::to_bytes;
use axum::extract::{FromRequest, Request};
use serde::de::DeserializeOwned;

use crate::http::problem::{ProblemResponse, ProblemType};

/// Largest body, bytes: an update is sent once it has 16 MiB, its last line may have 256.
const MAX_BYTES: usize = 512 << 20;
/// Timeout of a body.
const TIMEOUT: Duration = Duration::from_mins(5);

/// A body of a worker.
#[derive(Debug)]
pub(super) struct WorkerBody<T>(pub(super) T);

impl<S: Send + Sync, T: DeserializeOwned> FromRequest<S> for WorkerBody<T> {
    type Rejection = ProblemResponse;

    async fn from_request(request: Request, _state: &S) -> Result<Self, ProblemResponse> {
        let read = tokio::time::timeout(TIMEOUT, to_bytes(request.into_body(), MAX_BYTES));
        let Ok(read) = read.await else {
            let detail = format!("the body did not arrive within {} s", TIMEOUT.as_secs());
            return Err(ProblemType::REQUEST_TIMEOUT.with_detail(detail));
        };
        let unreadable = |cause: String| ProblemType::UNREADABLE_BODY.with_detail(cause);
        let bytes = read.map_err(|cause| {
            unreadable(format!(
                "it did not arrive, or has more than {MAX_BYTES} bytes: {cause}"
            ))
        })?;
        let body = serde_json::from_slice(&bytes);
        Ok(Self(body.map_err(|cause| unreadable(cause.to_string()))?))
    }
}
