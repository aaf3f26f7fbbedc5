//! Remote workers: those in contact with a service, and those that are drained.

use super::*;

on_both_engines! { Fixture:
    the_latest_contact_counts_and_a_silent_worker_is_forgotten,
    a_drained_worker_stays_drained_although_it_was_away,
    a_worker_is_listed_with_the_jobs_that_it_holds,
    a_job_that_a_worker_has_given_up_is_left_to_another_one_for_a_while,
}

fn contact(id: Uuid, free_memory_mb: i64, ago_s: u64) -> WorkerContact {
    WorkerContact {
        id,
        offer: Some(WorkerOffer {
            host: "n1".to_owned(),
            slots: 4,
            memory_mb: 8_000,
            free_memory_mb,
        }),
        failing: None,
        ago: Duration::from_secs(ago_s),
    }
}

impl Fixture {
    async fn noted(&self, contacts: &[WorkerContact]) {
        self.store.note_workers(contacts).await.expect("the store");
    }

    async fn workers(&self) -> Vec<api::worker::RemoteWorker> {
        self.store.workers().await.expect("the store")
    }
}

async fn the_latest_contact_counts_and_a_silent_worker_is_forgotten(fixture: Fixture) {
    let (first, second) = (Uuid::now_v7(), Uuid::now_v7());
    fixture.store.set_clock(100_000);
    fixture
        .noted(&[contact(first, 100, 5), contact(second, 200, 50)])
        .await;
    // Another service had an earlier contact with the first worker, and one receives heartbeats only.
    fixture.noted(&[contact(first, 300, 9)]).await;
    let beat = |id| WorkerContact {
        id,
        offer: None,
        failing: None,
        ago: Duration::from_secs(1),
    };
    fixture.noted(&[beat(first), beat(Uuid::now_v7())]).await;
    let found = fixture.workers().await;
    let shown = |worker: &api::worker::RemoteWorker| {
        (worker.id, worker.free_memory_mb, worker.last_contact_s)
    };
    let shown: Vec<_> = found.iter().map(shown).collect();
    assert_eq!(shown, [(first, 100, 1), (second, 200, 50)]);
    let gauges = fixture.store.gauges().await.expect("the store");
    assert_eq!(gauges.remote_slots, 8);
    fixture.store.set_clock(111_000);
    let left: Vec<_> = fixture.workers().await.iter().map(|one| one.id).collect();
    assert_eq!(left, [first]);
    let gauges = fixture.store.gauges().await.expect("the store");
    assert_eq!(gauges.remote_slots, 4);
    fixture.noted(&[contact(first, 100, 0)]).await;
    let drained = fixture.store.drain_worker(second).await;
    assert!(!drained.expect("the store"), "it is forgotten");
}

async fn a_drained_worker_stays_drained_although_it_was_away(fixture: Fixture) {
    let (worker, other) = (Uuid::now_v7(), Uuid::now_v7());
    fixture.store.set_clock(0);
    fixture.noted(&[contact(worker, 1, 0)]).await;
    assert!(fixture.store.drain_worker(worker).await.expect("the store"));
    assert!(fixture.store.drain_worker(worker).await.expect("the store"));
    let hour = 3_600_000;
    fixture.store.set_clock(hour);
    fixture.noted(&[contact(other, 1, 0)]).await;
    assert_eq!(fixture.workers().await.len(), 1);
    let drained = fixture.store.drain_worker(worker).await;
    assert!(!drained.expect("the store"), "it is away");
    fixture.noted(&[contact(worker, 1, 0)]).await;
    let draining = fixture.store.draining_workers().await;
    assert_eq!(draining.expect("the store"), [worker]);
    let is_draining: Vec<_> = fixture
        .workers()
        .await
        .iter()
        .map(|one| one.is_draining)
        .collect();
    assert_eq!(is_draining, [true, false]);
    let gauges = fixture.store.gauges().await.expect("the store");
    assert_eq!(gauges.remote_slots, 4, "those of the other one");
    fixture.store.set_clock(26 * hour);
    fixture.noted(&[contact(other, 1, 0)]).await;
    let draining = fixture.store.draining_workers().await;
    assert!(draining.expect("the store").is_empty());
}

async fn a_worker_is_listed_with_the_jobs_that_it_holds(fixture: Fixture) {
    fixture.queued().await;
    let asked = request(10_000, Duration::from_secs(9));
    let claims = fixture.store.claim(&asked).await.expect("the store");
    fixture.noted(&[contact(asked.request.worker, 1, 0)]).await;
    assert_eq!(fixture.workers().await[0].jobs, 1);
    fixture.ended_with(&claims[0], &JobUpdate::default()).await;
    assert_eq!(fixture.workers().await[0].jobs, 0);
}

/// A request for a job with the next number of all.
fn asks(worker: Uuid) -> ClaimRequest {
    static LAST: AtomicI64 = AtomicI64::new(0);
    let asked = request(10_000, Duration::from_secs(9));
    ClaimRequest {
        request: RequestNumber {
            worker,
            number: 1 + LAST.fetch_add(1, Ordering::Relaxed),
        },
        ..asked
    }
}

async fn a_job_that_a_worker_has_given_up_is_left_to_another_one_for_a_while(fixture: Fixture) {
    let [worker, other] = [Uuid::now_v7(), Uuid::now_v7()];
    let failing = WorkerContact {
        failing: Some("it starts no solves".to_owned()),
        ..contact(other, 1, 0)
    };
    let able = contact(other, 1, 0);
    let here = contact(worker, 1, 0);
    let claims = async |worker| {
        let claims = fixture.store.claim(&asks(worker)).await;
        claims.expect("the store").pop()
    };
    // Transition, workers in contact, time until the next claim, whether the job is left to the other one.
    let cases = [
        (Transition::Decline, vec![&here, &able], 0, true),
        (Transition::Decline, vec![&able], 29_000, true),
        (Transition::WorkerLost, vec![&here, &able], 0, true),
        (Transition::Release, vec![&here, &able], 0, false),
        (Transition::Decline, vec![&here], 0, false),
        (Transition::Decline, vec![&here, &failing], 0, false),
        (Transition::Decline, vec![&here, &able], 31_000, false),
    ];
    let mut now = 1_000_000;
    for (transition, there, waited, is_left) in cases {
        // Workers of the case before are away.
        now += 2 * 3_600_000;
        fixture.store.set_clock(now);
        let id = fixture.queued().await;
        let claim = claims(worker).await.expect("the job");
        let there: Vec<_> = there.into_iter().cloned().collect();
        fixture.noted(&there).await;
        let ended = fixture
            .ended(&claim, &JobUpdate::default(), transition, now)
            .await;
        assert_eq!(ended, Some(Status::Queued));
        fixture.store.set_clock(now + waited);
        let claimed = claims(worker).await;
        assert_eq!(
            claimed.is_none(),
            is_left,
            "{transition:?} {there:?} {waited}"
        );
        let claim = match claimed {
            Some(claim) => claim,
            None => claims(other).await.expect("the job"),
        };
        assert_eq!(claim.id, id);
        let update = JobUpdate::default();
        let end = fixture.ended(&claim, &update, Transition::Fail, now + waited);
        assert_eq!(end.await, Some(Status::Failed));
    }
}
