//! Statements and conversions that several files share.

use api::event::Attempt;
use serde::de::DeserializeOwned;
use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::store::StoreError;

/// Takes the write lock at once: a transaction that reads first and writes later would fail under contention.
pub(super) const BEGIN: &str = "BEGIN IMMEDIATE";

/// Parses the stored id of a job.
pub(super) fn job_id(text: &str) -> Result<Uuid, StoreError> {
    Uuid::parse_str(text).map_err(|cause| corrupt(Uuid::nil(), "id", &cause))
}

/// Parses a stored JSON document.
pub(super) fn parsed<T: DeserializeOwned>(
    id: Uuid,
    what: &'static str,
    text: &str,
) -> Result<T, StoreError> {
    serde_json::from_str(text).map_err(|cause| corrupt(id, what, &cause))
}

/// The error of a stored value that cannot be read.
pub(super) fn corrupt(id: Uuid, what: &'static str, cause: &impl ToString) -> StoreError {
    StoreError::Corrupt {
        id,
        what,
        cause: cause.to_string(),
    }
}

/// Converts a count or cycle to SQLite's integer; saturates.
pub(super) fn integer(value: impl TryInto<i64>) -> i64 {
    value.try_into().unwrap_or(i64::MAX)
}

/// Converts a stored number of attempts; saturates.
pub(super) fn attempt_count(stored: i64) -> u32 {
    u32::try_from(stored).unwrap_or(u32::MAX)
}

/// Appends the event of a new attempt, which starts at a cycle.
pub(super) async fn insert_attempt_event(
    connection: &mut SqliteConnection,
    id: Uuid,
    seq: i64,
    attempt: u32,
    from_cycle: u64,
) -> Result<(), StoreError> {
    let data = serde_json::to_string(&Attempt {
        attempt,
        from_cycle,
    })?;
    insert_event(connection, id, seq, "attempt", &data).await
}

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
