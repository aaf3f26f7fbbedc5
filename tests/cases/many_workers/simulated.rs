//! Simulated workers: they claim, record and end over HTTP as real ones do, and solve nothing.

use std::path::Path;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock, Mutex};
use std::time::{Duration, Instant};

use fastrand::Rng;
use server::client::Client;
use server::export::documents::CSV;
use server::export::files::manifest_entry;
use server::queue::{Capacity, MemoryBudget, Transition};
use server::store::block::{Block, EncodedBlock};
use server::store::{
    Claim, ClaimRequest, End, EventName, JobUpdate, Lease, LeaseState, RequestNumber,
};
use server::worker::{JobSource, JobSourceError, Remote, RemoteOptions};
use tokio::task::JoinSet;
use uuid::Uuid;

use super::asked;

/// Length of a lease where workers vanish: their jobs are soon given to others.
const SHORT_LEASE: Duration = Duration::from_secs(10);
/// Length of one where none does: longer than anything is away, also on a busy machine.
const LONG_LEASE: Duration = Duration::from_mins(1);
/// How long a claim waits for a job.
const WAIT: Duration = Duration::from_secs(2);
/// Pause before a request without an answer is repeated.
const PAUSE: Duration = Duration::from_millis(100);

/// Counts of the workers' attempts and ends.
#[derive(Default)]
pub(super) struct Done {
    /// Attempts of workers that have vanished, or that the machine did not let renew their lease in time.
    pub(super) lost: AtomicU32,
    /// Jobs that they have ended.
    ended: AtomicUsize,
    /// Number of them after which no more are claimed.
    enough: Option<usize>,
    /// When the last job ended.
    last_end: Mutex<Option<Instant>>,
}

impl Done {
    /// Of workers that claim no more once so many jobs have ended.
    pub(super) fn of(enough: usize) -> Self {
        Self {
            enough: Some(enough),
            ..Self::default()
        }
    }

    /// Number of jobs that have ended.
    pub(super) fn ended(&self) -> usize {
        self.ended.load(Ordering::Relaxed)
    }

    fn is_enough(&self) -> bool {
        self.enough.is_some_and(|enough| self.ended() >= enough)
    }

    /// When the last job ended; now if none has.
    pub(super) fn last_end(&self) -> Instant {
        let last = *self.last_end.lock().expect("no panic");
        last.unwrap_or_else(Instant::now)
    }
}

/// Faults of workers at random.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Harm {
    None,
    /// Answers are lost, so that requests are repeated.
    LostAnswers,
    /// Workers vanish with their jobs, too.
    LostWorkers,
}

impl Harm {
    fn lease(self) -> Duration {
        if self == Self::LostWorkers {
            SHORT_LEASE
        } else {
            LONG_LEASE
        }
    }
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
    harm: Harm,
    /// Jobs that it claims at once.
    bundle: usize,
}

impl Simulated {
    /// Works until no job waits or runs, or enough have ended.
    async fn work(mut self) -> Vec<Duration> {
        while !self.done.is_enough() {
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
        self.claims
    }

    /// Repeats a request until it is answered, and then once more at random: its answer was lost.
    async fn answered<T, F: Future<Output = Result<T, JobSourceError>>>(
        &mut self,
        request: impl Fn() -> F,
    ) -> T {
        let mut is_lost = self.harm != Harm::None && self.random.u8(..5) == 0;
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
                slots: self.bundle,
                memory: MemoryBudget {
                    memory_mb: 10_000,
                    used_mb: 0,
                    running: 0,
                },
                is_one_of_several: true,
                ahead_ms: 0,
            },
            lease: self.harm.lease(),
            token: None,
        };
        let (began, remote) = (Instant::now(), Arc::clone(&self.remote));
        let claims = self.answered(|| remote.claim(&request)).await;
        if !claims.is_empty() {
            self.claims.push(began.elapsed());
        }
        claims
    }

    async fn solve(&mut self, claim: &Claim) {
        if self.harm == Harm::LostWorkers && self.random.u8(..20) == 0 {
            self.done.lost.fetch_add(1, Ordering::Relaxed);
            // A worker that has vanished renews nothing.
            self.remote.abandon(claim.into());
            return;
        }
        let (lease, remote) = (Lease::from(claim), Arc::clone(&self.remote));
        let length = self.harm.lease();
        let update = JobUpdate {
            number: 1,
            events: vec![(EventName::Cycle, format!("{{\"lease\":{}}}", claim.lease))],
            ..JobUpdate::default()
        };
        if !*ENDS_ONLY {
            let recorded = self
                .answered(|| remote.record(lease, &update, length))
                .await;
            if recorded == LeaseState::Lost {
                self.done.lost.fetch_add(1, Ordering::Relaxed);
                return;
            }
        }
        let last = JobUpdate {
            number: 2,
            block: Some(DOCUMENTS.clone()),
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
            Some(status) => {
                assert_eq!(status.as_str(), "succeeded");
                self.done.ended.fetch_add(1, Ordering::Relaxed);
                *self.done.last_end.lock().expect("no panic") = Some(Instant::now());
            }
            None => drop(self.done.lost.fetch_add(1, Ordering::Relaxed)),
        }
    }
}

/// Documents as a worker makes them of a run.
static DOCUMENTS: LazyLock<EncodedBlock> = LazyLock::new(|| {
    let mut block = Block::default();
    let table = b"cycle,depth\n1,2\n";
    let entry = manifest_entry("wear-history.csv", None, CSV, table);
    assert!(block.push_history(&[], &[]).expect("JSON") && block.push_document(&entry, table));
    block.encode().expect("JSON")
});

/// True if workers record nothing between claim and end.
pub(super) static ENDS_ONLY: LazyLock<bool> =
    LazyLock::new(|| std::env::var_os("FRETWEAR_WORKERS_ENDS_ONLY").is_some());

/// Starts workers, several in a process, which is for one of the services.
pub(super) fn started(
    folder: &Path,
    services: &[&str],
    (count, harm): (usize, Harm),
    done: &Arc<Done>,
) -> JoinSet<Vec<Duration>> {
    let client = |server: &&str| Client::new(server, None, None).expect("a client");
    let clients: Vec<_> = services.iter().map(client).collect();
    let slots = asked("FRETWEAR_WORKERS_SLOTS", 4);
    let bundle = asked("FRETWEAR_WORKERS_BUNDLE", 1);
    let remote = |number: usize| {
        let client = clients[number % clients.len()].clone();
        Arc::new(Remote::new(RemoteOptions {
            client,
            worker: Uuid::now_v7(),
            health: Arc::default(),
            slots,
            scratch: folder.to_owned(),
            lease: harm.lease(),
            wait: WAIT,
        }))
    };
    let processes: Vec<_> = (0..count.div_ceil(slots)).map(remote).collect();
    (0..count)
        .map(|number| Simulated {
            remote: Arc::clone(&processes[number / slots]),
            id: Uuid::now_v7(),
            number: 0,
            random: Rng::with_seed(u64::try_from(number).expect("small")),
            done: Arc::clone(done),
            claims: Vec::new(),
            harm,
            bundle,
        })
        .map(Simulated::work)
        .collect()
}
