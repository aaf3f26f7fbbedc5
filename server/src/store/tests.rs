//! The queue over a real database: fencing, contention, rescue, restarts.

use std::sync::Arc;

use api::job::{Outcome, Status};
use api::results::CycleRow;
use tempfile::TempDir;
use tokio::sync::Barrier;
use uuid::Uuid;

use super::*;
use crate::http::tests::row;
use crate::queue::{ATTEMPT_LIMIT, Move};
use crate::translate;

struct Fixture {
    store: Arc<Store>,
    url: String,
    folder: TempDir,
}

impl Fixture {
    async fn new() -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        let url = format!(
            "sqlite://{}",
            folder.path().join("deep/er/test.db").display()
        );
        let store = Arc::new(Store::open(&url).await.expect("a store"));
        Self { store, url, folder }
    }

    async fn queued(&self) -> Uuid {
        self.wished(Wishes::default()).await
    }

    async fn wished(&self, wishes: Wishes) -> Uuid {
        let resolved = translate::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let plan = translate::plan(&resolved);
        self.store
            .submit(
                &NewJob {
                    spec: resolved.spec,
                    plan,
                    wishes,
                },
                0,
            )
            .await
            .expect("queued")
    }

    async fn claimed(&self, expires_at: i64) -> Claim {
        self.store
            .claim(1, expires_at)
            .await
            .expect("the store")
            .expect("a job")
    }

    async fn job(&self, id: Uuid) -> api::job::Job {
        self.store
            .job(id)
            .await
            .expect("the store")
            .expect("a job")
            .document
    }

    async fn cycles(&self, id: Uuid) -> Vec<u64> {
        self.store
            .history(id)
            .await
            .expect("the store")
            .iter()
            .map(|row: &CycleRow| row.cycle)
            .collect()
    }
}

fn batch(cycle: u64) -> Batch {
    Batch {
        rows: vec![row(cycle)],
        events: vec![("cycle", "{}".to_owned())],
        ..Batch::default()
    }
}

fn end(step: Move) -> End {
    End {
        step,
        reason: Some("because".to_owned()),
        outcome: Some(Outcome::Completed),
        summary: None,
    }
}

#[tokio::test]
async fn a_worker_that_lost_its_lease_writes_nothing() {
    let fixture = Fixture::new().await;
    let (id, store) = (fixture.queued().await, &fixture.store);
    let stale = fixture.claimed(10).await;
    assert_eq!(store.rescue_expired(10).await.expect("the store"), 1);
    let fresh = fixture.claimed(100).await;
    assert_eq!((stale.id, fresh.id), (id, id));
    assert!(fresh.lease > stale.lease);

    assert_eq!(
        store
            .record(&stale, &batch(7), 50)
            .await
            .expect("the store"),
        Held::No
    );
    assert_eq!(store.held(&stale).await.expect("the store"), Held::No);
    assert_eq!(
        store
            .end(&stale, &batch(8), &end(Move::Succeed), 60)
            .await
            .expect("the store"),
        None
    );
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
    assert_eq!(fixture.job(id).await.status, Status::Running);

    let held = store
        .record(&fresh, &batch(1), 100)
        .await
        .expect("the store");
    assert_eq!(
        held,
        Held::Yes {
            cancel_requested: false
        }
    );
    let status = store
        .end(&fresh, &batch(2), &end(Move::Succeed), 60)
        .await
        .expect("the store");
    assert_eq!(status, Some(Status::Succeeded));
    assert_eq!(fixture.cycles(id).await, [1, 2]);
    assert_eq!(
        store
            .record(&fresh, &batch(3), 100)
            .await
            .expect("the store"),
        Held::No
    );
    assert_eq!(fixture.job(id).await.outcome, Some(Outcome::Completed));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn contending_workers_never_share_a_job() {
    const JOBS: usize = 40;
    const WORKERS: usize = 8;
    let fixture = Fixture::new().await;
    for _ in 0..JOBS {
        fixture.queued().await;
    }
    let barrier = Arc::new(Barrier::new(WORKERS));
    let workers = (0..WORKERS).map(|_| {
        let (store, barrier) = (Arc::clone(&fixture.store), Arc::clone(&barrier));
        tokio::spawn(async move {
            barrier.wait().await;
            let mut taken = Vec::new();
            while let Some(claim) = store.claim(1, i64::MAX).await.expect("the store") {
                store
                    .record(&claim, &batch(1), i64::MAX)
                    .await
                    .expect("the store");
                taken.push(claim.id);
            }
            taken
        })
    });
    let mut taken = Vec::new();
    for worker in workers.collect::<Vec<_>>() {
        taken.extend(worker.await.expect("a worker"));
    }
    taken.sort();
    taken.dedup();
    assert_eq!(taken.len(), JOBS);
}

#[tokio::test]
async fn the_oldest_job_is_taken_first() {
    let fixture = Fixture::new().await;
    let first = fixture.queued().await;
    let second = fixture.queued().await;
    assert_eq!(fixture.claimed(10).await.id, first);
    assert_eq!(fixture.claimed(10).await.id, second);
    assert_eq!(fixture.store.claim(1, 10).await.expect("the store"), None);
}

#[tokio::test]
async fn a_job_whose_workers_are_lost_fails_after_its_last_attempt() {
    let fixture = Fixture::new().await;
    let id = fixture.queued().await;
    for attempt in 1..=ATTEMPT_LIMIT {
        assert_eq!(fixture.claimed(10).await.id, id);
        assert_eq!(
            fixture.store.rescue_expired(9).await.expect("the store"),
            0,
            "the lease still holds"
        );
        assert_eq!(
            fixture.store.rescue_expired(10).await.expect("the store"),
            1
        );
        assert_eq!(fixture.job(id).await.attempts, attempt);
    }
    let job = fixture.job(id).await;
    assert_eq!(
        (job.status, job.outcome),
        (Status::Failed, Some(Outcome::WorkerLost))
    );
    assert!(
        job.status_reason
            .expect("a reason")
            .starts_with("worker_lost: 3 attempts")
    );
    let events = fixture.store.events(id, 0).await.expect("the store");
    assert_eq!(events.last().expect("an event").name, "done");
}

#[tokio::test]
async fn giving_a_job_back_costs_no_attempt() {
    let fixture = Fixture::new().await;
    let id = fixture.queued().await;
    for _ in 0..2 * ATTEMPT_LIMIT {
        let claim = fixture.claimed(10).await;
        let status = fixture
            .store
            .end(&claim, &Batch::default(), &end(Move::GiveBack), 2)
            .await
            .expect("the store");
        assert_eq!(status, Some(Status::Queued));
    }
    let job = fixture.job(id).await;
    assert_eq!((job.status, job.attempts), (Status::Queued, 0));
}

#[tokio::test]
async fn a_second_attempt_starts_with_an_empty_history() {
    let fixture = Fixture::new().await;
    let id = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    fixture
        .store
        .record(&claim, &batch(5), 10)
        .await
        .expect("the store");
    fixture.store.rescue_expired(10).await.expect("the store");
    assert_eq!(
        fixture.cycles(id).await,
        [5],
        "what was computed stays readable while it waits"
    );
    fixture.claimed(10).await;
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
}

fn saved(cycle: u64) -> Batch {
    Batch {
        rows: (1..=cycle + 1).map(row).collect(),
        checkpoint: Some(NewCheckpoint {
            cycle,
            state: b"a state".to_vec(),
        }),
        ..Batch::default()
    }
}

#[tokio::test]
async fn another_attempt_goes_on_from_the_checkpoint_and_keeps_what_came_before() {
    let fixture = Fixture::new().await;
    let (id, store) = (fixture.queued().await, &fixture.store);
    let lost = fixture.claimed(10).await;
    store.record(&lost, &saved(3), 10).await.expect("the store");
    store.rescue_expired(10).await.expect("the store");
    let late = store.record(&lost, &saved(9), 10).await;
    assert_eq!(late.expect("the store"), Held::No);
    let claim = fixture.claimed(20).await;
    let checkpoint = claim.checkpoint.clone().expect("a checkpoint");
    assert_eq!(
        (checkpoint.cycle, checkpoint.state),
        (3, b"a state".to_vec())
    );
    assert_eq!(fixture.cycles(id).await, [1, 2, 3]);
    let events = store.events(id, 0).await.expect("the store");
    let last = events.last().expect("an event");
    assert_eq!(
        (last.name.as_str(), last.data.as_str()),
        ("attempt", r#"{"attempt":2,"from_cycle":3}"#)
    );
    // The child may find that it cannot go on from it.
    store.begin_anew(&claim).await.expect("the store");
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
    let events = store.events(id, 3).await.expect("the store");
    assert_eq!(events[0].data, r#"{"attempt":2,"from_cycle":0}"#);
    store.rescue_expired(20).await.expect("the store");
    assert_eq!(fixture.claimed(30).await.checkpoint, None);
}

#[tokio::test]
async fn a_damaged_checkpoint_is_noticed_and_the_job_begins_anew() {
    let fixture = Fixture::new().await;
    let (id, store) = (fixture.queued().await, &fixture.store);
    let claim = fixture.claimed(10).await;
    store
        .record(&claim, &saved(3), 10)
        .await
        .expect("the store");
    sqlx::query("UPDATE checkpoints SET state = X'00'")
        .execute(&store.writer)
        .await
        .expect("damage");
    store.rescue_expired(10).await.expect("the store");
    let claim = fixture.claimed(20).await;
    assert_eq!(claim.checkpoint, None);
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
}

#[tokio::test]
async fn a_preferred_job_goes_first_and_a_large_one_says_what_it_waits_for() {
    let fixture = Fixture::new().await;
    let plain = fixture.queued().await;
    let preferred = fixture
        .wished(Wishes {
            priority: 1,
            deadline_s: None,
        })
        .await;
    assert_eq!(fixture.claimed(10).await.id, preferred);
    let claimed = fixture.store.claim_within(1, 1, 10).await;
    assert_eq!(claimed.expect("the store"), None);
    let reason = fixture.job(plain).await.status_reason.expect("a reason");
    assert!(
        reason.starts_with("waiting for memory: it needs about ")
            && reason.ends_with(", 0 of 1 MB are left"),
        "{reason}"
    );
    assert_eq!(fixture.claimed(10).await.id, plain);
}

#[tokio::test]
async fn a_deadline_ends_a_waiting_job_and_only_old_ends_are_deleted() {
    let fixture = Fixture::new().await;
    let wishes = Wishes {
        priority: 0,
        deadline_s: Some(5),
    };
    let late = fixture.wished(wishes).await;
    assert_eq!(fixture.store.expire(4_999).await.expect("the store"), 0);
    assert_eq!(fixture.store.expire(5_000).await.expect("the store"), 1);
    let job = fixture.job(late).await;
    assert_eq!(
        (job.status, job.outcome),
        (Status::Failed, Some(Outcome::DeadlineExceeded))
    );
    fixture.queued().await;
    let deleted = fixture.store.delete_ended_before(5_000).await;
    assert_eq!(deleted.expect("the store"), 0);
    let deleted = fixture.store.delete_ended_before(5_001).await;
    assert_eq!(deleted.expect("the store"), 1);
    assert!(fixture.store.job(late).await.expect("the store").is_none());
}

#[tokio::test]
async fn an_unwanted_job_is_not_tried_again() {
    let fixture = Fixture::new().await;
    let id = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    assert_eq!(
        fixture.store.cancel(id, 2).await.expect("the store"),
        Some(Cancelled::Requested)
    );
    let held = fixture
        .store
        .record(&claim, &batch(1), 10)
        .await
        .expect("the store");
    assert_eq!(
        held,
        Held::Yes {
            cancel_requested: true
        }
    );
    assert_eq!(
        fixture.store.rescue_expired(10).await.expect("the store"),
        1
    );
    assert_eq!(fixture.job(id).await.status, Status::Cancelled);
    assert_eq!(fixture.cycles(id).await, [1]);
    assert_eq!(
        fixture.store.cancel(id, 3).await.expect("the store"),
        Some(Cancelled::Already)
    );
}

#[tokio::test]
async fn event_numbers_have_no_gaps() {
    let fixture = Fixture::new().await;
    let id = fixture.queued().await;
    let lost = fixture.claimed(10).await;
    fixture
        .store
        .record(&lost, &batch(1), 10)
        .await
        .expect("the store");
    fixture.store.rescue_expired(10).await.expect("the store");
    fixture
        .store
        .record(&lost, &batch(2), 10)
        .await
        .expect("the store");
    let claim = fixture.claimed(10).await;
    fixture
        .store
        .record(&claim, &batch(1), 10)
        .await
        .expect("the store");
    fixture
        .store
        .end(&claim, &Batch::default(), &end(Move::Fail), 3)
        .await
        .expect("the store");
    let events = fixture.store.events(id, 0).await.expect("the store");
    let found: Vec<_> = events
        .iter()
        .map(|event| (event.seq, event.name.as_str()))
        .collect();
    assert_eq!(
        found,
        [
            (1, "progress"),
            (2, "attempt"),
            (3, "cycle"),
            (4, "attempt"),
            (5, "cycle"),
            (6, "done")
        ]
    );
}

#[tokio::test]
async fn a_database_is_served_by_one_process_and_survives_it() {
    let Fixture { store, url, folder } = Fixture::new().await;
    assert!(matches!(
        Store::open(&url).await,
        Err(StoreError::Locked { .. })
    ));
    // Another name of the same file is the same database.
    let path = url.trim_start_matches("sqlite://");
    let link = format!("{path}.link");
    std::os::unix::fs::symlink(path, &link).expect("a link can be made");
    assert!(matches!(
        Store::open(&format!("sqlite://{link}")).await,
        Err(StoreError::Locked { .. })
    ));
    let fixture = Fixture { store, url, folder };
    let id = fixture.queued().await;
    fixture.claimed(i64::MAX).await;
    let Fixture { store, url, folder } = fixture;
    store.close().await;
    drop(store);
    let store = Arc::new(Store::open(&url).await.expect("free again"));
    let fixture = Fixture { store, url, folder };
    assert_eq!(fixture.store.rescue_all(5).await.expect("the store"), 1);
    assert_eq!(fixture.claimed(10).await.id, id);
    assert_eq!(fixture.job(id).await.attempts, 2);
}

#[tokio::test]
async fn addresses_that_are_no_files_are_refused() {
    for url in [
        "postgres://x",
        "sqlite::memory:",
        "sqlite://x.db?mode=memory",
    ] {
        assert!(Store::open(url).await.is_err(), "{url}");
    }
}
