//! `GET /v1/jobs/{id}/events`: a job's events as they happen (Server-Sent Events).
//!
//! Events are stored rows, and their ids are the rows' numbers. A fresh connection begins with `snapshot`, the job as
//! it stands, without an id; then come all events from the first. A connection with `Last-Event-ID` gets exactly the
//! events after that one. The stream ends after `done`, and when the service stops.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use api::problem::Problem;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use tokio::sync::{OwnedSemaphorePermit, broadcast};
use uuid::Uuid;

use super::extract::JobId;
use super::problem::{Kind, Refusal};
use super::{App, STREAMS};
use crate::metrics::OpenStream;
use crate::store::{StoreError, StoredEvent};

/// A comment line keeps the connection alive through proxies.
const KEEP_ALIVE: Duration = Duration::from_secs(15);
/// A missed change is found at the latest after this long.
const LOOK: Duration = Duration::from_secs(5);
const LAST_EVENT_ID: &str = "last-event-id";

/// Why there is no stream.
#[derive(Debug, thiserror::Error)]
pub(super) enum EventsError {
    /// There is no job of that id.
    #[error("there is no job {0}")]
    Missing(Uuid),
    /// Too many streams are open.
    #[error("{STREAMS} event streams are open, which is the limit; poll the job instead")]
    Full,
    /// Not the id of an event.
    #[error("the Last-Event-ID is not the id of an event: a number from 0")]
    LastEventId,
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The job could not be written.
    #[error(transparent)]
    Write(#[from] serde_json::Error),
}

impl IntoResponse for EventsError {
    fn into_response(self) -> Response {
        match &self {
            Self::Missing(_) => Kind::NoJob.because(self.to_string()),
            Self::Full => {
                let busy = Kind::Busy.because(self.to_string());
                return ([(header::RETRY_AFTER, "5")], busy).into_response();
            }
            Self::LastEventId => Kind::InvalidQuery.because(self.to_string()),
            Self::Store(error) => Refusal::from(error),
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
        (status = 200, description = "The events", content_type = "text/event-stream", body = String),
        (status = 204, description = "The job has ended and nothing follows the event in `Last-Event-ID`"),
        (status = 400, description = "The `Last-Event-ID` cannot be read", body = Problem),
        (status = 404, description = "No such job", body = Problem),
        (status = 503, description = "Too many streams are open", body = Problem),
    )
)]
pub(super) async fn events(
    State(app): State<App>,
    JobId(id): JobId,
    headers: HeaderMap,
) -> Result<Response, EventsError> {
    let after = last_event_id(&headers)?;
    let place = app.streams.clone().try_acquire_owned();
    let place = place.map_err(|_| EventsError::Full)?;
    // Listening begins before looking, so nothing falls between.
    let changes = app.store.changes();
    let job = app.store.job(id).await?.ok_or(EventsError::Missing(id))?;
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
    changes: broadcast::Receiver<Uuid>,
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
        let look = tokio::time::sleep(LOOK);
        tokio::pin!(look);
        loop {
            tokio::select! {
                change = self.changes.recv() => match change {
                    Ok(id) if id != self.id => {}
                    _ => return,
                },
                () = &mut look => return,
                () = self.app.stopping.cancelled() => return,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;
    use crate::queue::Move;
    use crate::store::{Batch, End};

    /// Names and ids of a stream's events.
    fn parsed(text: &str) -> Vec<(String, Option<i64>)> {
        let field = |block: &str, name: &str| {
            block
                .lines()
                .find_map(|line| line.strip_prefix(name).map(|value| value.trim().to_owned()))
        };
        text.split("\n\n")
            .filter_map(|block| {
                let id = field(block, "id:").map(|id| id.parse().expect("a number"));
                field(block, "event:").map(|name| (name, id))
            })
            .collect()
    }

    async fn finished(service: &Service) -> String {
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let store = &service.app.store;
        let claim = store
            .claim(0, i64::MAX)
            .await
            .expect("the store")
            .expect("a job");
        let batch = Batch {
            events: vec![("progress", "{}".into()), ("cycle", "{}".into())],
            ..Batch::default()
        };
        store
            .record(&claim, &batch, i64::MAX)
            .await
            .expect("the store");
        store
            .record(&claim, &batch, i64::MAX)
            .await
            .expect("the store");
        let end = End {
            step: Move::Succeed,
            reason: None,
            outcome: None,
            summary: None,
        };
        store
            .end(&claim, &Batch::default(), &end, 1)
            .await
            .expect("the store");
        id
    }

    #[tokio::test]
    async fn a_finished_job_replays_from_any_last_event_id() {
        let service = Service::new().await;
        let path = format!("/v1/jobs/{}/events", finished(&service).await);
        let fresh = parsed(&service.text("GET", &path, &[], "").await.2);
        assert_eq!(fresh[0], ("snapshot".to_owned(), None));
        let all = &fresh[1..];
        let ids: Vec<_> = all.iter().map(|event| event.1.expect("an id")).collect();
        assert_eq!(ids, [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!((all[1].0.as_str(), all[6].0.as_str()), ("attempt", "done"));
        for after in 0..7_usize {
            let header = after.to_string();
            let (status, _, text) = service
                .text("GET", &path, &[("last-event-id", &header)], "")
                .await;
            assert_eq!(status, 200);
            assert_eq!(parsed(&text), all[after..], "after {after}");
        }
        for after in ["7", "99"] {
            assert_eq!(
                service
                    .text("GET", &path, &[("last-event-id", after)], "")
                    .await
                    .0,
                204
            );
        }
    }

    #[tokio::test]
    async fn a_live_stream_ends_with_done() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}/events");
        let (stream, _) = tokio::join!(service.text("GET", &path, &[], ""), async {
            tokio::task::yield_now().await;
            service.post(&format!("/v1/jobs/{id}/cancel"), "").await
        });
        let names: Vec<_> = parsed(&stream.2).into_iter().map(|event| event.0).collect();
        assert_eq!(names, ["snapshot", "progress", "done"]);
    }

    #[tokio::test]
    async fn a_stream_that_was_asked_to_begin_beyond_the_end_ends_with_the_job() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}/events");
        let beyond = [("last-event-id", "99999")];
        let (stream, _) = tokio::join!(service.text("GET", &path, &beyond, ""), async {
            tokio::task::yield_now().await;
            service.post(&format!("/v1/jobs/{id}/cancel"), "").await
        });
        assert_eq!(parsed(&stream.2), []);
    }

    #[tokio::test]
    async fn a_stream_ends_when_the_service_stops() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}/events");
        let (stream, ()) = tokio::join!(service.text("GET", &path, &[], ""), async {
            tokio::task::yield_now().await;
            service.app.stopping.cancel();
        });
        assert!(!stream.2.contains("event: done"));
    }

    #[tokio::test]
    async fn unreadable_ids_are_problems() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}/events");
        assert_eq!(
            service
                .send("GET", &path, &[("last-event-id", "x")], "")
                .await
                .0,
            400
        );
        assert_eq!(
            service
                .get("/v1/jobs/00000000-0000-7000-8000-000000000000/events")
                .await
                .0,
            404
        );
    }
}
