//! Retention of ended jobs, by the time that services have seen pass.

use super::*;

on_both_engines! { Fixture:
    a_clock_that_is_wrong_deletes_nothing,
    a_job_that_is_queued_again_is_retained_from_its_next_end,
    a_batch_without_jobs_is_retained_as_long_as_a_job,
}

const DAY: Duration = Duration::from_hours(24);
const DAY_MS: i64 = 86_400_000;
/// Time between two counts.
const STEP_MS: i64 = 240_000;

impl Fixture {
    async fn ended_job(&self) -> Uuid {
        let id = self.queued().await;
        self.store.cancel(id).await.expect("the store");
        id
    }

    /// The service counts the time from one to another.
    async fn counts(&self, from: i64, until: i64) {
        for ms in (from..until).step_by(usize::try_from(STEP_MS).expect("a step")) {
            self.store.set_clock(ms);
            self.store.count_time().await.expect("the store");
        }
        self.store.set_clock(until);
        self.store.count_time().await.expect("the store");
    }

    async fn deleted(&self, age: Duration) -> usize {
        let deleted = self.store.delete_older(age).await;
        deleted.expect("the store")
    }
}

async fn a_clock_that_is_wrong_deletes_nothing(fixture: Fixture) {
    let first = fixture.ended_job().await;
    fixture.counts(0, STEP_MS).await;
    // Forwards, and a job ends meanwhile; then backwards.
    let wrong = 3_650 * DAY_MS;
    fixture.counts(wrong, wrong + STEP_MS).await;
    let second = fixture.ended_job().await;
    fixture.counts(0, DAY_MS / 2).await;
    assert_eq!(fixture.deleted(DAY).await, 0);
    fixture.counts(DAY_MS / 2, DAY_MS - STEP_MS).await;
    assert_eq!(fixture.deleted(DAY).await, 1);
    assert_eq!(fixture.store.job(first).await.expect("the store"), None);
    fixture.counts(DAY_MS - STEP_MS, DAY_MS).await;
    assert_eq!(fixture.deleted(DAY).await, 0);
    fixture.counts(DAY_MS, DAY_MS + 1).await;
    assert_eq!(fixture.deleted(DAY).await, 1);
    assert_eq!(fixture.store.job(second).await.expect("the store"), None);
}

async fn a_job_that_is_queued_again_is_retained_from_its_next_end(fixture: Fixture) {
    let id = fixture.ended_job().await;
    fixture.counts(0, DAY_MS / 2).await;
    fixture.store.retry(id).await.expect("the store");
    fixture.counts(DAY_MS / 2, DAY_MS + 1).await;
    assert_eq!(fixture.deleted(DAY).await, 0, "it has not ended");
    fixture.store.cancel(id).await.expect("the store");
    assert_eq!(fixture.deleted(DAY).await, 0);
    fixture.counts(DAY_MS + 1, 2 * DAY_MS + 2).await;
    assert_eq!(fixture.deleted(DAY).await, 1);
}

async fn a_batch_without_jobs_is_retained_as_long_as_a_job(fixture: Fixture) {
    fixture.ended_job().await;
    fixture.counts(0, DAY_MS / 2).await;
    let batch = fixture.batch(Vec::new(), None).await;
    let is_there = async || {
        let found = fixture.store.has_batch(batch, false).await;
        found.expect("the store")
    };
    fixture.counts(DAY_MS / 2, DAY_MS + 1).await;
    assert_eq!(fixture.deleted(DAY).await, 1, "the job");
    assert!(is_there().await);
    fixture.counts(DAY_MS + 1, 3 * DAY_MS / 2 + 1).await;
    assert_eq!(fixture.deleted(DAY).await, 0, "no job");
    assert!(!is_there().await);
}
