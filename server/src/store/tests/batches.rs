//! Batches whose jobs are queued one portion after the other.

use api::sweep::{Changes, RefusedChanges};
use serde_json::json;

use super::*;
use crate::store::batches::JOBS_AT_ONCE;

on_both_engines! { Fixture:
    the_next_jobs_of_a_batch_are_queued_once_and_in_order,
    a_cancelled_batch_queues_no_more,
    all_refused_combinations_are_counted_and_the_first_are_stored,
    a_batch_with_jobs_to_come_is_not_deleted,
    a_large_batch_is_cancelled_and_deleted_in_several_transactions,
    a_batch_whose_job_is_queued_again_meanwhile_is_not_deleted,
}

/// Number of jobs of a batch with an expansion.
const JOBS: u64 = 5;

pub(super) fn new_jobs(positions: std::ops::Range<u64>) -> Vec<NewBatchJob> {
    let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
    let plan = crate::estimate::Estimate::of(&resolved).plan(&resolved, None);
    let job = NewJob {
        sent: SENT.to_owned(),
        spec: resolved.spec,
        plan,
        options: SubmitOptions::default(),
    };
    let new = |position| NewBatchJob {
        position,
        job: job.clone(),
        overrides: changes(position),
    };
    positions.map(new).collect()
}

fn changes(position: u64) -> Changes {
    Changes::from([("/cycles".to_owned(), json!(position))])
}

impl Fixture {
    async fn cancelled_batch(&self, batch: Uuid) {
        let noted = self.store.note_cancellation(batch).await;
        noted.expect("the store");
        self.ended_jobs_of_batches().await;
    }

    async fn deleted_batch(&self, batch: Uuid) -> Deleted {
        let noted = self.store.note_deletion(batch).await;
        self.ended_jobs_of_batches().await;
        noted.expect("the store")
    }

    /// Ends the jobs of noted batches, as the service does, until none is left.
    async fn ended_jobs_of_batches(&self) {
        while self.store.end_jobs_of_batches().await.expect("the store") {}
        let left = self.store.batch_endings().await;
        assert_eq!(left.expect("the store"), []);
    }

    /// Queues the first two jobs of a batch.
    async fn first_jobs(&self) -> Uuid {
        let expansion = NewExpansion {
            request: "{}".to_owned(),
            next: 2,
            jobs: JOBS,
            cpu_s: Some(2.5),
        };
        self.batch(new_jobs(0..2), Some(expansion)).await
    }

    pub(super) async fn batch(
        &self,
        jobs: Vec<NewBatchJob>,
        expansion: Option<NewExpansion>,
    ) -> Uuid {
        let batch = NewBatch {
            name: None,
            base: SENT.to_owned(),
            jobs,
            plan: None,
            expansion,
        };
        let submitted = self.store.submit_batch(&batch, None).await;
        let Submitted::Job(id) = submitted.expect("the store") else {
            panic!("there is no key");
        };
        id
    }

    async fn extended(&self, batch: Uuid, positions: std::ops::Range<u64>) -> bool {
        let portion = Portion {
            batch,
            positions: positions.clone(),
            jobs: new_jobs(positions),
            refused: Vec::new(),
        };
        let extended = self.store.extend_batch(&portion).await;
        extended.expect("the store")
    }

    async fn stored(&self, batch: Uuid, part: BatchPart) -> StoredBatch {
        let stored = self.store.batch(batch, part, BatchDetail::Statuses).await;
        stored.expect("the store").expect("a batch")
    }
}

async fn the_next_jobs_of_a_batch_are_queued_once_and_in_order(fixture: Fixture) {
    let store = &fixture.store;
    let batch = fixture.first_jobs().await;
    let open = store.expansions().await.expect("the store");
    let expected = Expansion {
        batch,
        next: 2,
        jobs: JOBS,
        waiting: 2,
    };
    assert_eq!(open, [expected]);
    let request = store.expansion_request(batch).await.expect("the store");
    assert_eq!(request.as_deref(), Some("{}"));
    let before = store.demand().await.expect("the store");
    assert_eq!(before.queued, JOBS);
    let portion = Portion {
        batch,
        positions: 2..4,
        jobs: new_jobs(2..3),
        refused: vec![RefusedChanges {
            position: 3,
            overrides: changes(3),
            reason: "/cycles: too many".to_owned(),
        }],
    };
    assert!(store.extend_batch(&portion).await.expect("the store"));
    assert!(!store.extend_batch(&portion).await.expect("the store"));
    let stored = fixture.stored(batch, BatchPart::WHOLE).await;
    let positions: Vec<u64> = stored.jobs.iter().map(|job| job.position).collect();
    assert_eq!(positions, [0, 1, 2]);
    assert_eq!(stored.jobs[2].overrides, changes(2));
    assert_eq!(stored.refused, portion.refused);
    let overview = &stored.overview;
    let numbers = (overview.asked, overview.to_come, overview.refused);
    assert_eq!(numbers, (Some(JOBS), 1, 1));
    assert_eq!(overview.counts["queued"], 3);
    assert!(!fixture.extended(batch, 2..5).await, "2 and 3 were queued");
    assert!(fixture.extended(batch, 4..5).await);
    assert_eq!(store.expansions().await.expect("the store"), []);
    let request = store.expansion_request(batch).await.expect("the store");
    assert_eq!(request, None, "all are queued");
    let after = store.demand().await.expect("the store");
    assert_eq!(after.queued, JOBS - 1);
    let part = fixture.stored(batch, BatchPart { from: 2, limit: 1 }).await;
    let positions: Vec<u64> = part.jobs.iter().map(|job| job.position).collect();
    assert_eq!(positions, [2]);
    assert_eq!(part.overview.counts["queued"], 4, "those of the batch");
    let order: Vec<Uuid> = [0, 1, 2, 4]
        .into_iter()
        .zip(fixture.stored(batch, BatchPart::WHOLE).await.jobs)
        .map(|(position, job)| {
            assert_eq!(job.position, position);
            job.id
        })
        .collect();
    for id in order {
        assert_eq!(fixture.claimed(10).await.id, id);
    }
}

async fn all_refused_combinations_are_counted_and_the_first_are_stored(fixture: Fixture) {
    let expansion = NewExpansion {
        request: "{}".to_owned(),
        next: 0,
        jobs: 1_000,
        cpu_s: None,
    };
    let batch = fixture.batch(Vec::new(), Some(expansion)).await;
    for positions in [0..60, 60..120, 120..180] {
        let refused = positions.clone().map(|position| RefusedChanges {
            position,
            overrides: changes(position),
            reason: "no".to_owned(),
        });
        let portion = Portion {
            batch,
            positions: positions.clone(),
            jobs: Vec::new(),
            refused: refused.collect(),
        };
        let extended = fixture.store.extend_batch(&portion).await;
        assert!(extended.expect("the store"));
    }
    let stored = fixture.stored(batch, BatchPart::WHOLE).await;
    assert_eq!(
        (stored.overview.refused, stored.overview.to_come),
        (180, 820)
    );
    let positions: Vec<u64> = stored.refused.iter().map(|one| one.position).collect();
    assert_eq!(positions, (0..100).collect::<Vec<_>>());
}

async fn a_cancelled_batch_queues_no_more(fixture: Fixture) {
    let store = &fixture.store;
    let batch = fixture.first_jobs().await;
    let claim = fixture.claimed(10).await;
    fixture.cancelled_batch(batch).await;
    assert!(!fixture.extended(batch, 2..4).await);
    let overview = fixture.stored(batch, BatchPart::WHOLE).await.overview;
    let counts = (overview.counts["cancelled"], overview.counts["running"]);
    assert_eq!((counts, overview.to_come), ((1, 1), 0));
    assert_eq!(store.demand().await.expect("the store").queued, 0);
    let state = store.lease_state(&claim).await.expect("the store");
    assert_eq!(state, LeaseState::of(Some(true)));
    let deleted = fixture.deleted_batch(batch).await;
    assert_eq!(deleted, Deleted::Active, "one runs");
    fixture
        .ended(&claim, &JobUpdate::default(), Transition::Cancel, 3)
        .await;
    let deleted = fixture.deleted_batch(batch).await;
    assert_eq!(deleted, Deleted::Done);
    let deleted = fixture.deleted_batch(batch).await;
    assert_eq!(deleted, Deleted::Missing);
    assert!(!fixture.extended(batch, 2..4).await);
}

async fn a_batch_with_jobs_to_come_is_not_deleted(fixture: Fixture) {
    let store = &fixture.store;
    let batch = fixture.first_jobs().await;
    for _ in 0..2 {
        let claim = fixture.claimed(10).await;
        fixture.ended_with(&claim, &JobUpdate::default()).await;
    }
    let deleted = fixture.deleted_batch(batch).await;
    assert_eq!(deleted, Deleted::Active);
    store.set_clock(1);
    store.count_time().await.expect("the store");
    let old = store.delete_older(Duration::ZERO).await;
    assert_eq!(old.expect("the store"), 2);
    assert!(store.has_batch(batch, false).await.expect("the store"));
    assert!(fixture.extended(batch, 2..5).await);
    fixture.cancelled_batch(batch).await;
    store.set_clock(2);
    store.count_time().await.expect("the store");
    let old = store.delete_older(Duration::ZERO).await;
    assert_eq!(old.expect("the store"), 3);
    assert!(!store.has_batch(batch, false).await.expect("the store"));
}

async fn a_large_batch_is_cancelled_and_deleted_in_several_transactions(fixture: Fixture) {
    let store = &fixture.store;
    let jobs = JOBS_AT_ONCE.unsigned_abs() + 1;
    let batch = fixture.batch(new_jobs(0..jobs), None).await;
    fixture.cancelled_batch(batch).await;
    let stored = fixture.stored(batch, BatchPart::WHOLE).await;
    assert_eq!(stored.overview.counts["cancelled"], jobs);
    assert_eq!(stored.overview.asked, None);
    let noted = store.note_deletion(batch).await.expect("the store");
    assert_eq!(noted, Deleted::Done);
    // The batch is hidden, although its jobs still exist; a second request finds none.
    assert!(!store.has_batch(batch, false).await.expect("the store"));
    let filter = BatchFilter {
        with_plan: false,
        before: None,
        limit: 10,
    };
    assert_eq!(store.batches(filter).await.expect("the store"), []);
    let noted = store.note_deletion(batch).await.expect("the store");
    assert_eq!(noted, Deleted::Missing);
    assert_eq!(
        store.count(&Filter::default()).await.expect("the store"),
        jobs
    );
    fixture.ended_jobs_of_batches().await;
    assert_eq!(store.count(&Filter::default()).await.expect("the store"), 0);
}

async fn a_batch_whose_job_is_queued_again_meanwhile_is_not_deleted(fixture: Fixture) {
    let store = &fixture.store;
    let batch = fixture.first_jobs().await;
    fixture.cancelled_batch(batch).await;
    let overview = fixture.stored(batch, BatchPart::WHOLE).await.overview;
    assert_eq!(overview.never_queued, JOBS - 2);
    let job = fixture.stored(batch, BatchPart::WHOLE).await.jobs[0].id;
    store.note_deletion(batch).await.expect("the store");
    store.retry(job).await.expect("the store");
    fixture.ended_jobs_of_batches().await;
    assert!(store.has_batch(batch, false).await.expect("the store"));
    assert_eq!(fixture.stored(batch, BatchPart::WHOLE).await.jobs.len(), 2);
}
