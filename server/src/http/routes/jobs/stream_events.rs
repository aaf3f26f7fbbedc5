//! `GET /v1/jobs/{id}/events`: a job's events as they happen (Server-Sent Events).
//!
//! Events are stored rows, and their ids are the rows' numbers. A fresh connection begins with `snapshot`, the job as
//! it stands, without an id; then come all events from the first. A connection with `Last-Event-ID` gets exactly the
//! events after that one. The stream ends after `done`, and when the service stops.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use api::event::StreamEvent;
use api::problem::Problem;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use tokio::sync::OwnedSemaphorePermit;
use uuid::Uuid;

use crate::http::extract::JobId;
use crate::http::job_error::JobError;
use crate::http::problem::{Kind, Refusal};
use crate::http::{App, STREAMS};
use crate::metrics::OpenStream;
use crate::store::{Changes, StoreError, StoredEvent};

/// A comment line keeps the connection alive through proxies.
const KEEP_ALIVE: Duration = Duration::from_secs(15);
/// A missed change is found at the latest after this long.
const LOOK: Duration = Duration::from_secs(5);
const LAST_EVENT_ID: &str = "last-event-id";

/// Why there is no stream.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum EventsError {
    /// There is no such job.
    #[error(transparent)]
    Job(#[from] JobError),
    /// Too many streams are open.
    #[error("{STREAMS} event streams are open, which is the limit; poll the job instead")]
    Full,
    /// Not the id of an event.
    #[error("the Last-Event-ID is not the id of an event: a number from 0")]
    LastEventId,
    /// The job could not be written.
    #[error(transparent)]
    Write(#[from] serde_json::Error),
}

impl IntoResponse for EventsError {
    fn into_response(self) -> Response {
        match &self {
            Self::Job(error) => Refusal::from(error),
            Self::Full => Kind::Busy.because(self.to_string()),
            Self::LastEventId => Kind::InvalidQuery.because(self.to_string()),
            Self::Write(error) => Refusal::internal(error),
        }
        .into_response()
    }
}

/// A job's events as they happen: `snapshot`, `attempt`, `progress`, `cycle`, `done`.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/events",
    tag = "jobs",
    params(
        ("id" = Uuid, Path, description = "The job"),
        ("Last-Event-ID" = Option<u64>, Header, description = "Go on after this event"),
    ),
    responses(
        (status = 200, description = "The events", content_type = "text/event-stream", body = StreamEvent),
        (status = 204, description = "The job has ended and nothing follows the event in `Last-Event-ID`"),
        (status = 400, description = "The `Last-Event-ID` cannot be read", body = Problem),
        (status = 404, description = "No such job", body = Problem),
        (status = 503, description = "Too many streams are open", body = Problem),
    )
)]
pub(in crate::http) async fn events(
    State(app): State<App>,
    JobId(id): JobId,
    headers: HeaderMap,
) -> Result<Response, EventsError> {
    let after = last_event_id(&headers)?;
    let place = app.streams.clone().try_acquire_owned();
    let place = place.map_err(|_| EventsError::Full)?;
    // Listening begins before looking, so nothing falls between.
    let changes = app.store.changes(id);
    let job = app.job(id).await?;
    if job.document.status.is_terminal() && after.is_some_and(|after| after >= job.last_event) {
        // Tells a browser not to connect again.
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let mut waiting = VecDeque::new();
    if after.is_none() {
        waiting.push_back(
            Event::default()
                .event("snapshot")
                .data(serde_json::to_string(&job.document)?),
        );
    }
    let tail = Tail {
        _counted: app.store.metrics().stream(),
        app,
        id,
        after: after.unwrap_or(0),
        waiting,
        changes,
        ended: false,
        _place: place,
    };
    let events = stream::unfold(tail, |mut tail| async move {
        tail.next()
            .await
            .map(|event| (Ok::<_, Infallible>(event), tail))
    });
    let sse = Sse::new(events).keep_alive(KeepAlive::new().interval(KEEP_ALIVE));
    Ok(([(header::CACHE_CONTROL, "no-store")], sse).into_response())
}

fn last_event_id(headers: &HeaderMap) -> Result<Option<i64>, EventsError> {
    let Some(value) = headers.get(LAST_EVENT_ID) else {
        return Ok(None);
    };
    let number: i64 = value
        .to_str()
        .ok()
        .and_then(|text| text.trim().parse().ok())
        .ok_or(EventsError::LastEventId)?;
    if number < 0 {
        Err(EventsError::LastEventId)
    } else {
        Ok(Some(number))
    }
}

/// The rest of a job's events.
struct Tail {
    app: App,
    id: Uuid,
    after: i64,
    waiting: VecDeque<Event>,
    changes: Changes,
    ended: bool,
    _counted: OpenStream,
    /// Held as long as the stream is open.
    _place: OwnedSemaphorePermit,
}

impl Tail {
    async fn next(&mut self) -> Option<Event> {
        loop {
            if let Some(event) = self.waiting.pop_front() {
                return Some(event);
            }
            if self.ended || self.app.stopping.is_cancelled() {
                return None;
            }
            match self.fetch().await {
                Ok(true) => {}
                Ok(false) => self.changed().await,
                Err(error) => {
                    tracing::error!(job = %self.id, %error, "an event stream was broken off");
                    return None;
                }
            }
        }
    }

    /// Fetches the next events; `false` if there are none yet.
    async fn fetch(&mut self) -> Result<bool, StoreError> {
        let events = self.app.store.events(self.id, self.after).await?;
        let found = !events.is_empty();
        for StoredEvent { seq, name, data } in events {
            self.after = seq;
            self.ended |= name == "done";
            self.waiting
                .push_back(Event::default().id(seq.to_string()).event(name).data(data));
        }
        if !found {
            // Nothing follows a job that is gone, or that ended before the event that the client asked to go on from.
            let job = self.app.store.job(self.id).await?;
            self.ended = job.is_none_or(|job| {
                job.document.status.is_terminal() && self.after >= job.last_event
            });
        }
        Ok(found || self.ended)
    }

    /// Waits until this job changed, or may have.
    async fn changed(&mut self) {
        tokio::select! {
            () = self.changes.next() => {}
            () = tokio::time::sleep(LOOK) => {}
            () = self.app.stopping.cancelled() => {}
        }
    }
}

#[cfg(test)]
mod tests;
