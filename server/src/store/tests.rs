//! The contract of the store over a real database: fencing, contention, reclaiming, restarts.

mod checkpoints;
mod files;
mod leases;
mod order;

use std::sync::Arc;

use api::job::{Outcome, Status};
use solver::record::CycleReport;
use tempfile::TempDir;
use tokio::sync::Barrier;
use uuid::Uuid;

use super::*;
use crate::http::tests::row;
use crate::queue::{ATTEMPT_LIMIT, Transition};
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::spec;

pub(crate) use super::sqlite::tests::{fill_disk, hold_write_lock};

/// Operations with defaults that only tests use.
impl Store {
    /// Opens a database with default limits.
    pub(crate) async fn open(url: &str) -> Result<Self, StoreError> {
        Self::open_with(url, Limits::default()).await
    }

    /// Queues a job.
    pub(crate) async fn queue(&self, job: &NewJob, now: i64) -> Uuid {
        let submitted = self.submit(job, None, now).await.expect("the store");
        let Submitted::Job(id) = submitted else {
            panic!("there is no key");
        };
        id
    }

    /// Claims the first job in the order of the queue, whatever memory it needs.
    pub(crate) async fn claim(
        &self,
        now: i64,
        expires_at: i64,
    ) -> Result<Option<Claim>, StoreError> {
        self.claim_within(i64::MAX, now, expires_at).await
    }
}

pub(in crate::store) struct Fixture {
    pub(in crate::store) store: Arc<Store>,
    pub(in crate::store) url: String,
    pub(in crate::store) folder: TempDir,
}

impl Fixture {
    pub(in crate::store) async fn new() -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        let url = format!("sqlite://{}", folder.path().join("test.db").display());
        let store = Arc::new(Store::open(&url).await.expect("a store"));
        Self { store, url, folder }
    }

    pub(in crate::store) async fn queued(&self) -> Uuid {
        self.queued_with(SubmitOptions::default()).await
    }

    pub(in crate::store) async fn queued_with(&self, options: SubmitOptions) -> Uuid {
        let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let plan = crate::estimate::Estimate::of(&resolved).plan(&resolved, None);
        let job = NewJob {
            spec: resolved.spec,
            plan,
            options,
        };
        self.store.queue(&job, 0).await
    }

    pub(in crate::store) async fn claimed(&self, expires_at: i64) -> Claim {
        self.store
            .claim(1, expires_at)
            .await
            .expect("the store")
            .expect("a job")
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
        let reclaimed = self.store.reclaim_expired(by, by + 1).await;
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
        let state = self.store.record(claim, update, expires_at).await;
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
        let status = self.store.end(claim, update, &end(transition), now).await;
        status.expect("the store")
    }

    pub(in crate::store) async fn ended_with(&self, claim: &Claim, update: &JobUpdate) {
        let ended = self.ended(claim, update, Transition::Succeed, 2).await;
        ended.expect("the lease is held");
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

pub(in crate::store) fn update(cycle: u64) -> JobUpdate {
    JobUpdate {
        rows: vec![row(cycle)],
        events: vec![("cycle", "{}".to_owned())],
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

pub(in crate::store) fn end(transition: Transition) -> End {
    End {
        transition,
        reason: Some("because".to_owned()),
        outcome: Some(Outcome::Completed),
        summary: None,
    }
}
