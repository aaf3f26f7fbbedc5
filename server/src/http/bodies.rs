//! Receives the bodies of requests, then admits a limited number of requests at once: one whose body arrives slowly keeps no
//! other one waiting.

use std::convert::Infallible;

use axum::body::{Body, BodyDataStream, Bytes, HttpBody};
use axum::extract::{FromRequest, Request, State};
use axum::http::request::Parts;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use tokio::time::sleep_until;

use crate::http::app::App;
use crate::http::arrival::{RATE, TIMEOUT};
use crate::http::body_limits::BodyKind;
use crate::http::connections::Connections;
use crate::http::connections::arriving::{Arriving, GaveWay};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};

/// Bytes of a body that are read at most, even if it is too large.
const MAX_DISCARDED_BYTES: u64 = 64 << 20;
/// Largest buffer that is reserved for a body before any of it has arrived, bytes.
const MAX_RESERVED_BYTES: usize = 1 << 20;
/// Paths whose requests do not wait for others: those for the health, and claims of workers, which wait for jobs.
const UNLIMITED: [&str; 3] = ["/healthz", "/readyz", "/v1/worker/claims"];

/// Why a body is not received.
#[derive(Debug, thiserror::Error)]
pub(super) enum BodyError {
    /// The connection broke off.
    #[error("the body could not be received: {0}")]
    Broken(axum::Error),
    /// The body has not arrived in time.
    #[error(
        "the body did not arrive in time: it was {} s behind a rate of {} KiB a second",
        TIMEOUT.as_secs(),
        RATE >> 10
    )]
    Slow,
    /// Other requests need the memory of the body.
    #[error(
        "the body was given up after {0} bytes: those of other requests need its place; send the request again"
    )]
    GaveWay(u64),
    /// The body is too large.
    #[error("the body has more than {0} bytes")]
    TooLarge(u64),
}

impl RouteError for BodyError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Broken(_) => ProblemType::UNREADABLE_BODY,
            Self::Slow => ProblemType::REQUEST_TIMEOUT,
            Self::GaveWay(_) => ProblemType::BUSY,
            Self::TooLarge(_) => ProblemType::BODY_TOO_LARGE,
        }
    }
}

/// A body that arrives.
#[derive(Debug)]
pub(super) struct ArrivingBody {
    chunks: BodyDataStream,
    arriving: Arriving,
    kind: BodyKind,
    bytes: u64,
}

impl ArrivingBody {
    /// Splits a request into its head and its body.
    fn split(request: Request, kind: BodyKind) -> (Parts, Self) {
        let connection = request.extensions().get().cloned();
        // Requests of tests come through no listener.
        let connection = connection.unwrap_or_else(Connections::of_one);
        let (parts, body) = request.into_parts();
        let body = Self {
            chunks: body.into_data_stream(),
            arriving: connection.body(kind),
            kind,
            bytes: 0,
        };
        (parts, body)
    }

    /// Number of bytes that have arrived.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Returns the next chunk, or none after the last one.
    ///
    /// # Errors
    /// [`BodyError`], also for a body that is too large.
    pub(super) async fn chunk(&mut self) -> Result<Option<Bytes>, BodyError> {
        let most = self.kind.limits().body;
        let Some(chunk) = self.next().await? else {
            self.arriving.complete();
            return Ok(None);
        };
        let is_held = self.kind != BodyKind::File && self.bytes <= most;
        let held = if is_held { self.bytes } else { 0 };
        self.count(&chunk, held)?;
        if self.bytes > most {
            return Err(BodyError::TooLarge(most));
        }
        Ok(Some(chunk))
    }

    /// Waits for a chunk; gives up if it takes too long, or if others need the place.
    async fn next(&mut self) -> Result<Option<Bytes>, BodyError> {
        let until = self.arriving.waits_until().into();
        let next = tokio::select! {
            // After a pause of the service itself, a chunk may be there although the time has passed.
            biased;
            next = self.chunks.next() => next,
            () = self.arriving.gives_way() => return Err(BodyError::GaveWay(self.bytes)),
            () = sleep_until(until) => return Err(BodyError::Slow),
        };
        let chunk = next.transpose().map_err(BodyError::Broken)?;
        let length = chunk.as_ref().map_or(0, Bytes::len);
        self.bytes = self.bytes.saturating_add(length as u64);
        Ok(chunk)
    }

    fn count(&self, chunk: &Bytes, held: u64) -> Result<(), BodyError> {
        let held = usize::try_from(held).unwrap_or(usize::MAX);
        let counted = self.arriving.arrived(chunk.len(), held);
        counted.map_err(|GaveWay| BodyError::GaveWay(self.bytes))
    }

    /// Receives all of it into memory.
    async fn into_memory(mut self) -> Result<(Bytes, Arriving), BodyError> {
        let declared =
            usize::try_from(HttpBody::size_hint(&self.chunks).lower()).unwrap_or(usize::MAX);
        let mut bytes = Vec::with_capacity(declared.min(MAX_RESERVED_BYTES));
        loop {
            match self.chunk().await {
                Ok(Some(chunk)) => bytes.extend_from_slice(&chunk),
                Ok(None) => return Ok((bytes.into(), self.arriving)),
                Err(error) => {
                    drop(bytes);
                    if matches!(error, BodyError::TooLarge(_)) {
                        self.discard().await?;
                    }
                    return Err(error);
                }
            }
        }
    }

    /// Reads and discards the rest of a body that is too large, up to a limit: a client whose connection closes while it sends does
    /// not read the response.
    async fn discard(&mut self) -> Result<(), BodyError> {
        while self.bytes <= MAX_DISCARDED_BYTES {
            let Some(chunk) = self.next().await? else {
                break;
            };
            self.count(&chunk, 0)?;
        }
        Ok(())
    }
}

impl<S: Send + Sync> FromRequest<S> for ArrivingBody {
    type Rejection = Infallible;

    async fn from_request(request: Request, _state: &S) -> Result<Self, Infallible> {
        // Routes receive files alone, and know their path without the prefix of their router.
        Ok(Self::split(request, BodyKind::File).1)
    }
}

/// Middleware that receives the body of a request and then waits until it is one of a limited number of concurrent requests. A file is
/// received by its route.
pub(super) async fn admit(State(app): State<App>, request: Request, next: Next) -> Response {
    if BodyKind::of(request.uri().path()) == BodyKind::File {
        return next.run(request).await;
    }
    // The memory of the body counts until the response.
    let (request, _body) = match received(request).await {
        Ok(received) => received,
        Err(error) => return ProblemResponse::from(error).into_response(),
    };
    // The semaphore is never closed.
    let _permit = if UNLIMITED.contains(&request.uri().path()) {
        None
    } else {
        app.request_permits.acquire().await.ok()
    };
    next.run(request).await
}

/// Receives the body of a request, if it has one.
async fn received(request: Request) -> Result<(Request, Option<Arriving>), BodyError> {
    if request.body().is_end_stream() {
        return Ok((request, None));
    }
    let kind = BodyKind::of(request.uri().path());
    let (parts, body) = ArrivingBody::split(request, kind);
    let (bytes, arriving) = body.into_memory().await?;
    Ok((
        Request::from_parts(parts, Body::from(bytes)),
        Some(arriving),
    ))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use futures_util::stream::pending;

    use super::*;
    use crate::http::connections::Connection;

    fn arriving(body: Body, kind: BodyKind, behind: Duration) -> ArrivingBody {
        let connection: std::sync::Arc<Connection> = Connections::of_one();
        ArrivingBody {
            chunks: body.into_data_stream(),
            arriving: connection.body_behind(behind, kind),
            kind,
            bytes: 0,
        }
    }

    fn endless() -> Body {
        Body::from_stream(pending::<Result<Vec<u8>, std::io::Error>>())
    }

    #[tokio::test]
    async fn a_body_that_does_not_arrive_times_out() {
        let mut body = arriving(endless(), BodyKind::File, TIMEOUT);
        assert!(matches!(body.chunk().await, Err(BodyError::Slow)));
        let body = arriving(endless(), BodyKind::Document, TIMEOUT);
        let received = body.into_memory().await;
        let error = received.expect_err("it never arrives");
        let response = ProblemResponse::from(error).into_response();
        assert_eq!(response.status(), 408);
    }

    #[tokio::test]
    async fn what_has_arrived_is_received_however_late_it_is() {
        let body = arriving(Body::from("{}"), BodyKind::Document, 2 * TIMEOUT);
        let (bytes, _) = body.into_memory().await.expect("it is there");
        assert_eq!(bytes, "{}");
    }

    #[tokio::test]
    async fn files_end_at_their_largest_size() {
        let mut body = arriving(Body::from("12"), BodyKind::File, Duration::ZERO);
        body.bytes = BodyKind::File.limits().body - 1;
        let error = body.chunk().await.expect_err("it is too large");
        assert!(
            matches!(error, BodyError::TooLarge(8_000_000_000)),
            "{error}"
        );
        assert_eq!(error.problem_type(), ProblemType::BODY_TOO_LARGE);
    }
}
