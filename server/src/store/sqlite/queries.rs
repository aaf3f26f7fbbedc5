//! Statements and conversions that several files share.

use api::event::Attempt;
use api::job::{Outcome, Status};
use api::results::Summary;
use serde::de::DeserializeOwned;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::store::StoreError;

/// Takes the write lock at once: a transaction that reads first and writes later would fail under contention.
pub(super) const BEGIN: &str = "BEGIN IMMEDIATE";

/// Reads an id; ids are stored as text with hyphens.
pub(super) fn id(row: &SqliteRow, column: &str) -> Result<Uuid, sqlx::Error> {
    row.try_get::<Hyphenated, _>(column).map(Uuid::from)
}

/// Reads the status of a job.
pub(super) fn status(id: Uuid, row: &SqliteRow) -> Result<Status, StoreError> {
    let name = row.try_get("status")?;
    Status::from_name(name).ok_or_else(|| corrupt(id, "status", &name))
}

/// Reads the outcome of a job.
pub(super) fn outcome(row: &SqliteRow) -> Result<Option<Outcome>, sqlx::Error> {
    let name: Option<&str> = row.try_get("outcome")?;
    Ok(name.and_then(Outcome::from_name))
}

/// Reads the summary of a job.
pub(super) fn summary(id: Uuid, row: &SqliteRow) -> Result<Option<Summary>, StoreError> {
    let text: Option<&str> = row.try_get("summary")?;
    text.map(|text| parsed(id, "summary", text)).transpose()
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
