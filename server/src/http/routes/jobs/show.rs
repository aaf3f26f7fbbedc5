//! `GET /v1/jobs/{id}`: a job, with `ETag` and long poll.

use std::time::Duration;

use api::job::Job;
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use tokio::time::Instant;
use utoipa::IntoParams;

use crate::http::app::App;
use crate::http::extract::{JobId, Params};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::store::StoredJob;
use crate::text::shortened;

/// Longest long poll, s.
const MAX_WAIT_S: u64 = 60;
/// Poll interval of the store, in case a notification was missed.
const POLL_INTERVAL: Duration = Duration::from_secs(1);

/// Error of the duration of a long poll.
#[derive(Debug, thiserror::Error)]
#[error("`{0}` is not a duration such as 25s, up to {MAX_WAIT_S}s")]
struct WaitError(String);

impl RouteError for WaitError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Query of a long poll.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShowQuery {
    /// Long poll: responds when the job has changed (with `If-None-Match`) or ended (without), or after this duration,
    /// for instance `25s`.
    wait: Option<String>,
}

/// State, progress and results of a job.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}",
    tag = "jobs",
    params(ShowQuery),
    responses(
        (status = 200, description = "The job", body = Job, headers(
            ("ETag" = String, description = "Its version"),
            ("Retry-After" = u64, description = "Recommended pause before the next poll, s; absent once the job has ended"),
        )),
        (status = 304, description = "Not changed since the version in `If-None-Match`"),
    )
)]
pub(crate) async fn show(
    State(app): State<App>,
    JobId(id): JobId,
    Params(query): Params<ShowQuery>,
    headers: HeaderMap,
) -> Result<Response, ProblemResponse> {
    let wait = query.wait.as_deref().map(parse_wait).transpose()?;
    let known = headers
        .get(header::IF_NONE_MATCH)
        .and_then(|value| value.to_str().ok())
        .map(str::to_owned);
    let mut changes = app.store.changes(id);
    let mut job = app.job(id).await?;
    // Without a permit the response is sent at once, as if the poll had timed out.
    let permit = app.long_poll_permits.try_acquire().ok();
    if let (Some(wait), Some(_)) = (wait, &permit) {
        let deadline = Instant::now() + wait;
        while !is_news(&job, known.as_deref())
            && Instant::now() < deadline
            && !app.stopping.is_cancelled()
        {
            tokio::select! {
                () = changes.next() => {}
                () = tokio::time::sleep_until(deadline.min(Instant::now() + POLL_INTERVAL)) => {}
                () = app.stopping.cancelled() => {}
            }
            job = app.job(id).await?;
        }
    }
    let etag = [
        (header::ETAG, etag(&job)),
        (header::CACHE_CONTROL, "no-cache".to_owned()),
    ];
    if known.is_some_and(|known| has_version(&known, &job)) {
        return Ok((StatusCode::NOT_MODIFIED, etag).into_response());
    }
    let mut response = (etag, Json(&job.document)).into_response();
    if !job.document.status.is_terminal() {
        let pause = retry_after_s(&job.document).into();
        response.headers_mut().insert(header::RETRY_AFTER, pause);
    }
    Ok(response)
}

/// Recommended pause before the next poll of a job that has not ended, s: a tenth of the remaining time, within bounds.
pub(crate) fn retry_after_s(job: &Job) -> u64 {
    const MAX_S: f64 = 30.0;
    let left_s = job.progress.eta_s.unwrap_or(10.0);
    let pause = Duration::try_from_secs_f64((0.1 * left_s).clamp(1.0, MAX_S));
    pause.map_or(1, |pause| pause.as_secs())
}

/// Returns `true` if a long poll ends with this job.
fn is_news(job: &StoredJob, known: Option<&str>) -> bool {
    match known {
        Some(known) => !has_version(known, job),
        None => job.document.status.is_terminal(),
    }
}

fn etag(job: &StoredJob) -> String {
    let waits = if job.waits_for_disk { "-disk" } else { "" };
    format!("\"{}{waits}\"", job.version)
}

/// Returns `true` if `If-None-Match` lists the version of the job.
fn has_version(known: &str, job: &StoredJob) -> bool {
    let own = etag(job);
    known
        .split(',')
        .map(|tag| tag.trim().trim_start_matches("W/"))
        .any(|tag| tag == "*" || tag == own)
}

/// Parses `25s`, `500ms` or `25`.
fn parse_wait(text: &str) -> Result<Duration, WaitError> {
    let wrong = || WaitError(shortened(text));
    let (digits, scale_ms) = match text.strip_suffix("ms") {
        Some(digits) => (digits, 1),
        None => (text.strip_suffix('s').unwrap_or(text), 1000),
    };
    if !digits.bytes().all(|digit| digit.is_ascii_digit()) {
        return Err(wrong());
    }
    let count: u64 = digits.parse().map_err(|_| wrong())?;
    let milliseconds = count
        .checked_mul(scale_ms)
        .filter(|total| *total <= MAX_WAIT_S * 1000)
        .ok_or_else(wrong)?;
    Ok(Duration::from_millis(milliseconds))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn an_unchanged_job_is_a_304() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}");
        let (status, headers, job) = service.get(&path).await;
        assert_eq!(
            (status.as_u16(), job["id"].as_str()),
            (200, Some(id.as_str()))
        );
        assert_eq!(headers["retry-after"], "1");
        let etag = headers["etag"].to_str().expect("text").to_owned();
        let known = [("if-none-match", etag.as_str())];
        assert_eq!(service.send("GET", &path, &known, "").await.0, 304);
        service.post(&format!("{path}/cancel"), "").await;
        let (status, _, job) = service.send("GET", &path, &known, "").await;
        assert_eq!(
            (status.as_u16(), job["status"].as_str()),
            (200, Some("cancelled"))
        );
    }

    #[tokio::test]
    async fn a_long_poll_ends_with_the_job() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}?wait=30s");
        let (waited, _) = tokio::join!(service.get(&path), async {
            tokio::task::yield_now().await;
            service.post(&format!("/v1/jobs/{id}/cancel"), "").await
        });
        assert_eq!(waited.2["status"], "cancelled");
    }

    #[tokio::test]
    async fn a_long_poll_times_out() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (status, _, job) = service.get(&format!("/v1/jobs/{id}?wait=20ms")).await;
        assert_eq!(
            (status.as_u16(), job["status"].as_str()),
            (200, Some("queued"))
        );
        for wait in ["61s", "soon", "-1s", "99999999999999999999s"] {
            assert_eq!(
                service.get(&format!("/v1/jobs/{id}?wait={wait}")).await.0,
                400,
                "{wait}"
            );
        }
    }

    #[tokio::test]
    async fn a_long_poll_over_the_limit_is_answered_at_once() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let all = u32::try_from(crate::http::app::MAX_LONG_POLLS).expect("a count");
        let taken = service
            .app
            .long_poll_permits
            .clone()
            .acquire_many_owned(all)
            .await;
        // Would otherwise take a minute.
        let path = format!("/v1/jobs/{id}?wait=60s");
        let (status, _, job) = service.get(&path).await;
        drop(taken);
        assert_eq!(
            (status.as_u16(), job["status"].as_str()),
            (200, Some("queued"))
        );
    }

    #[tokio::test]
    async fn unknown_jobs_are_404_problems() {
        let service = Service::new().await;
        for id in [
            "00000000-0000-7000-8000-000000000000",
            "..%2F..%2Fetc%2Fpasswd",
            "1",
        ] {
            let (status, _, problem) = service.get(&format!("/v1/jobs/{id}")).await;
            assert_eq!(
                (status.as_u16(), problem["type"].as_str()),
                (404, Some("/problems/no-such-job")),
                "{id}"
            );
        }
    }
}
