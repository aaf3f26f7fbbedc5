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
        let resolved = translate::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let plan = translate::plan(&resolved);
        self.store
            .submit(
                &NewJob {
                    spec: resolved.spec,
                    plan,
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
