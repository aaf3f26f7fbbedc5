//! Writes that meet.

use std::sync::Arc;

use sqlx::{Connection, Executor, PgConnection};
use tokio::task::JoinSet;

use super::*;

on_both_engines! { Fixture:
    writes_that_meet_are_whole,
}

const JOBS: usize = 30;

/// A fixture with jobs that are claimed.
async fn claimed(fixture: &Fixture) -> Vec<Claim> {
    let mut claims = Vec::new();
    for _ in 0..JOBS {
        fixture.queued().await;
        claims.push(fixture.claimed(i64::MAX).await);
    }
    claims
}

/// Records an update, twice at once: the second is a repeated request.
async fn recorded_twice(
    store: Arc<Store>,
    claim: Claim,
    update: JobUpdate,
) -> [Result<LeaseState, StoreError>; 2] {
    let length = Duration::from_hours(1);
    let (first, second) = tokio::join!(
        store.record(&claim, &update, length),
        store.record(&claim, &update, length)
    );
    [first, second]
}

/// Updates of all jobs at once, each twice, then all ends: each job has the events of its own, once, in their order.
async fn writes_that_meet_are_whole(fixture: Fixture) {
    const HELD: LeaseState = LeaseState::Held {
        cancel_requested: false,
    };
    let claims = claimed(&fixture).await;
    let mut recording = JoinSet::new();
    for (cycle, claim) in (1..).zip(&claims) {
        let update = numbered(claim, update(cycle));
        let store = Arc::clone(&fixture.store);
        recording.spawn(recorded_twice(store, claim.clone(), update));
    }
    while let Some(states) = recording.join_next().await {
        for state in states.expect("no panic") {
            assert_eq!(state.expect("the store"), HELD);
        }
    }
    let mut ending = JoinSet::new();
    for (number, claim) in claims.iter().enumerate() {
        let (store, claim) = (Arc::clone(&fixture.store), claim.clone());
        // Some jobs are released.
        let transition = match number % 3 {
            0 => Transition::Release,
            _ => Transition::Succeed,
        };
        ending.spawn(async move {
            let update = numbered(&claim, update(100));
            let first = store.end(&claim, &update, &end(transition)).await;
            let again = store.end(&claim, &update, &end(transition)).await;
            assert_eq!(
                first.as_ref().expect("the store"),
                again.as_ref().expect("the store")
            );
            (number, first.expect("the store"))
        });
    }
    while let Some(ended) = ending.join_next().await {
        let (number, status) = ended.expect("no panic");
        let expected = match number % 3 {
            0 => Status::Queued,
            _ => Status::Succeeded,
        };
        assert_eq!(status, Some(expected));
    }
    for (number, claim) in claims.iter().enumerate() {
        let events = fixture.store.events(claim.id, 0).await.expect("the store");
        let names: Vec<_> = events.iter().map(|event| event.name.as_str()).collect();
        let expected: &[_] = match number % 3 {
            0 => &["progress", "attempt", "cycle"],
            _ => &["progress", "attempt", "cycle", "done"],
        };
        assert_eq!(names, expected);
        assert!(
            events
                .iter()
                .map(|event| event.seq)
                .eq(1..=i64::try_from(names.len()).expect("few"))
        );
        let cycle = u64::try_from(number).expect("few") + 1;
        assert_eq!(fixture.cycles(claim.id).await, [cycle, 100]);
    }
}

/// PostgreSQL has no texts with this character.
#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_write_that_cannot_be_stored_fails_alone() {
    let fixture = Fixture::at(Place::postgres()).await;
    let claims = claimed(&fixture).await;
    let mut recording = JoinSet::new();
    for (number, claim) in claims.iter().enumerate() {
        let mut update = numbered(claim, update(1));
        if number == 7 {
            update.events[0].1 = "\0".to_owned();
        }
        let (store, claim) = (Arc::clone(&fixture.store), claim.clone());
        recording.spawn(async move { (number, recorded_twice(store, claim, update).await) });
    }
    while let Some(recorded) = recording.join_next().await {
        let (number, states) = recorded.expect("no panic");
        for state in states {
            assert_eq!(state.is_err(), number == 7, "{number}: {state:?}");
        }
    }
    assert_eq!(fixture.cycles(claims[6].id).await, [1]);
    assert_eq!(fixture.cycles(claims[7].id).await, Vec::<u64>::new());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_write_to_a_locked_job_holds_up_no_other() {
    let fixture = Fixture::at(Place::postgres()).await;
    let claims = claimed(&fixture).await;
    let mut other = PgConnection::connect(&fixture.url).await.expect("a server");
    let locked = format!("SELECT FROM jobs WHERE id = '{}' FOR UPDATE", claims[3].id);
    other.execute("BEGIN").await.expect("a transaction");
    other
        .execute(sqlx::AssertSqlSafe(locked))
        .await
        .expect("the row is locked");
    let mut recording = JoinSet::new();
    for (number, claim) in claims.iter().enumerate() {
        let (store, claim) = (Arc::clone(&fixture.store), claim.clone());
        let update = numbered(&claim, update(1));
        recording.spawn(async move { (number, recorded_twice(store, claim, update).await) });
    }
    for _ in 1..JOBS {
        let recorded = recording.join_next().await.expect("a job");
        let (number, [first, second]) = recorded.expect("no panic");
        assert_ne!(number, 3, "it is locked");
        assert!(first.is_ok() && second.is_ok());
    }
    other.execute("ROLLBACK").await.expect("it is unlocked");
    let recorded = recording.join_next().await.expect("the locked job");
    let (number, [first, second]) = recorded.expect("no panic");
    assert_eq!(number, 3);
    assert!(first.is_ok() && second.is_ok());
    assert_eq!(fixture.cycles(claims[3].id).await, [1]);
}
