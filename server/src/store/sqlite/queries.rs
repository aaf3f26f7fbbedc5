//! Statements that several files share.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::store::StoreError;

/// Takes the write lock at once: a transaction that reads first and writes later would fail under contention.
pub(super) const BEGIN: &str = "BEGIN IMMEDIATE";

/// Appends an event; the caller has raised `jobs.last_event` to `seq` in the same transaction.
pub(super) async fn insert_event(
    connection: &mut SqliteConnection,
    id: Uuid,
    seq: i64,
    name: &str,
    data: &str,
) -> Result<(), StoreError> {
    sqlx::query("INSERT INTO events (job_id, seq, name, data) VALUES (?, ?, ?, ?)")
        .bind(id.to_string())
        .bind(seq)
        .bind(name)
        .bind(data)
        .execute(connection)
        .await?;
    Ok(())
}
