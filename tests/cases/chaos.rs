//! Requirement: whatever is killed, stopped, filled, damaged, stepped or flooded at any moment, every accepted job is terminal
//! exactly once, no stale lease is held, event ids have no gaps, and every result has the bits of an uninterrupted run.
//!
//! The short form runs with every test. The long one:
//! `cargo test --release -p tests --test cases -- --ignored --nocapture --exact chaos::chaos_long`, `chaos::chaos_long_of_postgresql` or `chaos::chaos_long_of_two_services`,
//! with `FRETWEAR_CHAOS_JOBS` (1 000) and `FRETWEAR_CHAOS_SEED` to choose.

mod faults;
mod trial;

use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tests::{Server, address_of_database, bare_preset, bits, database, fretwear, merged};

use faults::files_below;
use trial::{Engine, Trial};

/// Largest number of queued and running jobs in the short form and in the long one: some, so that submissions are interrupted too.
const AHEAD: (usize, usize) = (12, 60);
/// Longest wait until results are moved; not a measure of speed.
const PATIENCE: Duration = Duration::from_mins(5);
/// Most jobs beyond those that are asked for, until every fault was injected: the disk holds the results of all of them.
const MOST_MORE: usize = 60;

/// The specifications of the jobs, in rotation.
fn specs() -> Vec<Value> {
    let spec = |kind: &str, cycles: u64, jump: u64| {
        let length = json!({
            "cycles": cycles,
            "accuracy": {"preset": "draft", "overrides": {"cycle_jump": jump}},
            "output": {"snapshots_at_cycles": [1, cycles]}
        });
        merged(bare_preset(kind), length)
    };
    let mut plated = spec("dimm", 40, 1);
    plated["interface"] = json!({});
    let mut with_fields = spec("cylinder_on_flat", 20, 1);
    with_fields["output"]["fields"] = true.into();
    vec![
        with_fields,
        spec("fuzz_button", 30, 1),
        spec("cylinder_on_flat", 12_000, 60),
        // The block loses so much height that the mesh is moved.
        spec("fuzz_button", 700, 20),
        spec("dimm", 40, 1),
        plated,
    ]
}

/// The bits of each specification in an uninterrupted run.
async fn uninterrupted(specs: &[Value]) -> Vec<Value> {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let mut found = Vec::new();
    for spec in specs {
        let (_, job) = server.submit(spec.to_string()).await;
        let id = job["id"].as_str().expect("a job has an id").to_owned();
        server
            .job_when(&id, |job| job["finished_at"].is_string())
            .await;
        found.push(bits::of(&server, &id).await);
    }
    found
}

/// Solves at least so many jobs, and injects every fault at least once.
#[expect(clippy::print_stdout, reason = "the figures that the book quotes")]
async fn chaos(engine: Engine, least_jobs: usize, seed: u64) {
    let began = Instant::now();
    let specs = specs();
    let expected = uninterrupted(&specs).await;
    let ahead = least_jobs.clamp(AHEAD.0, AHEAD.1);
    let most_jobs = least_jobs + MOST_MORE;
    let mut trial = Trial::new(engine, most_jobs, seed);
    loop {
        let open = trial.open().await;
        let is_last = trial.accepted.len() >= least_jobs && trial.had_every_fault();
        if is_last && open == 0 {
            break;
        }
        if !is_last {
            let room = most_jobs.saturating_sub(trial.accepted.len());
            for _ in 0..ahead.saturating_sub(open).min(room) {
                trial.submit(&specs).await;
            }
        }
        trial.inject_fault().await;
    }
    let jobs = trial.accepted.len();
    // A failure that no task has met would hit the requests below.
    trial.clock.forget_failure();
    let (mut attempts, mut resumed) = (0, 0);
    for (number, id) in trial.accepted.iter().enumerate() {
        let server = trial.server();
        let found = bits::of(server, id).await;
        assert_eq!(
            found,
            expected[number % specs.len()],
            "seed {seed}, job {number}"
        );
        assert_eq!(bits::events(server, id, "done").await.len(), 1);
        let began = bits::events(server, id, "attempt").await;
        attempts += began.len();
        resumed += began.iter().filter(|a| a["from_cycle"] != 0).count();
    }
    match engine {
        Engine::File => {
            check_database(&trial.folder, jobs).await;
            check_events(&trial.folder).await;
            check_file(&trial.folder).await;
            check_results(&trial.folder, &[]);
        }
        Engine::Server => {
            check_database(&trial.folder, jobs).await;
            check_events(&trial.folder).await;
            check_results(&trial.folder, &[]);
        }
        Engine::Services => {
            check_database(&trial.folder, jobs).await;
            check_objects(&trial).await;
            let objects = format!("file://{}", trial.results.display());
            check_results(&trial.folder, &["--objects", &objects]);
        }
    }
    trial.count_all_failed_tasks().await;
    println!(
        "chaos, {engine:?}, seed {seed}: {jobs} jobs, {attempts} attempts, {resumed} of them from a checkpoint, {} faults {:?}, {} tasks \
         failed, starts by log {:?}{}, {:.0} s: every job ended once with the bits of an uninterrupted run",
        trial.faults.values().sum::<u32>(),
        trial.faults,
        trial.failed_tasks,
        trial.logs,
        if trial.disk.is_mounted() {
            ""
        } else {
            " (no disk of its own could be mounted)"
        },
        began.elapsed().as_secs_f64()
    );
}

async fn check_database(folder: &Path, jobs: usize) {
    for (query, expected) in [
        ("SELECT count(*) FROM jobs", jobs),
        ("SELECT count(*) FROM jobs WHERE finished_at IS NULL", 0),
        (
            "SELECT count(*) FROM jobs WHERE lease_expires_at IS NOT NULL",
            0,
        ),
        ("SELECT count(*) FROM checkpoints", 0),
        ("SELECT count(*) FROM events WHERE name = 'done'", jobs),
    ] {
        let found = database::number(folder, query).await;
        assert_eq!(usize::try_from(found), Ok(expected), "{query}");
    }
}

/// Checks the events of all jobs; of those whose results are objects, only the last ones are in the database.
async fn check_events(folder: &Path) {
    for query in [
        "SELECT count(*) FROM jobs WHERE last_event <> (SELECT count(*) FROM events WHERE job_id = id)",
        "SELECT count(*) FROM jobs WHERE last_event <> (SELECT max(seq) FROM events WHERE job_id = id)",
    ] {
        assert_eq!(database::number(folder, query).await, 0, "{query}");
    }
}

/// Checks that all results have become objects that can be read, and that no object is left which nothing names and nobody will remove.
async fn check_objects(trial: &Trial) {
    let began = Instant::now();
    let left = "SELECT count(*) FROM result_blocks WHERE object IS NULL";
    while database::number(&trial.folder, left).await > 0 {
        assert!(began.elapsed() < PATIENCE, "results are moved");
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    for id in &trial.accepted {
        let archive = format!("/v1/jobs/{id}/results/archive");
        trial.server().bytes_in_the_end(&archive).await;
    }
    let known = "SELECT object FROM result_blocks UNION SELECT object FROM checkpoints WHERE object IS NOT NULL \
        UNION SELECT object FROM result_files WHERE object IS NOT NULL UNION SELECT key FROM unnamed_objects";
    let mut known = database::texts(&trial.folder, known).await;
    known.push("fretwear-objects".to_owned());
    for path in files_below(&trial.results) {
        let key = path.strip_prefix(&trial.results).expect("below it");
        // A folder has an object under another name, `KEY#1`, until it is whole: one that a kill has interrupted stays.
        let key = key.to_str().expect("a key");
        let key = key.split_once('#').map_or(key, |(key, _)| key);
        assert!(known.iter().any(|known| known == key), "{key}");
    }
}

/// Checks what only a file has.
async fn check_file(folder: &Path) {
    let wrong = "SELECT count(*) FROM job_counts WHERE jobs <> (SELECT count(*) FROM jobs WHERE jobs.status = job_counts.status)";
    assert_eq!(database::number(folder, wrong).await, 0);
}

/// Checks that no result is damaged.
fn check_results(folder: &Path, options: &[&str]) {
    let database = address_of_database(folder);
    let command = ["verify", "--database", &database];
    let verified = fretwear(folder, &[&command[..], options].concat());
    let said = (verified.stdout, verified.stderr);
    assert_eq!(verified.code, Some(0), "{said:?}");
}

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

#[tokio::test]
#[cfg_attr(
    not(all(has_cc, has_mount)),
    ignore = "needs a C compiler and the right to mount a disk; the next test is without full disks"
)]
async fn chaos_short() {
    chaos(Engine::File, 6, 7).await;
}

#[tokio::test]
#[cfg_attr(
    any(not(has_cc), has_mount),
    ignore = "needs a C compiler; without full disks where one can be mounted"
)]
async fn chaos_short_without_full_disks() {
    chaos(Engine::File, 6, 7).await;
}

#[tokio::test]
#[cfg_attr(
    not(all(has_cc, has_mount, has_postgresql)),
    ignore = "needs PostgreSQL, a C compiler and the right to mount a disk"
)]
async fn chaos_short_of_postgresql() {
    chaos(Engine::Server, 6, 7).await;
}

#[tokio::test]
#[cfg_attr(
    not(all(has_cc, has_mount, has_postgresql)),
    ignore = "needs PostgreSQL, a C compiler and the right to mount a disk"
)]
async fn chaos_short_of_two_services() {
    chaos(Engine::Services, 6, 7).await;
}

mod night {
    use super::{Engine, long};

    #[tokio::test]
    #[ignore = "night: takes minutes"]
    async fn chaos() {
        long(Engine::File).await;
    }

    #[tokio::test]
    #[ignore = "night: takes minutes"]
    async fn chaos_of_postgresql() {
        long(Engine::Server).await;
    }

    #[tokio::test]
    #[ignore = "night: takes minutes"]
    async fn chaos_of_two_services() {
        long(Engine::Services).await;
    }
}

async fn long(engine: Engine) {
    let jobs = number("FRETWEAR_CHAOS_JOBS").unwrap_or(1_000);
    let seed = number("FRETWEAR_CHAOS_SEED").unwrap_or(1);
    chaos(engine, usize::try_from(jobs).expect("a count"), seed).await;
}
