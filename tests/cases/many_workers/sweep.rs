//! A sweep of more jobs than wait in the queue at once, which follow while others are solved.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use nix::sys::signal::Signal;
use serde_json::{Value, json};
use tests::Server;

use super::simulated::{Done, Harm, started};
use super::{ATTEMPTS, SPEC, is_long, load, report, report_size, use_postgresql};

/// Jobs of the sweep that wait at most in the short form.
const AHEAD: u64 = 60;
/// Jobs of the short form: more than a sweep queues at once.
const JOBS: usize = 1_004;
/// Jobs of such a sweep that are queued when it is submitted.
const AT_ONCE: u64 = 250;

/// Parameters that the sweep varies.
const CYCLES: [u32; 4] = [2, 3, 4, 5];
const COEFFICIENT: &str = "/interface/friction/coefficient";
const AMPLITUDE: &str = "/motion/amplitude_mm";
/// Values of the coefficient at most.
const COEFFICIENTS: usize = 10_000;

/// Longest wait, also of the long form; not a measure of speed.
const PATIENCE: Duration = Duration::from_hours(2);

#[tokio::test(flavor = "multi_thread")]
async fn every_job_of_a_large_sweep_is_solved_once_although_the_service_is_killed() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    solved_once(folder.path(), 1).await;
}

#[tokio::test(flavor = "multi_thread")]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn two_services_queue_every_job_of_a_large_sweep_once() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let _server = use_postgresql(folder.path());
    solved_once(folder.path(), 2).await;
}

async fn solved_once(folder: &Path, services: usize) {
    let (jobs, count) = if is_long() {
        (load().0, load().1)
    } else {
        (JOBS, 30)
    };
    let ahead = AHEAD.to_string();
    let objects = format!("file://{}", folder.join("objects").display());
    let options = if is_long() {
        [&ATTEMPTS[..], &["--objects", &objects]].concat()
    } else {
        [&ATTEMPTS[..], &["--jobs-ahead", &ahead]].concat()
    };
    let mut services: Vec<_> = (0..services)
        .map(|_| Server::without_workers(folder, &options))
        .collect();
    let began = Instant::now();
    let sweep = submitted(&services[0], jobs).await;
    if is_long() {
        say(&format!("accepted after {:?}", began.elapsed()));
    }
    let path = format!("/v1/sweeps/{}", sweep["id"].as_str().expect("an id"));
    let (began, done) = (Instant::now(), Arc::new(Done::default()));
    let addresses: Vec<_> = services.iter().map(|server| &server.base[..]).collect();
    let workers = started(folder, &addresses, (count, Harm::None), &done);
    let half = u64::try_from(jobs / 2).expect("small");
    let half_solved = async {
        loop {
            let (_, sweep) = services[0].get(&format!("{path}?limit=1")).await;
            let waiting = number(&sweep["counts"]["queued"]);
            assert!(is_long() || waiting <= AT_ONCE.max(AHEAD), "{waiting} wait");
            if number(&sweep["counts"]["succeeded"]) >= half {
                return;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
    };
    let half_solved = tokio::time::timeout(PATIENCE, half_solved).await;
    half_solved.expect("half of the jobs are solved in time");
    let killed = services.remove(0);
    let address = killed.base.trim_start_matches("http://").to_owned();
    killed.signal(Signal::SIGKILL);
    killed.wait();
    let options = [&options[..], &["--listen", &address]].concat();
    services.push(Server::without_workers(folder, &options));
    let claims = tokio::time::timeout(PATIENCE, workers.join_all()).await;
    let claims: Vec<Duration> = claims.expect("all are solved in time").concat();
    let elapsed = began.elapsed();
    for server in &services {
        assert_whole(server, &path, jobs).await;
    }
    if is_long() {
        report(jobs, elapsed, claims);
        moved(&services[0]).await;
        say(&format!("results are objects after {:?}", began.elapsed()));
        report_size(&services[0], jobs).await;
    }
}

/// Waits until no results are to be moved into objects.
async fn moved(server: &Server) {
    let moved = async {
        loop {
            let (_, metrics) = server.get("/metrics").await;
            let mut lines = metrics.as_str().expect("a text").lines();
            if lines.any(|line| line == "fretwear_results_to_move 0") {
                return;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
    };
    let moved = tokio::time::timeout(PATIENCE, moved).await;
    moved.expect("results are moved in time");
}

/// The values of a sweep of so many jobs: 4 000 000 at most.
fn axes(jobs: usize) -> [Vec<f64>; 2] {
    let each = jobs / CYCLES.len();
    let coefficients = each.min(COEFFICIENTS);
    let values = |count: usize, first: f64, step: f64| {
        let numbers = 0..u32::try_from(count).expect("small");
        let values = numbers.map(|n| first + step * f64::from(n));
        values.collect()
    };
    [
        values(coefficients, 0.2, 1e-6),
        values(each / coefficients, 0.02, 1e-4),
    ]
}

/// Submits a sweep of so many jobs.
pub(super) async fn submitted(server: &Server, jobs: usize) -> Value {
    let base: Value = serde_json::from_str(SPEC).expect("JSON");
    let [coefficients, amplitudes] = axes(jobs);
    let grid = json!({"/cycles": CYCLES, COEFFICIENT: coefficients, AMPLITUDE: amplitudes});
    let request = json!({"name": "large", "base": base, "grid": grid});
    let (status, sweep) = server.post_json("/v1/sweeps", &request).await;
    assert_eq!(status, 202);
    sweep
}

/// Checks that each job of a sweep has succeeded at its first attempt, with its own changes, and has a row in the table.
async fn assert_whole(server: &Server, path: &str, jobs: usize) {
    let (mut part, mut seen, mut ids) = (path.to_owned(), 0, BTreeSet::new());
    loop {
        let (_, sweep) = server.get(&part).await;
        for job in sweep["jobs"].as_array().expect("jobs") {
            assert_eq!(number(&job["position"]), seen);
            assert_eq!(job["status"], "succeeded", "{job}");
            let id = job["id"].as_str().expect("an id").to_owned();
            assert!(ids.insert(id), "{job}");
            seen += 1;
        }
        let Some(next) = sweep["links"]["next"].as_str() else {
            let all = u64::try_from(jobs).expect("small");
            assert_eq!(number(&sweep["counts"]["succeeded"]), all);
            assert_eq!((number(&sweep["asked"]), seen), (all, all));
            assert_eq!(sweep["to_come"], 0);
            break;
        };
        next.clone_into(&mut part);
    }
    let (_, table) = server.get(&format!("{path}/outcomes")).await;
    let table = table.as_str().expect("CSV");
    let rows: BTreeSet<_> = table.lines().skip(1).map(|row| &row[..36]).collect();
    assert!(rows.iter().all(|id| ids.contains(*id)), "{table}");
    assert_eq!((rows.len(), table.lines().count()), (jobs, jobs + 1));
    let (_, last) = server.get(&format!("{path}?from={}", jobs - 1)).await;
    let [coefficients, amplitudes] = axes(jobs);
    let overrides =
        json!({"/cycles": 5, COEFFICIENT: coefficients.last(), AMPLITUDE: amplitudes.last()});
    assert_eq!(last["jobs"][0]["overrides"], overrides);
}

#[expect(clippy::print_stdout, reason = "the long form prints figures")]
pub(super) fn say(text: &str) {
    println!("{text}");
}

pub(super) fn number(value: &Value) -> u64 {
    value.as_u64().expect("a number")
}
