//! Requirement: many remote workers share the jobs of a service: each is solved, none is recorded twice, and a request that is
//! repeated because its answer was lost costs no attempt, also if the service is killed meanwhile.
//!
//! The workers are simulated: they claim, record and end over HTTP as real ones do, and solve nothing. The short form runs with all
//! cases. The long one prints jobs per second and the times of claims:
//!
//!     FRETWEAR_WORKERS_LOAD=10000,1000 cargo test --release -p tests many_workers -- --nocapture

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use fastrand::Rng;
use nix::sys::signal::Signal;
use server::client::Client;
use server::export::documents::CSV;
use server::export::files::manifest_entry;
use server::queue::{Capacity, MemoryBudget, Transition};
use server::store::block::{Block, EncodedBlock};
use server::store::{
    Claim, ClaimRequest, End, EventName, JobUpdate, Lease, LeaseState, RequestNumber,
};
use server::worker::{Employer, EmployerError, Remote};
use tests::{Server, bits};
use tokio::task::JoinSet;
use uuid::Uuid;

/// A job whose documents are small.
const SPEC: &str = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":2,
    "accuracy":{"preset":"draft"},"output":{"snapshots_at_cycles":[2]}}"#;
/// Length of a lease: jobs of workers that vanish are soon given to others.
const LEASE: Duration = Duration::from_secs(10);
/// How long a claim waits for a job.
const WAIT: Duration = Duration::from_secs(2);
/// Attempts at a job: more than vanishing workers can use up.
const ATTEMPTS: [&str; 2] = ["--attempts", "20"];
/// Pause before a request without an answer is repeated.
const PAUSE: Duration = Duration::from_millis(100);

/// Number of jobs and workers.
fn load() -> (usize, usize) {
    let asked = std::env::var("FRETWEAR_WORKERS_LOAD").ok();
    let numbers = asked.and_then(|text| {
        let (jobs, workers) = text.split_once(',')?;
        Some((jobs.parse().ok()?, workers.parse().ok()?))
    });
    numbers.unwrap_or((120, 30))
}

/// What the workers have done.
#[derive(Default)]
struct Done {
    /// Attempts of workers that have vanished, or that the machine did not let renew their lease in time.
    lost: AtomicU32,
}

/// A worker that solves nothing.
struct Simulated {
    remote: Arc<Remote>,
    id: Uuid,
    number: i64,
    random: Rng,
    done: Arc<Done>,
    /// Times of claims that got a job.
    claims: Vec<Duration>,
    /// Whether requests are repeated at random, and jobs abandoned.
    is_harmed: bool,
}

impl Simulated {
    /// Works until no job waits or runs.
    async fn work(mut self) -> Vec<Duration> {
        loop {
            let claims = self.claim().await;
            if claims.is_empty() {
                let remote = Arc::clone(&self.remote);
                let idle = self.answered(|| remote.is_idle()).await;
                if idle {
                    return self.claims;
                }
                tokio::time::sleep(PAUSE).await;
            }
            for claim in claims {
                self.solve(&claim).await;
            }
        }
    }

    /// Repeats a request until it is answered, and then once more at random: its answer was lost.
    async fn answered<T, F: Future<Output = Result<T, EmployerError>>>(
        &mut self,
        request: impl Fn() -> F,
    ) -> T {
        let mut is_lost = self.is_harmed && self.random.u8(..5) == 0;
        loop {
            match request().await {
                Ok(answer) if !is_lost => return answer,
                Ok(_) => is_lost = false,
                Err(_) => tokio::time::sleep(PAUSE).await,
            }
        }
    }

    async fn claim(&mut self) -> Vec<Claim> {
        self.number += 1;
        let request = ClaimRequest {
            request: RequestNumber {
                worker: self.id,
                number: self.number,
            },
            is_remote: true,
            capacity: Capacity {
                slots: 1,
                memory: MemoryBudget {
                    memory_mb: 10_000,
                    used_mb: 0,
                    running: 0,
                },
                is_one_of_several: true,
                ahead_ms: 0,
            },
            lease: LEASE,
        };
        let (began, remote) = (Instant::now(), Arc::clone(&self.remote));
        let claims = self.answered(|| remote.claim(&request)).await;
        if !claims.is_empty() {
            self.claims.push(began.elapsed());
        }
        claims
    }

    async fn solve(&mut self, claim: &Claim) {
        if self.is_harmed && self.random.u8(..20) == 0 {
            self.done.lost.fetch_add(1, Ordering::Relaxed);
            // A worker that has vanished renews nothing.
            self.remote.abandon(claim.into());
            return;
        }
        let (lease, remote) = (Lease::from(claim), Arc::clone(&self.remote));
        let update = JobUpdate {
            number: 1,
            events: vec![(EventName::Cycle, format!("{{\"lease\":{}}}", claim.lease))],
            ..JobUpdate::default()
        };
        let recorded = self.answered(|| remote.record(lease, &update, LEASE)).await;
        if recorded == LeaseState::Lost {
            self.done.lost.fetch_add(1, Ordering::Relaxed);
            return;
        }
        let last = JobUpdate {
            number: 2,
            block: Some(documents()),
            ..JobUpdate::default()
        };
        let end = End {
            transition: Transition::Succeed,
            reason: None,
            outcome: None,
            summary: None,
        };
        let ended = self.answered(|| remote.finish(lease, &last, &end)).await;
        match ended {
            Some(status) => assert_eq!(status.as_str(), "succeeded"),
            None => drop(self.done.lost.fetch_add(1, Ordering::Relaxed)),
        }
    }
}

/// Documents as a worker makes them of a run.
fn documents() -> EncodedBlock {
    let mut block = Block::default();
    let table = b"cycle,depth\n1,2\n";
    let entry = manifest_entry("wear-history.csv", None, CSV, table);
    assert!(block.push_history(&[], &[]).expect("JSON") && block.push_document(&entry, table));
    block.encode().expect("JSON")
}

/// Starts workers for a service.
fn started(
    folder: &Path,
    server: &Server,
    count: usize,
    done: &Arc<Done>,
) -> JoinSet<Vec<Duration>> {
    let client = Client::new(&server.base, None, None).expect("a client");
    let is_harmed = std::env::var_os("FRETWEAR_WORKERS_LOAD").is_none();
    (0..count)
        .map(|number| (number, Uuid::now_v7()))
        .map(|(number, id)| Simulated {
            remote: Arc::new(Remote::new(
                (client.clone(), id, 1),
                folder.to_owned(),
                (LEASE, WAIT),
            )),
            id,
            number: 0,
            random: Rng::with_seed(u64::try_from(number).expect("small")),
            done: Arc::clone(done),
            claims: Vec::new(),
            is_harmed,
        })
        .map(Simulated::work)
        .collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn every_job_is_solved_once_although_answers_are_lost_and_the_service_is_killed() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let (jobs, count) = load();
    let server = Server::without_workers(folder.path(), &ATTEMPTS);
    let mut ids = Vec::new();
    for _ in 0..jobs {
        let (status, job) = server.submit(SPEC).await;
        assert_eq!(status, 202, "{job}");
        ids.push(job["id"].as_str().expect("an id").to_owned());
    }
    let done = Arc::new(Done::default());
    let began = Instant::now();
    let workers = started(folder.path(), &server, count, &done);
    let is_long = std::env::var_os("FRETWEAR_WORKERS_LOAD").is_some();
    let server = if is_long {
        server
    } else {
        killed(folder.path(), server, &ids).await
    };
    let claims: Vec<Duration> = workers.join_all().await.concat();
    let elapsed = began.elapsed();
    let mut attempts = 0;
    for id in &ids {
        let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
        assert_eq!(job["status"], "succeeded", "{job}");
        attempts += job["attempts"].as_u64().expect("a number");
        if !is_long {
            let solved = bits::events(&server, id, "cycle").await;
            let tries = usize::try_from(job["attempts"].as_u64().unwrap_or_default());
            let range = 1..=tries.expect("small");
            assert!(
                range.contains(&solved.len()),
                "{id} is recorded once an attempt: {solved:?}"
            );
        }
    }
    let lost = u64::from(done.lost.load(Ordering::Relaxed));
    let expected = u64::try_from(jobs).expect("small") + lost;
    assert_eq!(attempts, expected, "only vanished workers cost attempts");
    if is_long {
        report(jobs, elapsed, claims);
    }
}

/// Kills the service once some jobs have ended, and starts it again.
async fn killed(folder: &Path, server: Server, ids: &[String]) -> Server {
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
