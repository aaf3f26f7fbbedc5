//! Fencing, attempts, events and ends.

use super::*;

on_both_engines! { Fixture:
    a_worker_that_lost_its_lease_writes_nothing,
    a_job_whose_workers_are_lost_fails_after_its_last_attempt,
    an_attempt_that_left_a_checkpoint_does_not_count,
    giving_a_job_back_costs_no_attempt,
    a_job_with_a_cancel_request_gets_no_further_attempt,
    event_numbers_have_no_gaps,
    every_kind_of_end_is_counted,
}

async fn a_worker_that_lost_its_lease_writes_nothing(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let stale = fixture.claimed(10).await;
    assert_eq!(fixture.reclaimed(10).await, 1);
    let fresh = fixture.claimed(100).await;
    assert_eq!((stale.id, fresh.id), (id, id));
    assert!(fresh.lease > stale.lease);

    assert_eq!(
        fixture.recorded(&stale, &update(7), 50).await,
        LeaseState::Lost
    );
    assert_eq!(
        store.lease_state(&stale).await.expect("the store"),
        LeaseState::Lost
    );
    assert_eq!(
        fixture
            .ended(&stale, &update(8), Transition::Succeed, 60)
            .await,
        None
    );
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
    assert_eq!(fixture.job(id).await.status, Status::Running);

    let held = fixture.recorded(&fresh, &update(1), 100).await;
    assert_eq!(
        held,
        LeaseState::Held {
            cancel_requested: false
        }
    );
    let status = fixture
        .ended(&fresh, &update(2), Transition::Succeed, 60)
        .await;
    assert_eq!(status, Some(Status::Succeeded));
    assert_eq!(fixture.cycles(id).await, [1, 2]);
    assert_eq!(
        fixture.recorded(&fresh, &update(3), 100).await,
        LeaseState::Lost
    );
    assert_eq!(fixture.job(id).await.outcome, Some(Outcome::Completed));
}

async fn a_job_whose_workers_are_lost_fails_after_its_last_attempt(fixture: Fixture) {
    let id = fixture.queued().await;
    for attempt in 1..=ATTEMPT_LIMIT {
        assert_eq!(fixture.claimed(10).await.id, id);
        assert_eq!(fixture.reclaimed(9).await, 0, "the lease still holds");
        assert_eq!(fixture.reclaimed(10).await, 1);
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
            .starts_with("worker_lost: 3 attempts without a new checkpoint")
    );
    let events = fixture.store.events(id, 0).await.expect("the store");
    assert_eq!(events.last().expect("an event").name, "done");
}

async fn an_attempt_that_left_a_checkpoint_does_not_count(fixture: Fixture) {
    let id = fixture.queued().await;
    let checkpoint = |cycle| JobUpdate {
        checkpoint: Some(EncodedCheckpoint {
            cycle,
            state: vec![7],
        }),
        ..update(cycle)
    };
    for attempt in 1..=2 * ATTEMPT_LIMIT {
        let claim = fixture.claimed(10).await;
        fixture
            .recorded(&claim, &checkpoint(u64::from(attempt)), 10)
            .await;
        assert_eq!(fixture.reclaimed(10).await, 1);
        let job = fixture.job(id).await;
        assert_eq!((job.status, job.attempts), (Status::Queued, attempt));
        let reason = job.status_reason.expect("a reason");
        assert!(
            reason.contains("continues from its last checkpoint"),
            "{reason}"
        );
    }
    for _ in 0..ATTEMPT_LIMIT {
        fixture.claimed(10).await;
        fixture.reclaimed(10).await;
    }
    let job = fixture.job(id).await;
    assert_eq!(
        (job.status, job.attempts),
        (Status::Failed, 3 * ATTEMPT_LIMIT)
    );
}

async fn giving_a_job_back_costs_no_attempt(fixture: Fixture) {
    let id = fixture.queued().await;
    for _ in 0..ATTEMPT_LIMIT {
        for transition in [Transition::Release, Transition::Decline] {
            let claim = fixture.claimed(10).await;
            let status = fixture
                .ended(&claim, &JobUpdate::default(), transition, 2)
                .await;
            assert_eq!(status, Some(Status::Queued));
        }
    }
    let job = fixture.job(id).await;
    assert_eq!((job.status, job.attempts), (Status::Queued, 0));
}

async fn a_job_with_a_cancel_request_gets_no_further_attempt(fixture: Fixture) {
    let id = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    assert_eq!(
        fixture.store.cancel(id).await.expect("the store"),
        Some(Cancelled::Requested)
    );
    let held = fixture.recorded(&claim, &update(1), 10).await;
    assert_eq!(
        held,
        LeaseState::Held {
            cancel_requested: true
        }
    );
    assert_eq!(fixture.reclaimed(10).await, 1);
    assert_eq!(fixture.job(id).await.status, Status::Cancelled);
    assert_eq!(fixture.cycles(id).await, [1]);
    assert_eq!(
        fixture.store.cancel(id).await.expect("the store"),
        Some(Cancelled::Already)
    );
}

async fn event_numbers_have_no_gaps(fixture: Fixture) {
    let id = fixture.queued().await;
    let lost = fixture.claimed(10).await;
    fixture.recorded(&lost, &update(1), 10).await;
    fixture.reclaimed(10).await;
    fixture.recorded(&lost, &update(2), 10).await;
    let claim = fixture.claimed(10).await;
    fixture.recorded(&claim, &update(1), 10).await;
    fixture
        .ended(&claim, &JobUpdate::default(), Transition::Fail, 3)
        .await;
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

async fn every_kind_of_end_is_counted(fixture: Fixture) {
    let store = &fixture.store;
    let cancelled = fixture.queued().await;
    store.cancel(cancelled).await.expect("the store");
    store.cancel(cancelled).await.expect("the store");
    let late = SubmitOptions {
        priority: 0,
        deadline_s: Some(1),
    };
    fixture.queued_with(late).await;
    store.set_clock(1_000);
    store.expire().await.expect("the store");
    store.set_clock(0);
    fixture.queued().await;
    for _ in 0..ATTEMPT_LIMIT {
        fixture.claimed(10).await;
        fixture.reclaimed(10).await;
    }
    let gauges = store.gauges().await.expect("the store");
    let text = store.metrics().text(&gauges).expect("text");
    for line in [
        "fretwear_jobs_ended_total{status=\"cancelled\"} 1",
        "fretwear_jobs_ended_total{status=\"failed\"} 2",
    ] {
        assert!(text.lines().any(|found| found == line), "{line} in\n{text}");
    }
}
