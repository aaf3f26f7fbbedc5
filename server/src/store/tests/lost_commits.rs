//! A database that has lost commits, by a failover or a restored backup, while the workers of its jobs continue.

use super::*;
use crate::export::documents::VTU;
use crate::export::files;
use crate::worker::JobSource;

on_both_engines! { Fixture:
    a_write_after_a_gap_has_no_effect,
    a_run_that_restarts_may_follow_a_gap,
    a_claim_that_was_lost_does_not_share_its_lease_with_the_next_one,
    a_job_whose_lease_was_ended_by_a_restore_waits_again_and_loses_no_attempt,
    an_update_that_names_a_missing_file_is_refused,
    a_job_does_not_succeed_with_missing_files,
    a_job_that_fails_marks_its_missing_files,
}

/// Writes a file of an attempt; returns the update that names it.
fn with_file(store: &Store, claim: &Claim, name: &str) -> JobUpdate {
    files::write_atomically(&store.attempt_folder(claim), name, b"fields").expect("written");
    JobUpdate {
        files: vec![NewFile {
            file: files::manifest_entry(name, Some(1), VTU, b"fields"),
            content: NewContent::Folder,
        }],
        ..with_checkpoint(3)
    }
}

const LENGTH: Duration = Duration::from_hours(1);

async fn a_write_after_a_gap_has_no_effect(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let claim = fixture.claimed(i64::MAX).await;
    let write = |number| JobUpdate {
        number,
        ..update(number.unsigned_abs())
    };
    let recorded = async |number| store.record(&claim, &write(number), LENGTH).await;
    let held = LeaseState::Held {
        cancel_requested: false,
    };
    assert_eq!(recorded(1).await.expect("the store"), held);
    assert_eq!(recorded(3).await.expect("the store"), LeaseState::Lost);
    let ended = store
        .end(&claim, &write(3), &end(Transition::Succeed))
        .await;
    assert_eq!(ended.expect("the store"), None);
    assert_eq!(fixture.cycles(id).await, [1]);
    assert_eq!(fixture.job(id).await.status, Status::Running);
    // A repeated one has no effect either, and its lease is held.
    assert_eq!(recorded(1).await.expect("the store"), held);
    assert_eq!(recorded(2).await.expect("the store"), held);
    let ended = store
        .end(&claim, &write(3), &end(Transition::Succeed))
        .await;
    assert_eq!(ended.expect("the store"), Some(Status::Succeeded));
    assert_eq!(fixture.cycles(id).await, [1, 2, 3]);
    let events = store.events(id, 0).await.expect("the store");
    assert_eq!(events.len(), 5, "{events:?}");
}

async fn a_run_that_restarts_may_follow_a_gap(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let claim = fixture.claimed(i64::MAX).await;
    let held = LeaseState::Held {
        cancel_requested: false,
    };
    // The first update could not be recorded, and is not needed any more.
    assert_eq!(store.restart(&claim, 2).await.expect("the store"), held);
    let second = JobUpdate {
        number: 3,
        ..update(1)
    };
    let recorded = store.record(&claim, &second, LENGTH).await;
    assert_eq!(recorded.expect("the store"), held);
    let late = JobUpdate {
        number: 1,
        ..update(7)
    };
    let recorded = store.record(&claim, &late, LENGTH).await;
    assert_eq!(recorded.expect("the store"), held);
    assert_eq!(fixture.cycles(id).await, [1], "it has no effect");
}

async fn a_claim_that_was_lost_does_not_share_its_lease_with_the_next_one(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let lost = fixture.claimed(i64::MAX).await;
    let forgotten = "UPDATE jobs SET status = 'queued', lease = 0, lease_expires_at = NULL, attempts = 0, fruitless = 0, \
        started_at = NULL, worker = NULL, claim_number = NULL, last_event = 1";
    fixture.execute(forgotten).await;
    fixture.execute("DELETE FROM events WHERE seq > 1").await;
    let claim = fixture.claimed(i64::MAX).await;
    assert_eq!((lost.id, claim.id), (id, id));
    assert_ne!(lost.lease, claim.lease);
    let recorded = store.record_next(&lost, &update(1)).await;
    assert_eq!(recorded, LeaseState::Lost);
    let succeed = end(Transition::Succeed);
    assert_eq!(store.end_next(&lost, &update(1), &succeed).await, None);
    let ended = store.end_next(&claim, &update(1), &succeed).await;
    assert_eq!(ended, Some(Status::Succeeded));
}

async fn a_job_whose_lease_was_ended_by_a_restore_waits_again_and_loses_no_attempt(
    fixture: Fixture,
) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    for _ in 0..2 * ATTEMPT_LIMIT {
        let claim = fixture.claimed(i64::MAX).await;
        let recorded = store.record_next(&claim, &update(1)).await;
        assert_ne!(recorded, LeaseState::Lost);
        let restored = "UPDATE jobs SET lease = lease + 7, lease_expires_at = -1, is_remote = TRUE WHERE status = 'running'";
        fixture.execute(restored).await;
        let recorded = store.record_next(&claim, &update(2)).await;
        assert_eq!(recorded, LeaseState::Lost);
        let length = Duration::from_secs(1);
        let mut reclaimed = store.reclaim_at_start(length, LENGTH).await;
        if store.is_shared() {
            reclaimed = store.reclaim_expired(length).await;
        }
        assert_eq!(reclaimed.expect("the store").queued, 1);
        let job = fixture.job(id).await;
        assert_eq!((job.status, job.attempts), (Status::Queued, 0));
        let reason = job.status_reason.expect("a reason");
        assert!(reason.contains("was restored"), "{reason}");
    }
}

async fn an_update_that_names_a_missing_file_is_refused(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let claim = fixture.claimed(i64::MAX).await;
    let mut update = with_file(store, &claim, "a.vtu");
    update.number = 1;
    let path = store.attempt_folder(&claim).join("a.vtu");
    for change in [b"field".as_slice(), b""] {
        std::fs::write(&path, change).expect("written");
        let recorded = store.record(&claim, &update, LENGTH).await;
        assert!(
            matches!(recorded, Err(StoreError::NoFile { .. })),
            "{recorded:?}"
        );
    }
    std::fs::remove_file(&path).expect("removed");
    let ended = store.end(&claim, &update, &end(Transition::Succeed)).await;
    assert!(matches!(ended, Err(StoreError::NoFile { .. })), "{ended:?}");
    assert_eq!(store.manifest(id).await.expect("the store"), []);
    // The file is sent again.
    std::fs::write(&path, b"fields").expect("written");
    let recorded = store.record(&claim, &update, LENGTH).await;
    assert_ne!(recorded.expect("the store"), LeaseState::Lost);
    std::fs::remove_file(&path).expect("removed");
    let lost = Lease {
        number: claim.lease + 1,
        ..Lease::from(&claim)
    };
    let recorded = store.record(lost, &update, LENGTH).await;
    assert_eq!(recorded.expect("the store"), LeaseState::Lost);
}

async fn a_job_does_not_succeed_with_missing_files(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    for attempt in 1..=ATTEMPT_LIMIT {
        let claim = fixture.claimed(i64::MAX).await;
        assert_eq!((claim.attempt, &claim.checkpoint), (attempt, &None));
        for name in ["a.vtu", "b.vtu"] {
            let update = with_file(store, &claim, name);
            store.record_next(&claim, &update).await;
        }
        std::fs::remove_file(store.attempt_folder(&claim).join("b.vtu")).expect("removed");
        let last = numbered(&claim, JobUpdate::default());
        for answer in 0..2 {
            let succeed = end(Transition::Succeed);
            let ended = JobSource::finish(&**store, (&claim).into(), &last, &succeed).await;
            let expected = match (answer, attempt) {
                (1, _) => None,
                (_, ATTEMPT_LIMIT) => Some(Status::Failed),
                _ => Some(Status::Queued),
            };
            assert_eq!(ended.expect("the store"), expected);
        }
        let reason = fixture.job(id).await.status_reason.expect("a reason");
        assert!(
            reason.contains("1 of the files of its results do not exist, among them b.vtu"),
            "{reason}"
        );
        assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
    }
    // A retry solves it from the start, with all files.
    store.retry(id).await.expect("the store");
    let claim = fixture.claimed(i64::MAX).await;
    assert_eq!(claim.checkpoint, None);
    let update = with_file(store, &claim, "b.vtu");
    store.record_next(&claim, &update).await;
    let last = numbered(&claim, JobUpdate::default());
    let succeed = end(Transition::Succeed);
    let ended = JobSource::finish(&**store, (&claim).into(), &last, &succeed).await;
    assert_eq!(ended.expect("the store"), Some(Status::Succeeded));
}

async fn a_job_that_fails_marks_its_missing_files(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let claim = fixture.claimed(i64::MAX).await;
    for name in ["a.vtu", "b.vtu"] {
        let update = with_file(store, &claim, name);
        store.record_next(&claim, &update).await;
    }
    std::fs::remove_file(store.attempt_folder(&claim).join("b.vtu")).expect("removed");
    let last = numbered(&claim, JobUpdate::default());
    let ended = JobSource::finish(&**store, (&claim).into(), &last, &end(Transition::Fail)).await;
    assert_eq!(ended.expect("the store"), Some(Status::Failed));
    let manifest = store.manifest(id).await.expect("the store");
    let damaged = manifest.iter().filter(|file| file.damaged.is_some());
    let damaged: Vec<_> = damaged.map(|file| file.name.as_str()).collect();
    assert_eq!(damaged, ["b.vtu"]);
}
