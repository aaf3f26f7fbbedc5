//! Statements that several files share.

use sqlx::postgres::{PgConnection, PgRow};
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::rows::{attempt_event, stored_row};

stored_row!(PgRow, Uuid);

/// Appends the event of a new attempt, which starts at a cycle.
pub(super) async fn insert_attempt_event(
    connection: &mut PgConnection,
    id: Uuid,
    seq: i64,
    attempt: u32,
    from_cycle: u64,
) -> Result<(), StoreError> {
    let data = attempt_event(attempt, from_cycle)?;
    insert_event(connection, id, seq, "attempt", &data).await
}

/// Appends an event; the caller has raised `jobs.last_event` to `seq` in the same transaction.
pub(super) async fn insert_event(
    connection: &mut PgConnection,
    id: Uuid,
    seq: i64,
    name: &str,
    data: &str,
) -> Result<(), StoreError> {
    sqlx::query("INSERT INTO events (job_id, seq, name, data) VALUES ($1, $2, $3, $4)")
        .bind(id)
        .bind(seq)
        .bind(name)
        .bind(data)
        .execute(connection)
        .await?;
    Ok(())
}
