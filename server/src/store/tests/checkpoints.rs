//! Checkpoints: what the next attempt resumes from.

use super::*;

on_both_engines! { Fixture:
    a_second_attempt_starts_with_an_empty_history,
    the_next_attempt_resumes_from_the_checkpoint_and_keeps_earlier_results,
}

async fn a_second_attempt_starts_with_an_empty_history(fixture: Fixture) {
    let id = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    fixture.recorded(&claim, &update(5), 10).await;
    fixture.reclaimed(10).await;
    assert_eq!(
        fixture.cycles(id).await,
        [5],
        "results stay readable while the job waits"
    );
    fixture.claimed(10).await;
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
}

async fn the_next_attempt_resumes_from_the_checkpoint_and_keeps_earlier_results(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let lost = fixture.claimed(10).await;
    fixture.recorded(&lost, &with_checkpoint(3), 10).await;
    fixture.reclaimed(10).await;
    let late = fixture.recorded(&lost, &with_checkpoint(9), 10).await;
    assert_eq!(late, LeaseState::Lost);
    let claim = fixture.claimed(20).await;
    let given = ClaimedCheckpoint::Given(EncodedCheckpoint {
        cycle: 3,
        state: b"a state".to_vec(),
    });
    assert_eq!(claim.checkpoint, Some(given));
    assert_eq!(fixture.cycles(id).await, [1, 2, 3]);
    let events = store.events(id, 0).await.expect("the store");
    let last = events.last().expect("an event");
    assert_eq!(
        (last.name.as_str(), last.data.as_str()),
        ("attempt", r#"{"attempt":2,"from_cycle":3}"#)
    );
    // The solving process may fail to resume from it.
    store.restart(&claim, 1).await.expect("the store");
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
    let events = store.events(id, 3).await.expect("the store");
    assert_eq!(events[0].data, r#"{"attempt":2,"from_cycle":0}"#);
    fixture.reclaimed(20).await;
    assert_eq!(fixture.claimed(30).await.checkpoint, None);
}
