//! Requirement: lists, filters and metrics of a service with many stored jobs are answered from indexes: with the right jobs, and
//! in a time that does not grow with the number of jobs.
//!
//! The short form runs with all cases and checks the answers. The long one, with 100 000 jobs, prints times:
//!
//!     FRETWEAR_LOAD=long cargo test --release -p tests many_jobs -- --nocapture

use std::io::Write;
use std::time::{Duration, Instant};

use serde_json::Value;
use sqlx::Connection;
use tests::{Server, database};

const SPEC: &str =
    r#"{"system":{"kind":"cylinder_on_flat"},"cycles":2,"accuracy":{"preset":"draft"}}"#;
/// Requests of which the median time is printed.
const REQUESTS: usize = 21;
/// Milliseconds between two stored jobs.
const APART_MS: i64 = 60_000;

/// Stores so many copies of a job, one a minute before the next.
const COPY: &str = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < ?1) \
    INSERT INTO jobs (id, system, spec, plan, status, outcome, created_at, started_at, finished_at, progress, summary, attempts, \
                      last_event, version, priority, place, memory_mb, queued_at) \
    SELECT printf('%08x-%04x-7000-8000-%012x', (created_at - i * ?2) >> 16, (created_at - i * ?2) & 65535, i), system, spec, plan, \
           status, outcome, created_at - i * ?2, started_at, finished_at, progress, summary, attempts, last_event, version, priority, \
           place, memory_mb, queued_at \
    FROM jobs, n";

fn jobs() -> i64 {
    if std::env::var("FRETWEAR_LOAD").is_ok_and(|form| form == "long") {
        100_000
    } else {
        300
    }
}

/// Requests a path many times; prints the median time, and returns the answer.
async fn timed(server: &Server, what: &str, path: &str) -> Value {
    let (mut times, mut answer) = (Vec::new(), Value::Null);
    for _ in 0..REQUESTS {
        let began = Instant::now();
        let (status, found) = server.get(path).await;
        times.push(began.elapsed());
        assert_eq!(status, 200, "{path}: {found}");
        answer = found;
    }
    times.sort();
    let median: Duration = times[REQUESTS / 2];
    println!("{what}: {:.1} ms", 1e3 * median.as_secs_f64());
    // Shown even if the output of tests is captured line by line.
    std::io::stdout().flush().expect("standard output");
    answer
}

fn count(list: &Value) -> usize {
    list["jobs"].as_array().map_or(0, Vec::len)
}

#[tokio::test]
async fn lists_filters_and_metrics_are_right_with_many_jobs() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let (_, job) = server.submit(SPEC).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let ended = |job: &Value| job["finished_at"].is_string();
    let created = server.job_when(&id, ended).await["created_at"].clone();
    let mut stored = database::open(folder.path()).await;
    let copies = sqlx::query(COPY).bind(jobs()).bind(APART_MS);
    copies.execute(&mut stored).await.expect("copied");
    stored.close().await.expect("closed");

    println!("{} stored jobs, median times:", jobs() + 1);
    let newest = timed(&server, "list of 50", "/v1/jobs?limit=50").await;
    assert_eq!((count(&newest), &newest["jobs"][0]["id"]), (50, &job["id"]));
    let other = timed(&server, "system without a match", "/v1/jobs?system=zif").await;
    assert_eq!(count(&other), 0);
    let failed = timed(&server, "status without a match", "/v1/jobs?status=failed").await;
    assert_eq!(count(&failed), 0);
    let long_ago = "/v1/jobs?created_before=2020-01-01T00:00:00Z";
    assert_eq!(
        count(&timed(&server, "created long ago", long_ago).await),
        0
    );
    let later = format!(
        "/v1/jobs?created_from={}",
        created.as_str().expect("a time")
    );
    let later = timed(&server, "created since the last", &later).await;
    assert_eq!(count(&later), 1);
    let one = timed(&server, "poll of one job", &format!("/v1/jobs/{id}")).await;
    assert_eq!(one["id"], job["id"]);
    let metrics = timed(&server, "metrics", "/metrics").await;
    let line = format!("fretwear_jobs{{status=\"succeeded\"}} {}", jobs() + 1);
    let metrics = metrics.as_str().expect("text");
    assert!(metrics.lines().any(|found| found == line), "{metrics}");
}
