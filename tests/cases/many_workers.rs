//! Requirement: many remote workers share the jobs of a service: each is solved, none is recorded twice, and a request that is
//! repeated because its answer was lost costs no attempt, also if the service is killed meanwhile.
//!
//! The workers are simulated: they claim, record and end over HTTP as real ones do, and solve nothing. The short form runs with all
//! cases. The long one prints jobs per second and the times of claims of so many jobs and workers, with a PostgreSQL database also of so
//! many services:
//!
//!     FRETWEAR_WORKERS_LOAD=10000,1000 cargo test --release -p tests many_workers::of_a_file -- --nocapture
//!     FRETWEAR_WORKERS_LOAD=10000,1000,2 cargo test --release -p tests many_workers::of_postgresql -- --nocapture
//!
//! `FRETWEAR_WORKERS_SLOTS` of them are in a process (4), which sends their writes together. `FRETWEAR_WORKERS_BUNDLE` is the number of jobs that one
//! claims at once (1); with `FRETWEAR_WORKERS_ENDS_ONLY` it records nothing between claim and end.
//!
//! `waiting` lets `FRETWEAR_WORKERS_WAITING` jobs wait at first (1 000; above 40 000 a multiple of that), of which so many are solved:
//!
//!     FRETWEAR_WORKERS_WAITING=1000000 FRETWEAR_WORKERS_LOAD=50000,1000 cargo test --release -p tests many_workers::waiting -- --nocapture
//!
//! `failover` kills the primary of a PostgreSQL database, `harms` everything that jobs depend on, one after the other; their long form has
//! so many jobs and workers, and `FRETWEAR_HARMS` harms:
//!
//!     FRETWEAR_WORKERS_LOAD=100000,1000,3 FRETWEAR_HARMS=50 cargo test --release -p tests many_workers::harms -- --nocapture

mod failover;
mod harms;
mod simulated;
mod sweep;
mod waiting;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use futures_util::{StreamExt, stream};
use nix::sys::signal::Signal;
use tests::{PostgresServer, Server, bits};

use simulated::{Done, ENDS_ONLY, Harm, started};

/// A job whose documents are small.
const SPEC: &str = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":2,
    "accuracy":{"preset":"draft"},"output":{"snapshots_at_cycles":[2]}}"#;
/// Attempts at a job: more than vanishing workers can use up.
const ATTEMPTS: [&str; 2] = ["--attempts", "20"];

/// Requests of a case at the same time.
const AT_ONCE: usize = 16;

/// Number of jobs, workers and services.
fn load() -> (usize, usize, usize) {
    let Some(asked) = std::env::var("FRETWEAR_WORKERS_LOAD").ok() else {
        return (120, 30, 2);
    };
    let numbers: Vec<_> = asked.split(',').flat_map(str::parse).collect();
    let [jobs, workers, services @ ..] = &numbers[..] else {
        panic!("`{asked}` is not JOBS,WORKERS or JOBS,WORKERS,SERVICES");
    };
    (*jobs, *workers, services.first().copied().unwrap_or(1))
}

/// A number of the environment.
fn asked(variable: &str, default: usize) -> usize {
    let asked = std::env::var(variable).ok();
    asked.map_or(default, |number| number.parse().expect("a number"))
}

/// Returns `true` if so many jobs and workers are asked for that only the rates are of interest.
fn is_long() -> bool {
    std::env::var_os("FRETWEAR_WORKERS_LOAD").is_some()
}

mod of_a_file {
    #[tokio::test(flavor = "multi_thread")]
    async fn every_job_is_solved_once_although_answers_are_lost_and_the_service_is_killed() {
        let folder = tempfile::tempdir().expect("a folder can be made");
        super::solved_once(folder.path(), 1).await;
    }
}

mod of_postgresql {
    #[tokio::test(flavor = "multi_thread")]
    #[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
    async fn every_job_is_solved_once_although_answers_are_lost_and_a_service_is_killed() {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let _server = super::use_postgresql(folder.path());
        super::solved_once(folder.path(), super::load().2).await;
    }
}

/// Lets the services of a folder serve a PostgreSQL database: in the long form that of a server of its own, which waits for its disk as SQLite does.
fn use_postgresql(folder: &Path) -> Option<PostgresServer> {
    if !is_long() {
        tests::use_postgresql(folder);
        return None;
    }
    let server = PostgresServer::start(&["max_connections=200"]);
    tests::use_database(folder, &server.new_database());
    Some(server)
}

/// Lets workers of some services solve jobs, kills a service meanwhile, and checks what is recorded.
async fn solved_once(folder: &Path, services: usize) {
    let (jobs, count, _) = load();
    let mut services: Vec<_> = (0..services)
        .map(|_| Server::without_workers(folder, &ATTEMPTS))
        .collect();
    let ids = submitted(&services[0], jobs).await;
    let done = Arc::new(Done::default());
    let began = Instant::now();
    let addresses: Vec<_> = services.iter().map(|server| &server.base[..]).collect();
    let harm = if is_long() {
        Harm::None
    } else {
        Harm::LostWorkers
    };
    let workers = started(folder, &addresses, (count, harm), &done);
    if !is_long() {
        let killed = services.remove(0);
        services.insert(0, restarted(folder, killed, &ids).await);
    }
    let claims: Vec<Duration> = workers.join_all().await.concat();
    let elapsed = done.last_end() - began;
    let server = services.last().expect("one");
    assert_once(server, &ids, &done).await;
    if is_long() {
        report(jobs, elapsed, claims);
        report_size(server, jobs).await;
    }
}

/// Checks that every job has succeeded, is recorded once an attempt, and that only vanished workers cost attempts.
async fn assert_once(server: &Server, ids: &[String], done: &Done) {
    let checks = stream::iter(ids).map(async |id| {
        let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
        assert_eq!(job["status"], "succeeded", "{job}");
        let tries = job["attempts"].as_u64().expect("a number");
        let solved = bits::events(server, id, "cycle").await;
        let least = usize::from(!*ENDS_ONLY);
        let range = least..=usize::try_from(tries).expect("small");
        assert!(
            range.contains(&solved.len()),
            "{id} is recorded once an attempt: {solved:?}"
        );
        tries
    });
    let attempts: Vec<u64> = checks.buffered(AT_ONCE).collect().await;
    let lost = u64::from(done.lost.load(Ordering::Relaxed));
    let expected = u64::try_from(ids.len()).expect("small") + lost;
    let attempts: u64 = attempts.iter().sum();
    assert_eq!(attempts, expected, "only vanished workers cost attempts");
}

/// Submits jobs, several at the same time; returns their ids.
async fn submitted(server: &Server, jobs: usize) -> Vec<String> {
    let submissions = stream::iter(0..jobs).map(async |_| {
        let (status, job) = server.submit(SPEC).await;
        assert_eq!(status, 202, "{job}");
        job["id"].as_str().expect("an id").to_owned()
    });
    submissions.buffered(AT_ONCE).collect().await
}

/// Kills the service once some jobs have ended, and starts it again.
async fn restarted(folder: &Path, server: Server, ids: &[String]) -> Server {
    let fifth = &ids[ids.len() / 5];
    server
        .job_when(fifth, |job| job["finished_at"].is_string())
        .await;
    let address = server.base.trim_start_matches("http://").to_owned();
    server.signal(Signal::SIGKILL);
    server.wait();
    let options = [&ATTEMPTS[..], &["--listen", &address]].concat();
    Server::without_workers(folder, &options)
}

/// Prints rates and times.
#[expect(clippy::print_stdout, reason = "the long form prints a table")]
fn report(jobs: usize, elapsed: Duration, mut claims: Vec<Duration>) {
    claims.sort_unstable();
    let at = |hundredths: usize| claims[(claims.len() - 1) * hundredths / 100];
    let rate = f64::from(u32::try_from(jobs).expect("small")) / elapsed.as_secs_f64();
    println!(
        "{jobs} jobs, {rate:.0} claims and ends a second; claims p50 {:?}, p99 {:?}",
        at(50),
        at(99)
    );
}

/// Prints the size of the database.
#[expect(clippy::print_stdout, reason = "the long form prints a table")]
async fn report_size(server: &Server, jobs: usize) {
    let (_, metrics) = server.get("/metrics").await;
    let mut lines = metrics.as_str().expect("a text").lines();
    let bytes = lines.find_map(|line| line.strip_prefix("fretwear_database_size_bytes "));
    let bytes: f64 = bytes.expect("a gauge").parse().expect("a number");
    let jobs = f64::from(u32::try_from(jobs).expect("small"));
    println!("{:.0} bytes of the database a job", bytes / jobs);
}
