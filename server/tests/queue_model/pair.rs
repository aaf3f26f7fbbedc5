//! The queue beside its model.

mod requests;

use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::{AtomicI64, Ordering};

use api::job::Status;
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use server::clock::Clock;
use server::estimate::Estimate;
use server::queue::{Transition, sort_key};
use server::spec;
use server::store::{Claim, Lease, Limits, NewJob, Store, SubmitOptions, Submitted};
use uuid::Uuid;

use crate::model::{ATTEMPT_LIMIT, ModelJob};
use crate::step::{ENDS, LEASE, LEASE_MS, Step};

/// The queue and its model.
pub(crate) struct Pair {
    pub(crate) store: Store,
    now: i64,
    /// Number of the last claim.
    number: i64,
    worker: Uuid,
    job: NewJob,
    jobs: Vec<ModelJob>,
    claims: Vec<Claim>,
    /// Number of the last write under each lease.
    writes: HashMap<Lease, i64>,
}

/// Limits of the model.
const LIMITS: Limits = Limits {
    attempts: ATTEMPT_LIMIT,
    least_free_disk_mb: 0,
};

impl Pair {
    pub(crate) async fn new(url: &str, files: &Path) -> Self {
        let now = 1_000_000;
        let clock = Clock::Manual(AtomicI64::new(now));
        let store = Store::open_by(url, files, LIMITS, clock).await;
        let store = store.expect("a store");
        let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let plan = Estimate::of(&resolved).plan(&resolved, None);
        let job = NewJob {
            sent: r#"{"system":{"kind":"fuzz_button"}}"#.to_owned(),
            spec: resolved.spec,
            plan,
            options: SubmitOptions::default(),
        };
        Self {
            store,
            now,
            number: 0,
            worker: Uuid::now_v7(),
            job,
            jobs: Vec::new(),
            claims: Vec::new(),
            writes: HashMap::new(),
        }
    }

    /// Returns a claim, the index of its job and whether the claim still holds it.
    fn claimed(&self, claim: usize) -> Option<(Claim, usize, bool)> {
        let claim = self.claims.get(claim % self.claims.len().max(1))?.clone();
        let index = self.jobs.iter().position(|job| job.id == claim.id)?;
        let job = &self.jobs[index];
        let held = !job.deleted && job.status == Status::Running && job.lease == claim.lease;
        Some((claim, index, held))
    }

    pub(crate) async fn apply(&mut self, step: &Step) -> TestCaseResult {
        match step {
            Step::Submit {
                priority,
                deadline_s,
            } => self.submit(*priority, *deadline_s).await,
            Step::Claim { slots, times } => self.claim(*slots, *times).await?,
            Step::Record {
                claim,
                checkpoint,
                times,
            } => self.record(*claim, *checkpoint, *times).await?,
            Step::RecordAfterGap { claim } => self.record_after_gap(*claim).await?,
            Step::Renew { claim } => self.renew(*claim).await?,
            Step::Restart { claim, times } => self.restart(*claim, *times).await?,
            Step::End {
                claim,
                transition,
                times,
            } => self.end(*claim, ENDS[*transition], *times).await?,
            Step::Cancel { job } => self.cancel(*job).await,
            Step::Retry { job } => self.retry(*job).await,
            Step::Reclaim => self.reclaim().await?,
            Step::Expire => self.expire().await?,
            Step::Delete { job } => self.delete(*job).await?,
            Step::Wait { ms } => {
                self.now += ms;
                if let Clock::Manual(clock) = self.store.clock() {
                    clock.store(self.now, Ordering::Relaxed);
                }
            }
        }
        self.compare().await
    }

    /// Number of the next write under a lease.
    fn next_write(&mut self, claim: &Claim) -> i64 {
        let number = self.writes.entry(claim.into()).or_default();
        *number += 1;
        *number
    }

    async fn submit(&mut self, priority: i32, deadline_s: Option<u32>) {
        self.job.options = SubmitOptions {
            priority,
            deadline_s,
        };
        let submitted = self.store.submit(&self.job, None).await;
        let Submitted::Job(id) = submitted.expect("queued") else {
            panic!("there is no key");
        };
        self.jobs.push(ModelJob {
            id,
            status: Status::Queued,
            sort_key: sort_key(self.now, priority),
            queued_at: self.now,
            deadline_at: deadline_s.map(|s| self.now + 1_000 * i64::from(s)),
            attempts: 0,
            fruitless: 0,
            lease: 0,
            expires_at: 0,
            cancel_requested: false,
            events: 1,
            rows: 0,
            checkpoint: 0,
            deleted: false,
        });
    }

    async fn cancel(&mut self, job: usize) {
        let count = self.jobs.len().max(1);
        let Some(job) = self.jobs.get_mut(job % count) else {
            return;
        };
        self.store.cancel(job.id).await.expect("the store");
        match job.status {
            _ if job.deleted => {}
            Status::Queued => {
                job.apply(Transition::Cancel);
            }
            Status::Running => job.cancel_requested = true,
            _ => {}
        }
    }

    async fn retry(&mut self, job: usize) {
        let count = self.jobs.len().max(1);
        let Some(job) = self.jobs.get_mut(job % count) else {
            return;
        };
        self.store.retry(job.id).await.expect("the store");
        if !job.deleted && job.apply(Transition::Retry) {
            (job.fruitless, job.cancel_requested) = (0, false);
            let from_submission = job.deadline_at.map(|at| at - job.queued_at);
            job.deadline_at = from_submission.map(|length| self.now + length);
            job.queued_at = self.now;
        }
    }

    async fn reclaim(&mut self) -> TestCaseResult {
        let reclaimed = self.store.reclaim_expired(LEASE).await.expect("the store");
        let (mut queued, mut ending) = (0, Vec::new());
        for job in &mut self.jobs {
            if job.status == Status::Running && job.expires_at <= self.now {
                let mut after = job.clone();
                after.apply(Transition::WorkerLost);
                if after.status == Status::Queued {
                    *job = after;
                    queued += 1;
                } else {
                    // The job is held under a new lease until its manifest is built.
                    let claim = reclaimed.ending.iter().find(|claim| claim.id == job.id);
                    let lease = claim.map_or(0, |claim| claim.lease);
                    prop_assert!(lease > job.lease);
                    job.lease = lease;
                    job.expires_at = self.now + LEASE_MS;
                    ending.push((job.id, job.lease));
                }
            }
        }
        prop_assert_eq!(reclaimed.queued, queued);
        let mut found: Vec<_> = reclaimed.ending.iter().map(|c| (c.id, c.lease)).collect();
        found.sort_unstable();
        ending.sort_unstable();
        prop_assert_eq!(found, ending);
        self.claims.extend(reclaimed.ending);
        Ok(())
    }

    async fn expire(&mut self) -> TestCaseResult {
        let expired = self.store.expire().await.expect("the store");
        let mut expected = 0;
        for job in self.jobs.iter_mut().filter(|job| !job.deleted) {
            let late = job.deadline_at.is_some_and(|at| at <= self.now);
            if late && job.status == Status::Queued {
                job.apply(Transition::Expire);
                expected += 1;
            }
        }
        prop_assert_eq!(expired, expected);
        Ok(())
    }

    async fn delete(&mut self, job: usize) -> TestCaseResult {
        let count = self.jobs.len().max(1);
        let Some(job) = self.jobs.get_mut(job % count) else {
            return Ok(());
        };
        self.store.delete(job.id).await.expect("the store");
        job.deleted |= job.status.is_terminal();
        Ok(())
    }

    /// Compares every job with the model; its events have no gaps and `done` is the last one of one that has ended.
    async fn compare(&self) -> TestCaseResult {
        for (status, count, _) in self.store.gauges().await.expect("the store").jobs {
            let jobs = self.jobs.iter();
            let expected = jobs.filter(|job| !job.deleted && job.status == status);
            prop_assert_eq!(usize::try_from(count), Ok(expected.count()));
        }
        for job in &self.jobs {
            let stored = self.store.job(job.id).await.expect("the store");
            let Some(stored) = stored else {
                prop_assert!(job.deleted);
                continue;
            };
            prop_assert!(!job.deleted);
            let found = &stored.document;
            prop_assert_eq!(found.status, job.status);
            prop_assert_eq!(found.attempts, job.attempts);
            prop_assert_eq!(found.finished_at.is_some(), job.status.is_terminal());
            let events = self.store.events(job.id, 0).await.expect("the store");
            let numbers: Vec<i64> = events.iter().map(|event| event.seq).collect();
            prop_assert_eq!(numbers, (1..=job.events).collect::<Vec<_>>());
            let ends_done = events.last().is_some_and(|event| event.name == "done");
            prop_assert_eq!(ends_done, job.status.is_terminal());
            let history = self.store.history(job.id).await.expect("the store");
            let cycles: Vec<u64> = history.iter().map(|row| row.cycle).collect();
            prop_assert_eq!(cycles, (1..=job.rows).collect::<Vec<_>>());
        }
        Ok(())
    }
}
