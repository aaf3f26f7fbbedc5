//! Statements that several files share.

use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::StoreError;

/// An event that is appended.
#[derive(Debug)]
pub(super) struct NewEvent<'a> {
    pub(super) job: Uuid,
    pub(super) seq: i64,
    pub(super) name: &'a str,
    pub(super) data: &'a str,
}

/// Appends events; the caller has raised `jobs.last_event` to the last of each job in the same transaction.
pub(super) async fn insert_events(
    connection: &mut PgConnection,
    events: Vec<NewEvent<'_>>,
) -> Result<(), StoreError> {
    if events.is_empty() {
        return Ok(());
    }
    sqlx::query(
        "INSERT INTO events (job_id, seq, name, data) SELECT * FROM unnest($1::uuid[], $2::bigint[], $3::text[], $4::text[])",
    )
    .bind(events.iter().map(|event| event.job).collect::<Vec<_>>())
    .bind(events.iter().map(|event| event.seq).collect::<Vec<_>>())
    .bind(events.iter().map(|event| event.name).collect::<Vec<_>>())
    .bind(events.iter().map(|event| event.data).collect::<Vec<_>>())
    .execute(connection)
    .await?;
    Ok(())
}

/// Appends an event; the caller has raised `jobs.last_event` to `seq` in the same transaction.
pub(super) async fn insert_event(
    connection: &mut PgConnection,
    id: Uuid,
    seq: i64,
    name: &str,
    data: &str,
) -> Result<(), StoreError> {
    let event = NewEvent {
        job: id,
        seq,
        name,
        data,
    };
    insert_events(connection, vec![event]).await
}
