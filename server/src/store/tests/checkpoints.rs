//! What another attempt goes on from.

use super::*;

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
    fixture.rescued(10).await;
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
    fixture.rescued(10).await;
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
    fixture.rescued(20).await;
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
    fixture.rescued(10).await;
    let claim = fixture.claimed(20).await;
    assert_eq!(claim.checkpoint, None);
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
}
