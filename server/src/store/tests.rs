//! The contract of the store over a real database: fencing, contention, reclaiming, restarts.

#[expect(
    unreachable_pub,
    reason = "the file belongs to the crate of the end-to-end cases, too"
)]
#[path = "../../../tests/src/postgres.rs"]
mod postgres;

/// Runs tests on each engine, with a fixture at a place of its own.
macro_rules! on_both_engines {
    ($fixture:ident: $($name:ident,)+) => {
        mod sqlite {
            $(
                #[tokio::test(flavor = "multi_thread", worker_threads = 4)]
                async fn $name() {
                    let place = crate::store::tests::Place::sqlite();
                    super::$name(super::$fixture::at(place).await).await;
                }
            )+
        }

        mod postgres {
            $(
                #[tokio::test(flavor = "multi_thread", worker_threads = 4)]
                #[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
                async fn $name() {
                    let place = crate::store::tests::Place::postgres();
                    super::$name(super::$fixture::at(place).await).await;
                }
            )+
        }
    };
}

mod batches;
mod checkpoint_objects;
mod checkpoints;
mod columns;
mod file_objects;
mod files;
mod leases;
mod lost_commits;
mod notifications;
mod object_names;
mod objects;
mod order;
mod pages;
mod place;
mod retention;
mod roles;
pub(crate) mod sent_specifications;
mod tokens;
mod verification;
mod workers;
mod writes;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicI64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use api::job::{Outcome, Status};
use solver::record::CycleReport;
use sqlx::{Connection, Executor, PgConnection, SqliteConnection};
use tempfile::TempDir;
use tokio::sync::Barrier;
use uuid::Uuid;

use super::*;
use crate::clock::Clock;
use crate::http::tests::row;
use crate::queue::{ATTEMPT_LIMIT, Capacity, MemoryBudget, Transition};
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::spec;

pub(crate) use super::sqlite::tests::{fill_disk, hold_write_lock};
pub(crate) use place::Place;

/// Operations with defaults that only tests use.
impl Store {
    /// Opens a database with default limits.
    pub(crate) async fn open(url: &str) -> Result<Self, StoreError> {
        Self::open_with(url, Path::new("unused"), Limits::default()).await
    }

    /// Queues a job.
    pub(crate) async fn queue(&self, job: &NewJob) -> Uuid {
        let submitted = self.submit(job, None).await.expect("the store");
        let Submitted::Job(id) = submitted else {
            panic!("there is no key");
        };
        id
    }

    /// Claims the first job in the order of the queue, whatever memory it needs.
    pub(crate) async fn claim_next(&self, expires_at: i64) -> Option<Claim> {
        self.claim_within(i64::MAX, expires_at).await
    }

    /// Claims the first job that needs no more than this memory, MB.
    pub(crate) async fn claim_within(&self, memory_mb: i64, expires_at: i64) -> Option<Claim> {
        let claims = self
            .claim(&request(memory_mb, self.until(expires_at)))
            .await;
        claims.expect("the store").pop()
    }

    /// Records an update with the next number, and renews the lease for a long time.
    pub(crate) async fn record_next(&self, claim: &Claim, update: &JobUpdate) -> LeaseState {
        let update = numbered(claim, update.clone());
        let recorded = self.record(claim, &update, Duration::from_hours(1)).await;
        recorded.expect("the store")
    }

    /// Ends a job or returns it to the queue, with the next number.
    pub(crate) async fn end_next(
        &self,
        claim: &Claim,
        update: &JobUpdate,
        end: &End,
    ) -> Option<Status> {
        let update = numbered(claim, update.clone());
        let ended = self.end(claim, &update, end).await;
        ended.expect("the store")
    }

    /// The time until one on the clock by which leases are measured, ms.
    pub(crate) fn until(&self, ms: i64) -> Duration {
        let left = ms.saturating_sub(self.clock().now().monotonic_ms);
        Duration::from_millis(u64::try_from(left).unwrap_or_default())
    }

    /// Sets the clock by which leases are measured, ms.
    pub(in crate::store) fn set_clock(&self, ms: i64) {
        let Clock::Manual(now) = self.clock() else {
            panic!("the clock of the system");
        };
        now.store(ms, Ordering::Relaxed);
    }
}

/// A request for one job by a worker of its own, which runs no other one.
pub(crate) fn request(memory_mb: i64, lease: Duration) -> ClaimRequest {
    ClaimRequest {
        request: RequestNumber {
            worker: Uuid::now_v7(),
            number: 1,
        },
        is_remote: false,
        capacity: Capacity {
            slots: 1,
            memory: MemoryBudget {
                memory_mb,
                used_mb: 0,
                running: 1,
            },
            is_one_of_several: false,
            ahead_ms: 0,
        },
        lease,
        token: None,
    }
}

/// A specification as it was sent, which no program would write so.
pub(in crate::store) const SENT: &str =
    "{ \"system\": {\"kind\":\"fuzz_button\"}, \"cycles\": 1e1 }";

/// An update with the next number under a lease, of those that are numbered here.
pub(in crate::store) fn numbered(lease: impl Into<Lease>, update: JobUpdate) -> JobUpdate {
    static LAST: Mutex<BTreeMap<(Uuid, i64), i64>> = Mutex::new(BTreeMap::new());
    let lease = lease.into();
    let mut last = LAST.lock().expect("no panic");
    let number = last.entry((lease.job, lease.number)).or_default();
    *number += 1;
    JobUpdate {
        number: *number,
        ..update
    }
}

pub(in crate::store) struct Fixture {
    pub(in crate::store) store: Arc<Store>,
    pub(in crate::store) url: String,
    pub(in crate::store) folder: TempDir,
}

impl Fixture {
    /// In a file.
    pub(in crate::store) async fn new() -> Self {
        Self::at(Place::sqlite()).await
    }

    pub(in crate::store) async fn at(place: Place) -> Self {
        let clock = Clock::Manual(AtomicI64::new(0));
        let files = place.files();
        let store = Store::open_by(&place.url, &files, Limits::default(), clock).await;
        let store = Arc::new(store.expect("a store"));
        let Place { folder, url } = place;
        Self { store, url, folder }
    }

    pub(in crate::store) async fn queued(&self) -> Uuid {
        self.queued_with(SubmitOptions::default()).await
    }

    pub(in crate::store) async fn queued_with(&self, options: SubmitOptions) -> Uuid {
        self.store.queue(&new_job(options)).await
    }

    pub(in crate::store) async fn claimed(&self, expires_at: i64) -> Claim {
        self.store.claim_next(expires_at).await.expect("a job")
    }

    pub(in crate::store) async fn job(&self, id: Uuid) -> api::job::Job {
        self.store
            .job(id)
            .await
            .expect("the store")
            .expect("a job")
            .document
    }

    /// Reclaims jobs whose lease has ended by this time, and ends those without another attempt; returns how many.
    pub(in crate::store) async fn reclaimed(&self, by: i64) -> usize {
        self.store.set_clock(by);
        let reclaimed = self.store.reclaim_expired(Duration::from_millis(1)).await;
        let reclaimed = reclaimed.expect("the store");
        for claim in &reclaimed.ending {
            let empty = JobUpdate::default();
            let ended = self.ended(claim, &empty, Transition::WorkerLost, by).await;
            ended.expect("the lease is held");
        }
        reclaimed.queued + reclaimed.ending.len()
    }

    pub(in crate::store) async fn recorded(
        &self,
        claim: &Claim,
        update: &JobUpdate,
        expires_at: i64,
    ) -> LeaseState {
        let update = numbered(claim, update.clone());
        let length = self.store.until(expires_at);
        let state = self.store.record(claim, &update, length).await;
        state.expect("the store")
    }

    /// Ends a job; returns its status, or `None` if the lease was lost.
    pub(in crate::store) async fn ended(
        &self,
        claim: &Claim,
        update: &JobUpdate,
        transition: Transition,
        now: i64,
    ) -> Option<Status> {
        self.store.set_clock(now);
        let update = numbered(claim, update.clone());
        let status = self.store.end(claim, &update, &end(transition)).await;
        status.expect("the store")
    }

    pub(in crate::store) async fn ended_with(&self, claim: &Claim, update: &JobUpdate) {
        let ended = self.ended(claim, update, Transition::Succeed, 2).await;
        ended.expect("the lease is held");
    }

    /// Executes a statement past the store.
    pub(in crate::store) async fn execute(&self, statement: &'static str) {
        let executed = if self.store.is_shared() {
            let mut database = PgConnection::connect(&self.url).await.expect("a server");
            database.execute(statement).await.map(drop)
        } else {
            let mut database = SqliteConnection::connect(&self.url).await.expect("a file");
            database.execute(statement).await.map(drop)
        };
        executed.expect("executed");
    }

    pub(in crate::store) async fn cycles(&self, id: Uuid) -> Vec<u64> {
        self.store
            .history(id)
            .await
            .expect("the store")
            .iter()
            .map(|row: &CycleReport| row.cycle)
            .collect()
    }
}

pub(crate) fn update(cycle: u64) -> JobUpdate {
    JobUpdate {
        rows: vec![row(cycle)],
        events: vec![(EventName::Cycle, "{}".to_owned())],
        ..JobUpdate::default()
    }
}

/// An update with rows up to one after a cycle, and a checkpoint at it.
pub(in crate::store) fn with_checkpoint(cycle: u64) -> JobUpdate {
    JobUpdate {
        rows: (1..=cycle + 1).map(row).collect(),
        checkpoint: Some(EncodedCheckpoint {
            cycle,
            state: b"a state".to_vec(),
        }),
        ..JobUpdate::default()
    }
}

pub(crate) fn end(transition: Transition) -> End {
    End {
        transition,
        reason: Some("because".to_owned()),
        outcome: Some(Outcome::Completed),
        summary: None,
    }
}

/// A job to be queued.
pub(in crate::store) fn new_job(options: SubmitOptions) -> NewJob {
    let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
    let plan = crate::estimate::Estimate::of(&resolved).plan(&resolved, None);
    NewJob {
        sent: SENT.to_owned(),
        spec: resolved.spec,
        plan,
        options,
    }
}
