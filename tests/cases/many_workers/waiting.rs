//! A long queue: the first jobs are taken first. The long form prints how fast claims and ends are.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::Value;
use tests::Server;

use super::simulated::{Done, Harm, started};
use super::sweep::{number, say, submitted};
use super::{ATTEMPTS, asked, is_long, load, report, use_postgresql};

/// Jobs that wait at first, and those that are solved, in the short form.
const WAITING: usize = 1_000;
const SOLVED: usize = 300;
/// Jobs of an answer.
const PAGE: usize = 500;
/// Longest wait, also of the long form; not a measure of speed.
const PATIENCE: Duration = Duration::from_hours(2);

#[tokio::test(flavor = "multi_thread")]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn two_services_take_the_first_jobs_of_a_long_queue() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let _server = use_postgresql(folder.path());
    first_are_solved(folder.path()).await;
}

async fn first_are_solved(folder: &Path) {
    let (solved, workers, _) = load();
    let solved = if is_long() { solved } else { SOLVED };
    let waiting = asked("FRETWEAR_WORKERS_WAITING", WAITING.max(solved));
    let ahead = waiting.to_string();
    let options = [&ATTEMPTS[..], &["--jobs-ahead", &ahead]].concat();
    let services = [(); 2].map(|()| Server::without_workers(folder, &options));
    let began = Instant::now();
    let sweep = submitted(&services[0], waiting).await;
    let path = format!("/v1/sweeps/{}", sweep["id"].as_str().expect("an id"));
    all_wait(&services[0], &path, waiting).await;
    if is_long() {
        say(&format!("{waiting} jobs wait after {:?}", began.elapsed()));
    }
    let done = Arc::new(Done::of(solved));
    let addresses: Vec<_> = services.iter().map(|server| &server.base[..]).collect();
    let began = Instant::now();
    let working = started(folder, &addresses, (workers, Harm::None), &done);
    let claims: Vec<Duration> = working.join_all().await.concat();
    let elapsed = done.last_end() - began;
    let ended = done.ended();
    assert!(ended >= solved, "{ended} of {solved} have ended");
    assert_first(&services[1], &path, ended).await;
    if is_long() {
        report(ended, elapsed, claims);
    }
}

/// Waits until all jobs of a sweep wait in the queue.
async fn all_wait(server: &Server, path: &str, jobs: usize) {
    let all = u64::try_from(jobs).expect("small");
    let wait = async {
        loop {
            let (_, sweep) = server.get(&format!("{path}?limit=1")).await;
            if number(&sweep["counts"]["queued"]) == all {
                return;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
    };
    let wait = tokio::time::timeout(PATIENCE, wait).await;
    wait.expect("they are queued in time");
}

/// Checks that the first jobs of a sweep, and no others, have succeeded.
async fn assert_first(server: &Server, path: &str, ended: usize) {
    for from in (0..=ended).step_by(PAGE) {
        let (_, part) = server
            .get(&format!("{path}?from={from}&limit={PAGE}"))
            .await;
        for job in part["jobs"].as_array().expect("jobs") {
            let is_one = number(&job["position"]) < u64::try_from(ended).expect("small");
            let status = if is_one { "succeeded" } else { "queued" };
            assert_eq!(job["status"], status, "{job}");
        }
    }
    let (_, sweep) = server.get(&format!("{path}?limit=1")).await;
    let succeeded = &sweep["counts"]["succeeded"];
    assert_eq!(succeeded, &Value::from(ended));
}
