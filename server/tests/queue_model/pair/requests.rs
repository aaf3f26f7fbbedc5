//! Requests of workers, each made once or repeated: claims, and writes and ends under a lease.

use api::job::Status;
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use server::queue::{Capacity, MemoryBudget, Transition};
use server::solve::checkpoint::EncodedCheckpoint;
use server::store::{
    ClaimRequest, ClaimedCheckpoint, End, EventName, JobUpdate, LeaseState, RequestNumber,
};
use solver::record::CycleReport;

use super::Pair;
use crate::step::{LEASE, LEASE_MS};

impl Pair {
    pub(super) async fn claim(&mut self, slots: usize, times: usize) -> TestCaseResult {
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
            token: None,
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
            prop_assert!(claim.lease > job.lease);
            job.lease = claim.lease;
            job.events += 1;
            job.expires_at = self.now + LEASE_MS;
            job.rows = job.checkpoint;
            prop_assert_eq!((claim.id, claim.lease), (job.id, job.lease));
            prop_assert_eq!(claim.attempt, job.attempts);
            let from = claim
                .checkpoint
                .as_ref()
                .map_or(0, ClaimedCheckpoint::cycle);
            prop_assert_eq!(from, job.checkpoint);
        }
        self.claims.extend(claims);
        Ok(())
    }

    pub(super) async fn record(
        &mut self,
        claim: usize,
        checkpoint: bool,
        times: usize,
    ) -> TestCaseResult {
        let Some((claim, index, held)) = self.claimed(claim) else {
            return Ok(());
        };
        let number = self.next_write(&claim);
        let job = &mut self.jobs[index];
        let cycle = job.rows + 1;
        let update = JobUpdate {
            number,
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

    /// An update after one that the database has lost, and an end after it: neither has an effect.
    pub(super) async fn record_after_gap(&mut self, claim: usize) -> TestCaseResult {
        let Some((claim, index, _)) = self.claimed(claim) else {
            return Ok(());
        };
        let number = 2 + self
            .writes
            .get(&(&claim).into())
            .copied()
            .unwrap_or_default();
        let update = JobUpdate {
            number,
            rows: vec![row(self.jobs[index].rows + 2)],
            ..JobUpdate::default()
        };
        let recorded = self.store.record(&claim, &update, LEASE).await;
        prop_assert_eq!(recorded.expect("the store"), LeaseState::Lost);
        let end = End {
            transition: Transition::Succeed,
            reason: None,
            outcome: None,
            summary: None,
        };
        let ended = self.store.end(&claim, &update, &end).await;
        prop_assert_eq!(ended.expect("the store"), None);
        Ok(())
    }

    pub(super) async fn renew(&mut self, claim: usize) -> TestCaseResult {
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

    pub(super) async fn restart(&mut self, claim: usize, times: usize) -> TestCaseResult {
        let Some((claim, index, held)) = self.claimed(claim) else {
            return Ok(());
        };
        let number = self.next_write(&claim);
        let job = &mut self.jobs[index];
        for _ in 0..times {
            let answer = self.store.restart(&claim, number).await;
            let answer = answer.expect("the store");
            prop_assert_eq!(answer, expected(held, job.cancel_requested));
        }
        if held {
            (job.rows, job.checkpoint) = (0, 0);
            job.fruitless = job.fruitless.max(1);
            job.events += 1;
        }
        Ok(())
    }

    pub(super) async fn end(
        &mut self,
        claim: usize,
        transition: Transition,
        times: usize,
    ) -> TestCaseResult {
        let Some((claim, index, held)) = self.claimed(claim) else {
            return Ok(());
        };
        let number = self.next_write(&claim);
        let end = End {
            transition,
            reason: None,
            outcome: None,
            summary: None,
        };
        let update = JobUpdate {
            number,
            ..JobUpdate::default()
        };
        let mut answers = Vec::new();
        for _ in 0..times {
            let answer = self.store.end(&claim, &update, &end).await;
            answers.push(answer.expect("the store"));
        }
        let job = &mut self.jobs[index];
        let moved = held && job.apply(transition);
        if moved
            && matches!(transition, Transition::Release | Transition::Decline)
            && job.status == Status::Queued
        {
            job.attempts -= 1;
            job.fruitless = job.fruitless.saturating_sub(1);
        }
        prop_assert_eq!(answers, vec![moved.then_some(job.status); times]);
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
