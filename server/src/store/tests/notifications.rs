//! Notifications between the services of a PostgreSQL database.

use sqlx::{Connection, PgConnection};

use super::*;

/// Longest wait; not a measure of speed.
const TEST_TIMEOUT: Duration = Duration::from_mins(1);

/// Ends the sessions that listen in the database; returns their number.
async fn end_listening(server: &mut PgConnection) -> i64 {
    let sql = "SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity \
               WHERE datname = current_database() AND query LIKE 'LISTEN %'";
    let ended = sqlx::query_scalar(sql).fetch_one(server).await;
    ended.expect("the rights to do so")
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn after_a_session_that_listened_was_ended_everybody_looks_for_what_was_missed() {
    let fixture = Fixture::at(Place::postgres()).await;
    let mut server = PgConnection::connect(&fixture.url).await.expect("a server");
    let store = &fixture.store;
    // Once when the store listens at first.
    let first = tokio::time::timeout(TEST_TIMEOUT, store.job_waiting()).await;
    first.expect("it listens");
    for _ in 0..3 {
        let mut of_a_job = store.changes(Uuid::now_v7());
        let mut of_all = store.all_changes();
        let ended = end_listening(&mut server).await;
        assert_eq!(ended, 1);
        let looks = async { tokio::join!(store.job_waiting(), of_a_job.next(), of_all.next()) };
        let looked = tokio::time::timeout(TEST_TIMEOUT, looks).await;
        looked.expect("they look");
    }
}
