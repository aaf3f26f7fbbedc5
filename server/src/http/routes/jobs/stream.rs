//! `GET /v1/jobs/{id}/events`: streams the events of a job (Server-Sent Events).
//!
//! Events are stored rows with sequence numbers as ids. A new connection starts with `snapshot`, the current state of
//! the job, without an id; all events follow, from the first. A connection with `Last-Event-ID` receives exactly the
//! events after that one. The stream ends after `done`, unless the job was queued again since, and when the
//! service stops.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use api::event::StreamEvent;
use api::problem::Problem;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderName, StatusCode, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::{Stream, StreamExt, stream};
use tokio::sync::OwnedSemaphorePermit;
use uuid::Uuid;

use crate::http::app::{App, MAX_STREAMS};
use crate::http::extract::JobId;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::metrics::Counted;
use crate::store::{Changes, StoreError, StoredEvent};

/// Interval of comment lines, which keep the connection open through proxies.
const KEEP_ALIVE: Duration = Duration::from_secs(15);
/// Poll interval of the store, in case a notification was missed.
pub(super) const POLL_INTERVAL: Duration = Duration::from_secs(5);
const LAST_EVENT_ID: &str = "last-event-id";
/// Header with which nginx and its descendants send an answer on as it arrives, instead of in blocks.
const NO_BUFFERING: HeaderName = HeaderName::from_static("x-accel-buffering");

/// Error of a request for an event stream.
#[derive(Debug, thiserror::Error)]
pub(super) enum StreamError {
    /// Too many streams are open.
    #[error("{MAX_STREAMS} event streams are open, which is the limit; poll the job instead")]
    TooMany,
    /// Not the id of an event.
    #[error("the Last-Event-ID is not the id of an event: a number from 0")]
    LastEventId,
}

impl RouteError for StreamError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::TooMany => ProblemType::BUSY,
            Self::LastEventId => ProblemType::INVALID_QUERY,
        }
    }
}

/// Event stream of a job: `snapshot`, `attempt`, `progress`, `cycle`, `done`.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/events",
    tag = "jobs",
    params(
        ("Last-Event-ID" = Option<u64>, Header, description = "Resume after this event"),
    ),
    responses(
        (status = 200, description = "The events", content_type = "text/event-stream", body = StreamEvent),
        (status = 204, description = "The job has ended, and no event follows the one in `Last-Event-ID`"),
        (status = 400, description = "The `Last-Event-ID` is not valid", body = Problem),
        (status = 503, description = "Too many streams are open", body = Problem),
    )
)]
pub(crate) async fn events(
    State(app): State<App>,
    JobId(id): JobId,
    headers: HeaderMap,
) -> Result<Response, ProblemResponse> {
    let after = last_event_id(&headers)?;
    let permit = app.stream_permits.clone().try_acquire_owned();
    let permit = permit.map_err(|_| StreamError::TooMany)?;
    // Subscribes before the first query, so that no change is missed in between.
    let changes = app.store.changes(id);
    let job = app.job(id).await?;
    if job.document.status.is_terminal() && after.is_some_and(|after| after >= job.last_event) {
        // With this status a browser does not reconnect.
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let mut pending = VecDeque::new();
    if after.is_none() {
        pending.push_back(
            Event::default()
                .event("snapshot")
                .data(serde_json::to_string(&job.document)?),
        );
    }
    let tail = EventTail {
        _counted: app.store.metrics().stream(),
        app,
        id,
        after: after.unwrap_or(0),
        pending,
        changes,
        ended: false,
        _permit: permit,
    };
    let events = stream::unfold(tail, |mut tail| async move {
        tail.next().await.map(|event| (event, tail))
    });
    Ok(streamed(events))
}

/// The answer that streams events; no proxy stores them or waits for more of them.
pub(super) fn streamed(events: impl Stream<Item = Event> + Send + 'static) -> Response {
    let sse = Sse::new(events.map(Ok::<_, Infallible>));
    let sse = sse.keep_alive(KeepAlive::new().interval(KEEP_ALIVE));
    let headers = [(header::CACHE_CONTROL, "no-store"), (NO_BUFFERING, "no")];
    (headers, sse).into_response()
}

pub(super) fn last_event_id(headers: &HeaderMap) -> Result<Option<i64>, StreamError> {
    let Some(value) = headers.get(LAST_EVENT_ID) else {
        return Ok(None);
    };
    let text = value.to_str().unwrap_or_default().trim();
    let number = text.parse().ok().filter(|number: &i64| *number >= 0);
    number.map(Some).ok_or(StreamError::LastEventId)
}

/// Remaining events of a job.
struct EventTail {
    app: App,
    id: Uuid,
    after: i64,
    /// Fetched, not yet sent.
    pending: VecDeque<Event>,
    changes: Changes,
    ended: bool,
    _counted: Counted,
    /// Released when the stream closes.
    _permit: OwnedSemaphorePermit,
}

impl EventTail {
    async fn next(&mut self) -> Option<Event> {
        loop {
            if let Some(event) = self.pending.pop_front() {
                return Some(event);
            }
            if self.ended || self.app.stopping.is_cancelled() {
                return None;
            }
            match self.fetch().await {
                Ok(true) => {}
                Ok(false) => self.changed().await,
                Err(error) => {
                    tracing::error!(job = %self.id, %error, "an event stream was aborted");
                    return None;
                }
            }
        }
    }

    /// Fetches the next events; `false` if there are none so far.
    async fn fetch(&mut self) -> Result<bool, StoreError> {
        let events = self.app.store.events(self.id, self.after).await?;
        let found = !events.is_empty();
        let mut may_have_ended = !found;
        for StoredEvent { seq, name, data } in events {
            self.after = seq;
            may_have_ended = name == "done";
            self.pending
                .push_back(Event::default().id(seq.to_string()).event(name).data(data));
        }
        if may_have_ended {
            // The stream ends if the job was deleted, or has ended at or before this event or the one in `Last-Event-ID`, and
            // was not queued again.
            let job = self.app.store.job(self.id).await?;
            self.ended = job.is_none_or(|job| {
                job.document.status.is_terminal() && self.after >= job.last_event
            });
        }
        Ok(found || self.ended)
    }

    /// Waits for a change of the job, or for the next poll.
    async fn changed(&mut self) {
        tokio::select! {
            () = self.changes.next() => {}
            () = tokio::time::sleep(POLL_INTERVAL) => {}
            () = self.app.stopping.cancelled() => {}
        }
    }
}

#[cfg(test)]
mod tests;
