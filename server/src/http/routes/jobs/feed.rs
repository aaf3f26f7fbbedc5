//! `GET /v1/events`: streams the changes of all jobs (Server-Sent Events).
//!
//! `start` comes first, with the revision of the last change; then `job`, the short document of a job that has changed,
//! and `deleted`. A job that changes many times within a fourth of a second is sent once, as it is then: nothing final is lost. A connection with
//! `Last-Event-ID` receives what has changed since, or `reset` where that is not known any more: lists must then be loaded
//! again. The stream ends when the service stops.

use std::collections::VecDeque;
use std::time::Duration;

use api::event::FeedEvent;
use api::problem::Problem;
use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::Response;
use axum::response::sse::Event;
use futures_util::stream;
use serde_json::json;
use tokio::sync::OwnedSemaphorePermit;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;
use crate::http::routes::jobs::stream::{POLL_INTERVAL, StreamError, last_event_id, streamed};
use crate::metrics::Counted;
use crate::store::{AllChanges, Changed, StoreError};

/// Time in which changes are collected.
const COLLECTED: Duration = Duration::from_millis(250);

/// Changes of all jobs: `start`, `job`, `deleted`, `reset`.
#[utoipa::path(
    get,
    path = "/v1/events",
    tag = "jobs",
    params(
        ("Last-Event-ID" = Option<u64>, Header, description = "Resume after this event"),
    ),
    responses(
        (status = 200, description = "The events", content_type = "text/event-stream", body = FeedEvent),
        (status = 400, description = "The `Last-Event-ID` is not valid", body = Problem),
        (status = 503, description = "Too many streams are open", body = Problem),
    )
)]
pub(crate) async fn all_events(
    State(app): State<App>,
    headers: HeaderMap,
) -> Result<Response, ProblemResponse> {
    let asked = last_event_id(&headers)?;
    let permit = app.stream_permits.clone().try_acquire_owned();
    let permit = permit.map_err(|_| StreamError::TooMany)?;
    // Subscribes before the first query, so that no change is missed in between.
    let changes = app.store.all_changes();
    let (name, after) = match asked {
        Some(after) if app.store.knows_revision(after).await? => (None, after),
        Some(_) => (Some("reset"), app.store.last_revision().await?),
        None => (Some("start"), app.store.last_revision().await?),
    };
    let first = name.map(|name| event(name, Some(after)).data("{}"));
    let tail = FeedTail {
        _counted: app.store.metrics().stream(),
        app,
        after,
        pending: first.into_iter().collect(),
        has_sent: false,
        changes,
        _permit: permit,
    };
    let events = stream::unfold(tail, |mut tail| async move {
        tail.next().await.map(|event| (event, tail))
    });
    Ok(streamed(events))
}

fn event(name: &str, revision: Option<i64>) -> Event {
    let event = Event::default().event(name);
    match revision {
        Some(revision) => event.id(revision.to_string()),
        None => event,
    }
}

/// Remaining changes.
struct FeedTail {
    app: App,
    after: i64,
    /// Fetched, not yet sent.
    pending: VecDeque<Event>,
    /// True if the last fetch has found changes.
    has_sent: bool,
    changes: AllChanges,
    _counted: Counted,
    /// Released when the stream closes.
    _permit: OwnedSemaphorePermit,
}

impl FeedTail {
    async fn next(&mut self) -> Option<Event> {
        loop {
            if let Some(event) = self.pending.pop_front() {
                return Some(event);
            }
            if self.has_sent {
                self.collect().await;
            }
            let fetched = self.fetch().await;
            self.has_sent = matches!(fetched, Ok(true));
            match fetched {
                Ok(true) => {}
                Ok(false) if self.app.stopping.is_cancelled() => return None,
                Ok(false) => self.changed().await,
                Err(error) => {
                    tracing::error!(%error, "the stream of all changes was aborted");
                    return None;
                }
            }
        }
    }

    /// Fetches the next changes; `false` if there are none so far.
    async fn fetch(&mut self) -> Result<bool, StoreError> {
        let changes = self.app.store.changed_after(self.after).await?;
        for (index, (revision, change)) in changes.iter().enumerate() {
            self.after = *revision;
            let next = changes.get(index + 1).map(|(revision, _)| revision);
            // A client that knows a revision knows all changes of it: of several, the last one names it.
            let id = Some(*revision).filter(|revision| next != Some(revision));
            self.pending.push_back(match change {
                Changed::Job(job) => event("job", id).data(serde_json::to_string(job)?),
                Changed::Deleted(job) => {
                    event("deleted", id).data(json!({ "id": job }).to_string())
                }
            });
        }
        Ok(!changes.is_empty())
    }

    /// Waits for a change, or for the next poll, and collects those that follow at once.
    async fn changed(&mut self) {
        tokio::select! {
            () = self.changes.next() => {}
            () = tokio::time::sleep(POLL_INTERVAL) => {}
            () = self.app.stopping.cancelled() => {}
        }
        self.collect().await;
    }

    /// Lets changes come together.
    async fn collect(&self) {
        tokio::select! {
            () = tokio::time::sleep(COLLECTED) => {}
            () = self.app.stopping.cancelled() => {}
        }
    }
}

#[cfg(test)]
mod tests;
