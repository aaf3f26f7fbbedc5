//! Specifications as they were sent.

use sqlx::{Connection, PgConnection, SqliteConnection};

use super::batches::new_jobs;
use super::*;
use crate::store::address::is_postgres;

on_both_engines! { Fixture:
    a_job_and_a_batch_have_what_was_sent_until_they_are_deleted,
    what_earlier_versions_have_queued_has_none,
}

/// Removes all of them, as if an earlier version had queued the jobs.
pub(crate) async fn forget_sent_specifications(url: &str) {
    for statement in [
        "DELETE FROM sent_specifications",
        "UPDATE sweeps SET base = NULL",
    ] {
        let removed = if is_postgres(url) {
            let mut database = PgConnection::connect(url).await.expect("a server");
            sqlx::query(statement)
                .execute(&mut database)
                .await
                .map(drop)
        } else {
            let mut database = SqliteConnection::connect(url).await.expect("a file");
            sqlx::query(statement)
                .execute(&mut database)
                .await
                .map(drop)
        };
        removed.expect("removed");
    }
}

async fn a_job_and_a_batch_have_what_was_sent_until_they_are_deleted(fixture: Fixture) {
    let store = &fixture.store;
    let alone = fixture.queued().await;
    let batch = fixture.batch(new_jobs(0..2), None).await;
    let part = (batch, BatchPart::WHOLE, BatchDetail::Statuses);
    let jobs = store
        .batch_jobs(part.0, part.1, part.2)
        .await
        .expect("the store");
    for id in jobs.iter().map(|job| job.id).chain([alone]) {
        let sent = store.sent_spec(id).await.expect("the store");
        assert_eq!(sent.as_deref(), Some(SENT));
        store.cancel(id).await.expect("the store");
        store.delete(id).await.expect("the store");
        assert_eq!(store.sent_spec(id).await.expect("the store"), None);
    }
    let base = store.sent_base(batch).await.expect("the store");
    assert_eq!(base.as_deref(), Some(SENT));
    store.note_deletion(batch).await.expect("the store");
    while store.delete_some(batch).await.expect("the store") {}
    assert_eq!(store.sent_base(batch).await.expect("the store"), None);
}

async fn what_earlier_versions_have_queued_has_none(fixture: Fixture) {
    let store = &fixture.store;
    let id = fixture.queued().await;
    let batch = fixture.batch(new_jobs(0..1), None).await;
    forget_sent_specifications(&fixture.url).await;
    assert_eq!(store.sent_spec(id).await.expect("the store"), None);
    assert_eq!(store.sent_base(batch).await.expect("the store"), None);
    assert!(store.has_batch(batch, false).await.expect("the store"));
}
