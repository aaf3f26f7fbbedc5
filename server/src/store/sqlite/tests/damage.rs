//! Damaged checkpoints, and transactions that SQLite ends by itself.

use crate::store::sqlite::queries::BEGIN;
use crate::store::tests::{Fixture, with_checkpoint};

#[tokio::test]
async fn a_damaged_checkpoint_is_detected_and_the_job_restarts_at_cycle_0() {
    let fixture = Fixture::new().await;
    let (id, store) = (fixture.queued().await, &fixture.store);
    let claim = fixture.claimed(10).await;
    fixture.recorded(&claim, &with_checkpoint(3), 10).await;
    sqlx::query("UPDATE checkpoints SET state = X'00'")
        .execute(&store.sqlite().writer)
        .await
        .expect("damage");
    fixture.reclaimed(10).await;
    let claim = fixture.claimed(20).await;
    assert_eq!(claim.checkpoint, None);
    assert_eq!(fixture.cycles(id).await, Vec::<u64>::new());
}

#[tokio::test]
async fn a_transaction_ended_by_sqlite_does_not_block_later_writes() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    let mut transaction = store.sqlite().writer.begin_with(BEGIN).await;
    // As SQLite does when the disk is full.
    let ended = sqlx::query("ROLLBACK").execute(transaction.as_deref_mut().expect("begun"));
    ended.await.expect("ended");
    drop(transaction);
    let id = fixture.queued().await;
    assert_eq!(fixture.claimed(10).await.id, id);
}
