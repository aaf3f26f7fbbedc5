//! Bodies of remote workers: JSON without a schema for users.

use axum::extract::{FromRequest, Request};
use serde::de::DeserializeOwned;

use crate::http::extract::received;
use crate::http::problem::{ProblemResponse, ProblemType};

/// A body of a worker.
#[derive(Debug)]
pub(super) struct WorkerBody<T>(pub(super) T);

impl<S: Send + Sync, T: DeserializeOwned> FromRequest<S> for WorkerBody<T> {
    type Rejection = ProblemResponse;

    async fn from_request(request: Request, _state: &S) -> Result<Self, ProblemResponse> {
        let body = serde_json::from_slice(&received(request).await?);
        let unreadable =
            |cause: serde_json::Error| ProblemType::UNREADABLE_BODY.with_detail(cause.to_string());
        Ok(Self(body.map_err(unreadable)?))
    }
}
