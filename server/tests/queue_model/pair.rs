//! The queue beside its model.

use std::sync::atomic::{AtomicI64, Ordering};

use api::job::Status;
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use server::clock::Clock;
use server::estimate::Estimate;
use server::queue::{Capacity, MemoryBudget, Transition, sort_key};
use server::solve::checkpoint::EncodedCheckpoint;
use server::spec;
use server::store::{
    Claim, ClaimRequest, End, EventName, JobUpdate, LeaseState, Limits, NewJob, RequestNumber,
    Store, SubmitOptions, Submitted,
};
use solver::record::CycleReport;
use tempfile::TempDir;
use uuid::Uuid;

use crate::model::{ATTEMPT_LIMIT, ModelJob};
use crate::step::{ENDS, LEASE, LEASE_MS, Step};

/// The queue and its model.
pub(crate) struct Pair {
    pub(crate) store: Store,
    now: i64,
    /// Number of the last request.
    number: i64,
    worker: Uuid,
    job: NewJob,
    jobs: Vec<ModelJob>,
    claims: Vec<Claim>,
}

/// Limits of the model.
const LIMITS: Limits = Limits {
    attempts: ATTEMPT_LIMIT,
    least_free_disk_mb: 0,
};

impl Pair {
    pub(crate) async fn new(folder: &TempDir) -> Self {
        let url = format!("sqlite://{}", folder.path().join("test.db").display());
        let now = 1_000_000;
        let clock = Clock::Manual(AtomicI64::new(now));
        let store = Store::open_by(&url, LIMITS, clock).await;
        let store = store.expect("a store");
        let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let plan = Estimate::of(&resolved).plan(&resolved, None);
        let job = NewJob {
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

    async fn submit(&mut self, priority: i32, deadline_s: Option<u32>) {
        self.job.options = SubmitOptions {
            priority,
            deadline_s,
        };
        let submitted = self.store.submit(&self.job, None, self.now).await;
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

    async fn claim(&mut self, slots: usize, times: usize) -> TestCaseResult {
        self.number += 1;
        let request = ClaimRequest {
            request: RequestNumber {
                worker: self.worker,
                number: self.number,
            },
            is_remote: false,
            capacity: Capacity {
                slots,
                memory: MemoryBudget {
                    memory_mb: i64::MAX,
                    used_mb: 0,
                    running: 0,
                },
                is_one_of_several: false,
                ahead_ms: 0,
            },
            lease: LEASE,
        };
        let claims = self.store.claim(&request).await.expect("the store");
        // A repeated request gets the same jobs; without any, it is as good as the first.
        for _ in 1..times {
            let mut again = self.store.claim(&request).await.expect("the store");
            again.sort_by_key(|claim| claims.iter().position(|first| first.id == claim.id));
            prop_assert_eq!(&again, &claims);
        }
        let mut waiting: Vec<_> = self
            .jobs
            .iter_mut()
            .filter(|job| !job.deleted && job.status == Status::Queued)
            .collect();
        waiting.sort_by_key(|job| (job.sort_key, job.id));
        prop_assert_eq!(claims.len(), waiting.len().min(slots));
        for (claim, job) in claims.iter().zip(waiting) {
            job.apply(Transition::Claim);
            job.attempts += 1;
            job.fruitless += 1;
            job.lease += 1;
            job.events += 1;
            job.expires_at = self.now + LEASE_MS;
            job.rows = job.checkpoint;
            prop_assert_eq!((claim.id, claim.lease), (job.id, job.lease));
            prop_assert_eq!(claim.attempt, job.attempts);
            let from = claim.checkpoint.as_ref().map_or(0, |found| found.cycle);
            prop_assert_eq!(from, job.checkpoint);
        }
        self.claims.extend(claims);
        Ok(())
    }

    async fn record(&mut self, claim: usize, checkpoint: bool, times: usize) -> TestCaseResult {
        self.number += 1;
        let Some((claim, index, held)) = self.claimed(claim) else {
            return Ok(());
        };
        let job = &mut self.jobs[index];
        let cycle = job.rows + 1;
        let update = JobUpdate {
            number: self.number,
            rows: vec![row(cycle)],
            events: vec![(EventName::Cycle, "{}".to_owned())],
            checkpoint: checkpoint.then(|| EncodedCheckpoint {
                cycle,
                state: cycle.to_le_bytes().to_vec(),
            }),
            ..JobUpdate::default()
        };
        for _ in 0..times {
            let answer = self.store.record(&claim, &update, LEASE).await;
            let answer = answer.expect("the store");
            prop_assert_eq!(answer, expected(held, job.cancel_requested));
        }
        if held {
            job.rows = cycle;
            job.events += 1;
            job.expires_at = self.now + LEASE_MS;
            if checkpoint {
                (job.checkpoint, job.fruitless) = (cycle, 0);
            }
        }
        Ok(())
    }

    async fn renew(&mut self, claim: usize) -> TestCaseResult {
        let Some((claim, index, held)) = self.claimed(claim) else {
            return Ok(());
        };
        let job = &mut self.jobs[index];
        let answer = self.store.renew(&claim, LEASE).await;
        if held {
            job.expires_at = self.now + LEASE_MS;
        }
        prop_assert_eq!(
            answer.expect("the store"),
            expected(held, job.cancel_requested)
        );
        Ok(())
    }

    async fn restart(&mut self, claim: usize, times: usize) -> TestCaseResult {
        self.number += 1;
        let Some((claim, index, held)) = self.claimed(claim) else {
            return Ok(());
        };
        let job = &mut self.jobs[index];
        for _ in 0..times {
            let answer = self.store.restart(&claim, self.number).await;
            let answer = answer.expect("the store");
            prop_assert_eq!(answer, expected(held, job.cancel_requested));
        }
        if held {
            (job.rows, job.checkpoint) = (0, 0);
            job.events += 1;
        }
        Ok(())
    }

    async fn end(&mut self, claim: usize, transition: Transition, times: usize) -> TestCaseResult {
        self.number += 1;
        let Some((claim, index, held)) = self.claimed(claim) else {
            return Ok(());
        };
        let end = End {
            transition,
            reason: None,
            outcome: None,
            summary: None,
        };
        let update = JobUpdate {
            number: self.number,
            ..JobUpdate::default()
        };
        let mut answers = Vec::new();
        for _ in 0..times {
            let answer = self.store.end(&claim, &update, &end).await;
            answers.push(answer.expect("the store"));
        }
        let job = &mut self.jobs[index];
        let moved = held && job.apply(transition);
        if moved && transition == Transition::Release && job.status == Status::Queued {
            job.attempts -= 1;
            job.fruitless = job.fruitless.saturating_sub(1);
        }
        prop_assert_eq!(answers, vec![moved.then_some(job.status); times]);
        Ok(())
    }

    async fn cancel(&mut self, job: usize) {
        let count = self.jobs.len().max(1);
        let Some(job) = self.jobs.get_mut(job % count) else {
            return;
        };
        self.store
            .cancel(job.id, self.now)
            .await
            .expect("the store");
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
        self.store.retry(job.id, self.now).await.expect("the store");
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
                    // It is held under a new lease until its manifest is built.
                    job.lease += 1;
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
        let expired = self.store.expire(self.now).await.expect("the store");
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
        for (status, count, _) in self.store.gauges(0).await.expect("the store").jobs {
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

fn expected(held: bool, cancel_requested: bool) -> LeaseState {
    if held {
        LeaseState::Held { cancel_requested }
    } else {
        LeaseState::Lost
    }
}

fn row(cycle: u64) -> CycleReport {
    CycleReport {
        cycle,
        jump: 1,
        ..CycleReport::default()
    }
}
