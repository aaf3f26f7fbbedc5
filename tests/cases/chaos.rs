//! Requirement: whatever is killed, stopped, filled or damaged at any moment, every accepted job is terminal exactly
//! once, no stale lease is held, event ids have no gaps, and every result has the bits of an uninterrupted run.
//!
//! The short form runs with every test. The long one:
//! `cargo test --release -p tests --test cases -- --ignored --nocapture chaos_long`, with `FRETWEAR_CHAOS_JOBS` (200)
//! and `FRETWEAR_CHAOS_SEED` to choose.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use fastrand::Rng;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::{Value, json};
use tests::{Disk, Server, bits, database};

const OPTIONS: [&str; 10] = [
    "--workers",
    "2",
    "--lease-s",
    "1",
    "--checkpoint-every-s",
    "0",
    "--attempts",
    "1000",
    "--least-free-disk-mb",
    "0",
];
/// Longer than a lease of the service above.
const PAST_A_LEASE: Duration = Duration::from_millis(1_500);
/// Size of the disk that is filled up: empty, and for the results of a job, MB.
const DISK_MB: (usize, usize) = (64, 2);
/// Largest number of queued and running jobs, so that submissions are interrupted too.
const AHEAD: usize = 12;

/// A fault that is injected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fault {
    KillChild,
    PauseChild,
    TerminateChild,
    KillServer,
    KillServerAndDamageCheckpoints,
    StopServer,
    PauseServer,
    StallStore,
    FillDisk,
}

const FAULTS: [Fault; 9] = [
    Fault::KillChild,
    Fault::PauseChild,
    Fault::TerminateChild,
    Fault::KillServer,
    Fault::KillServerAndDamageCheckpoints,
    Fault::StopServer,
    Fault::PauseServer,
    Fault::StallStore,
    Fault::FillDisk,
];

/// The specifications of the jobs, in rotation.
fn specs() -> Vec<Value> {
    let spec = |kind: &str, cycles: u64, jump: u64| {
        json!({
            "system": {"kind": kind},
            "cycles": cycles,
            "accuracy": {"preset": "draft", "overrides": {"cycle_jump": jump}},
            "output": {"snapshots_at_cycles": [1, cycles]}
        })
    };
    vec![
        spec("fuzz_button", 30, 1),
        spec("cylinder_on_flat", 12_000, 60),
        // The block loses so much height that the mesh is moved.
        spec("fuzz_button", 700, 20),
        spec("dimm", 40, 1),
    ]
}

/// A service under fault injection, and the jobs submitted to it.
struct Trial {
    disk: Disk,
    folder: PathBuf,
    server: Option<Server>,
    rng: Rng,
    accepted: Vec<String>,
    faults: BTreeMap<Fault, u32>,
}

impl Trial {
    fn new(jobs: usize, seed: u64) -> Self {
        let disk = Disk::new(DISK_MB.0 + DISK_MB.1 * jobs);
        let folder = disk.path().to_owned();
        Self {
            server: Some(Server::start_with(&folder, &OPTIONS)),
            disk,
            folder,
            rng: Rng::with_seed(seed),
            accepted: Vec::new(),
            faults: BTreeMap::new(),
        }
    }

    fn server(&self) -> &Server {
        self.server.as_ref().expect("the service runs")
    }

    /// Submits the next job with an idempotency key, so that the request can be repeated.
    async fn submit(&mut self, specs: &[Value]) {
        let number = self.accepted.len();
        let server = self.server();
        let request = server
            .client
            .post(format!("{}/v1/jobs", server.base))
            .header("content-type", "application/json")
            .header("idempotency-key", format!("chaos-{number}"))
            .body(specs[number % specs.len()].to_string());
        let Ok(response) = request.send().await else {
            return;
        };
        if response.status() == 202 {
            let job: Value = response.json().await.expect("a job");
            self.accepted
                .push(job["id"].as_str().expect("an id").to_owned());
        }
    }

    /// Number of accepted jobs that have not ended.
    async fn open(&self) -> usize {
        let (_, list) = self
            .server()
            .get("/v1/jobs?status=queued,running&limit=500")
            .await;
        list["jobs"].as_array().map_or(0, Vec::len)
    }

    async fn inject_fault(&mut self) {
        let fault = FAULTS[self.rng.usize(..FAULTS.len())];
        if fault == Fault::FillDisk && !self.disk.is_mounted() {
            return;
        }
        *self.faults.entry(fault).or_default() += 1;
        let moment = Duration::from_millis(self.rng.u64(..1_500));
        match fault {
            Fault::KillChild => {
                self.signal_child(Signal::SIGKILL);
            }
            Fault::TerminateChild => {
                self.signal_child(Signal::SIGTERM);
            }
            Fault::PauseChild => {
                let paused = self.signal_child(Signal::SIGSTOP);
                tokio::time::sleep(PAST_A_LEASE).await;
                if let Some(child) = paused {
                    // It may have ended meanwhile.
                    let _ = kill(child, Signal::SIGCONT);
                }
                return;
            }
            Fault::KillServer => self.restart(Signal::SIGKILL, false).await,
            Fault::KillServerAndDamageCheckpoints => self.restart(Signal::SIGKILL, true).await,
            Fault::StopServer => self.restart(Signal::SIGTERM, false).await,
            Fault::PauseServer => {
                self.server().signal(Signal::SIGSTOP);
                tokio::time::sleep(PAST_A_LEASE + moment).await;
                self.server().signal(Signal::SIGCONT);
                return;
            }
            Fault::StallStore => database::stall(&self.folder, moment * 3).await,
            Fault::FillDisk => self.disk.fill_for(moment).await,
        }
        tokio::time::sleep(moment).await;
    }

    /// Signals one solving process, if there is any.
    fn signal_child(&mut self, signal: Signal) -> Option<Pid> {
        let children = self.server().solving();
        let child = self.rng.choice(children)?;
        // It may have ended by itself.
        let _ = kill(child, signal);
        Some(child)
    }

    async fn restart(&mut self, signal: Signal, damage: bool) {
        let server = self.server.take().expect("the service runs");
        server.signal(signal);
        server.wait();
        if damage {
            database::damage_checkpoints(&self.folder).await;
        }
        self.server = Some(Server::start_with(&self.folder, &OPTIONS));
    }
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

#[expect(clippy::print_stdout, reason = "the figures that the README quotes")]
async fn chaos(jobs: usize, seed: u64) {
    let began = Instant::now();
    let specs = specs();
    let expected = uninterrupted(&specs).await;
    let mut trial = Trial::new(jobs, seed);
    loop {
        let open = trial.open().await;
        if trial.accepted.len() == jobs && open == 0 {
            break;
        }
        for _ in open..AHEAD {
            if trial.accepted.len() < jobs {
                trial.submit(&specs).await;
            }
        }
        trial.inject_fault().await;
    }
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
    check_database(&trial.folder, jobs).await;
    println!(
        "chaos, seed {seed}: {jobs} jobs, {attempts} attempts, {resumed} of them from a checkpoint, {:?}{}, {:.0} s: \
         every job ended once with the bits of an uninterrupted run",
        trial.faults,
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
        (
            "SELECT count(*) FROM jobs WHERE last_event <> (SELECT count(*) FROM events WHERE job_id = id)",
            0,
        ),
        (
            "SELECT count(*) FROM jobs WHERE last_event <> (SELECT max(seq) FROM events WHERE job_id = id)",
            0,
        ),
    ] {
        let found = database::number(folder, query).await;
        assert_eq!(usize::try_from(found), Ok(expected), "{query}");
    }
}

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

#[tokio::test]
async fn chaos_short() {
    chaos(6, 7).await;
}

#[tokio::test]
#[ignore = "takes minutes; run it by name"]
async fn chaos_long() {
    let jobs = number("FRETWEAR_CHAOS_JOBS").unwrap_or(200);
    let seed = number("FRETWEAR_CHAOS_SEED").unwrap_or(1);
    chaos(usize::try_from(jobs).expect("a count"), seed).await;
}
