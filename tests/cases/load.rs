//! Requirement: while many small jobs go through, many clients poll and many streams are open, nothing is lost, no
//! answer is a 5xx, and every stream carries all events of its job in order and ends with `done`.
//!
//! The short form runs with all cases. The long one, 1 000 jobs with 500 clients and 200 streams, prints latencies,
//! jobs per second and memory:
//!
//!     FRETWEAR_LOAD=long cargo test --release -p tests load -- --nocapture

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use eventsource_stream::Eventsource;
use futures_util::{StreamExt, future};
use serde_json::Value;
use sqlx::Connection;
use tests::{Server, database};

/// A job of some 10 ms.
const SPEC: &str = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":2,
    "accuracy":{"preset":"draft"},"output":{"snapshots_at_cycles":[2]}}"#;
/// Interval between two polls of a client, as `Retry-After` requests.
const PAUSE: Duration = Duration::from_secs(1);
/// Concurrent submissions.
const SUBMITTERS: usize = 16;

/// Load on the service.
#[derive(Clone, Copy)]
struct Load {
    jobs: usize,
    clients: usize,
    streams: usize,
}

impl Load {
    fn asked_for() -> Self {
        if std::env::var("FRETWEAR_LOAD").is_ok_and(|form| form == "long") {
            Self {
                jobs: 1000,
                clients: 500,
                streams: 200,
            }
        } else {
            Self {
                jobs: 40,
                clients: 20,
                streams: 10,
            }
        }
    }
}

/// State that all clients share.
struct Shared {
    base: String,
    client: reqwest::Client,
    ended: AtomicBool,
}

impl Shared {
    /// Duration and body of a request.
    async fn timed(&self, request: reqwest::RequestBuilder) -> (Duration, Value) {
        let began = Instant::now();
        let answer = request.send().await.expect("the service answers");
        let status = answer.status();
        let body = answer.bytes().await.expect("a body");
        let took = began.elapsed();
        assert!(status.is_success() || status == 304, "{status}");
        (took, serde_json::from_slice(&body).unwrap_or_default())
    }

    /// Bytes of the body of an answer in an encoding.
    async fn bytes_of(&self, path: &str, encoding: &str) -> usize {
        let request = self.client.get(format!("{}{path}", self.base));
        let request = request.header("accept-encoding", encoding);
        let answer = request.send().await.expect("the service answers");
        assert_eq!(answer.status(), 200);
        answer.bytes().await.expect("a body").len()
    }

    fn job(&self, id: &str) -> reqwest::RequestBuilder {
        self.client.get(format!("{}/v1/jobs/{id}", self.base))
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn nothing_is_lost_under_many_polls_and_streams() {
    let load = Load::asked_for();
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--workers", "2"]);
    let shared = Arc::new(Shared {
        base: server.base.clone(),
        client: reqwest::Client::new(),
        ended: AtomicBool::new(false),
    });
    let began = Instant::now();
    let (ids, submits) = submitted(&shared, load.jobs).await;
    let submitting = began.elapsed();
    let ids = Arc::new(ids);
    let polls = (0..load.clients).map(|client| {
        let (shared, ids) = (Arc::clone(&shared), Arc::clone(&ids));
        tokio::spawn(async move { polled(&shared, &ids, client).await })
    });
    let polls: Vec<_> = polls.collect();
    let streams = (0..load.streams).map(|listener| {
        // Spread over all jobs, so that some streams are open until the end.
        let id = ids[listener * load.jobs / load.streams].clone();
        let shared = Arc::clone(&shared);
        tokio::spawn(async move { listened(&shared, &id).await })
    });
    let streams: Vec<_> = streams.collect();
    let jobs = all_ended(&shared, &ids).await;
    let elapsed = began.elapsed();
    shared.ended.store(true, Ordering::Relaxed);
    for stream in future::join_all(streams).await {
        stream.expect("a stream that is whole");
    }
    let mut waits: Vec<Duration> = Vec::new();
    for poll in future::join_all(polls).await {
        waits.extend(poll.expect("a client that was answered"));
    }
    report(load, submitting, submits, elapsed, waits, &jobs);
    let (list, last) = (
        "/v1/jobs?limit=50",
        format!("/v1/jobs/{}", ids[load.jobs - 1]),
    );
    for (what, path) in [("poll", last.as_str()), ("list of 50", list)] {
        let plain = shared.bytes_of(path, "identity").await;
        let compressed = shared.bytes_of(path, "gzip").await;
        assert!(compressed < plain, "{what}: {compressed} of {plain} bytes");
        tell(format_args!(
            "{what}: {plain} bytes, {compressed} with gzip"
        ));
    }
    let bytes = database_bytes(folder.path()).await;
    tell(format_args!(
        "database: {:.1} kB a job",
        bytes / 1e3 / f64::from(u32::try_from(load.jobs).expect("small"))
    ));
    tell(format_args!(
        "server: peak memory {:.0} MB",
        server.peak_memory_mb()
    ));
}

/// Bytes of the pages that the database uses.
async fn database_bytes(folder: &Path) -> f64 {
    let mut stored = database::open(folder).await;
    let bytes: i64 = sqlx::query_scalar(
        "SELECT (page_count - freelist_count) * page_size FROM pragma_page_count, pragma_freelist_count, pragma_page_size",
    )
    .fetch_one(&mut stored)
    .await
    .expect("its size");
    stored.close().await.expect("closed");
    f64::from(u32::try_from(bytes).expect("small"))
}

async fn submitted(shared: &Arc<Shared>, jobs: usize) -> (Vec<String>, Vec<Duration>) {
    let next = Arc::new(AtomicUsize::new(0));
    let submitters = (0..SUBMITTERS).map(|_| {
        let (shared, next) = (Arc::clone(shared), Arc::clone(&next));
        tokio::spawn(async move {
            let mut done = Vec::new();
            while next.fetch_add(1, Ordering::Relaxed) < jobs {
                let request = shared.client.post(format!("{}/v1/jobs", shared.base));
                let request = request
                    .header("content-type", "application/json")
                    .body(SPEC);
                let (took, job) = shared.timed(request).await;
                done.push((job["id"].as_str().expect("an id").to_owned(), took));
            }
            done
        })
    });
    let done = future::join_all(submitters).await;
    let done = done.into_iter().flat_map(|done| done.expect("submitted"));
    let mut done: Vec<_> = done.collect();
    // The ids of jobs are ordered by their creation.
    done.sort();
    done.into_iter().unzip()
}

/// Polls one job after the other until all have ended; returns the duration of each answer.
async fn polled(shared: &Shared, ids: &[String], client: usize) -> Vec<Duration> {
    let mut waits = Vec::new();
    // Clients do not poll simultaneously.
    let share = u32::try_from(client % 100).expect("small");
    tokio::time::sleep(PAUSE * share / 100).await;
    while !shared.ended.load(Ordering::Relaxed) {
        let id = &ids[(client + 7 * waits.len()) % ids.len()];
        waits.push(shared.timed(shared.job(id)).await.0);
        tokio::time::sleep(PAUSE).await;
    }
    waits
}

/// Follows the stream of a job to its end, and checks that no event is missing.
async fn listened(shared: &Shared, id: &str) {
    let request = shared
        .client
        .get(format!("{}/v1/jobs/{id}/events", shared.base));
    let answer = request.send().await.expect("a stream");
    assert_eq!(answer.status(), 200);
    let mut events = answer.bytes_stream().eventsource();
    let (mut last, mut done) = (0_u64, false);
    while let Some(event) = events.next().await {
        let event = event.expect("an event");
        done = event.event == "done";
        if event.event != "snapshot" {
            let number: u64 = event.id.parse().expect("a number");
            assert_eq!(number, last + 1, "{id}");
            last = number;
        }
    }
    assert!(done, "{id}");
}

/// The documents of all jobs, once all have ended.
async fn all_ended(shared: &Shared, ids: &[String]) -> Vec<Value> {
    let mut jobs = Vec::with_capacity(ids.len());
    for id in ids {
        loop {
            let waiting = shared
                .client
                .get(format!("{}/v1/jobs/{id}?wait=30s", shared.base));
            let (_, job) = shared.timed(waiting).await;
            if job["finished_at"].is_string() {
                assert_eq!(job["status"], "succeeded", "{job}");
                jobs.push(job);
                break;
            }
        }
    }
    jobs
}

fn report(
    load: Load,
    submitting: Duration,
    submits: Vec<Duration>,
    elapsed: Duration,
    waits: Vec<Duration>,
    jobs: &[Value],
) {
    let Load {
        jobs: count,
        clients,
        streams,
    } = load;
    tell(format_args!(
        "load: {count} jobs, {clients} polling clients, {streams} streams"
    ));
    let per_second = |count: usize, time: Duration| {
        f64::from(u32::try_from(count).expect("small")) / time.as_secs_f64()
    };
    tell(format_args!(
        "submit: {:.0} a second; {}",
        per_second(count, submitting),
        percentiles(submits)
    ));
    tell(format_args!(
        "poll: {} polls; {}",
        waits.len(),
        percentiles(waits)
    ));
    tell(format_args!(
        "jobs: {:.1} a second",
        per_second(count, elapsed)
    ));
    let solves: f64 = jobs
        .iter()
        .filter_map(|job| job["summary"]["cost"]["wall_s"].as_f64())
        .sum();
    let spent = 2.0 * elapsed.as_secs_f64() - solves;
    let overhead = 1e3 * spent / f64::from(u32::try_from(count).expect("small"));
    tell(format_args!(
        "overhead: {overhead:.1} ms of a worker for each job beyond its solve"
    ));
}

/// Prints a figure; a closed pipe is no failure.
fn tell(line: std::fmt::Arguments<'_>) {
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

fn percentiles(mut times: Vec<Duration>) -> String {
    times.sort();
    let at = |share: usize| {
        let index = (times.len() * share / 1000).min(times.len().saturating_sub(1));
        times
            .get(index)
            .map_or(0.0, |time| 1e3 * time.as_secs_f64())
    };
    format!(
        "p50 {:.2} ms, p95 {:.2} ms, p99 {:.2} ms, longest {:.2} ms",
        at(500),
        at(950),
        at(990),
        at(1000)
    )
}
