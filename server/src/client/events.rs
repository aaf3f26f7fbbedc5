//! The event stream of a job, resumed after the last event wherever it breaks off.

use std::cell::Cell;
use std::time::{Duration, Instant};

use api::event::Done;
use api::job::{Job, Progress};
use eventsource_stream::Eventsource;
use futures_util::StreamExt;
use reqwest::StatusCode;
use reqwest::header::CONTENT_TYPE;
use uuid::Uuid;

use crate::client::{Client, ClientError};

/// Pause before a stream is opened again.
const PAUSE: Duration = Duration::from_secs(1);
/// Time without a connection or a byte of the stream after which no further attempt is made.
const PATIENCE: Duration = Duration::from_mins(5);

/// Report of a stream while a job has not ended.
#[derive(Debug, Clone, Copy)]
pub enum Followed<'a> {
    /// Progress of the job.
    Progress(&'a Progress),
    /// The stream broke off and is opened again.
    Interrupted(&'a ClientError),
}

/// How a stream ended.
enum Ended {
    /// After the last event of a job that has ended.
    Done(Box<Done>),
    /// Before it.
    Open,
}

impl Client {
    /// Follows a job to its end.
    ///
    /// # Errors
    /// [`ClientError`] if the job does not exist, or the service cannot be reached for five minutes.
    pub async fn follow(
        &self,
        id: Uuid,
        mut observe: impl FnMut(Followed<'_>),
    ) -> Result<Done, ClientError> {
        let (mut last, mut since) = (None, Instant::now());
        loop {
            match self
                .read_stream(id, &mut last, &mut since, &mut observe)
                .await
            {
                Ok(Ended::Done(done)) => return Ok(*done),
                Ok(Ended::Open) => {}
                Err(error) if error.is_temporary() && since.elapsed() < PATIENCE => {
                    observe(Followed::Interrupted(&error));
                }
                Err(error) => return Err(error),
            }
            tokio::time::sleep(PAUSE).await;
        }
    }

    /// Reads a stream from the event after `last` on, until it ends.
    async fn read_stream(
        &self,
        id: Uuid,
        last: &mut Option<String>,
        since: &mut Instant,
        observe: &mut impl FnMut(Followed<'_>),
    ) -> Result<Ended, ClientError> {
        let path = format!("/v1/jobs/{id}/events");
        let mut request = self.http.get(self.url(&path));
        if let Some(last) = &last {
            request = request.header("last-event-id", last);
        }
        let response = self.send(request).await?;
        if response.status() == StatusCode::NO_CONTENT {
            let job = self.job(id).await?;
            // The job may have been queued again.
            return Ok(if job.status.is_terminal() {
                Ended::Done(Box::new(done(job)))
            } else {
                Ended::Open
            });
        }
        let media_type = response.headers().get(CONTENT_TYPE);
        if !media_type.is_some_and(|value| value.as_bytes().starts_with(b"text/event-stream")) {
            let url = self.url(&path);
            return Err(ClientError::NoStream { url });
        }
        *since = Instant::now();
        let heard = Cell::new(*since);
        // Comments are no events, but show that the service is there.
        let chunks = response
            .bytes_stream()
            .inspect(|_| heard.set(Instant::now()));
        let (mut events, mut ended) = (chunks.eventsource(), Ended::Open);
        while let Some(event) = events.next().await {
            *since = heard.get();
            let event = event.map_err(|error| ClientError::Unreachable {
                url: self.base.clone(),
                cause: error.to_string(),
            })?;
            // Those after `done` are of a job that was queued again.
            ended = Ended::Open;
            if !event.id.is_empty() {
                *last = Some(event.id);
            }
            let data = event.data.as_bytes();
            match event.event.as_str() {
                "snapshot" => {
                    let job: Job = self.parsed(&path, data)?;
                    observe(Followed::Progress(&job.progress));
                }
                "progress" => observe(Followed::Progress(&self.parsed(&path, data)?)),
                "done" => ended = Ended::Done(Box::new(self.parsed(&path, data)?)),
                _ => {}
            }
        }
        *since = heard.get();
        Ok(ended)
    }
}

/// How a job that has ended did.
fn done(job: Job) -> Done {
    Done {
        status: job.status,
        status_reason: job.status_reason,
        outcome: job.outcome,
        summary: job.summary,
    }
}
