//! Rows of the tables, whatever the engine, and the values that are read from them.

use api::event::Attempt;
use api::job::{Outcome, Status};
use api::results::{ResultFile, Snapshot, Summary};
use api::worker::{RemoteWorker, WorkerToken};
use jiff::Timestamp;
use serde::de::DeserializeOwned;
use sqlx::{Decode, Postgres, Sqlite, Type};
use uuid::Uuid;

use crate::clock::Now;
use crate::store::{Claim, ClaimedCheckpoint, StoreError};

/// A value of a column that every engine reads alike.
pub(in crate::store) trait StoredValue:
    for<'r> Decode<'r, Sqlite> + Type<Sqlite> + for<'r> Decode<'r, Postgres> + Type<Postgres>
{
}

impl<T> StoredValue for T where
    T: for<'r> Decode<'r, Sqlite> + Type<Sqlite> + for<'r> Decode<'r, Postgres> + Type<Postgres>
{
}

/// A row of an engine, whose columns are read by name.
pub(in crate::store) trait StoredRow {
    /// An id.
    fn id(&self, column: &str) -> Result<Uuid, StoreError>;
    /// An id that may be absent.
    fn optional_id(&self, column: &str) -> Result<Option<Uuid>, StoreError>;
    /// A text, a number, a truth value or bytes; an `Option` where it may be absent.
    fn value<T: StoredValue>(&self, column: &str) -> Result<T, StoreError>;
}

/// Reads the status of a job.
pub(in crate::store) fn status(id: Uuid, row: &impl StoredRow) -> Result<Status, StoreError> {
    let name: String = row.value("status")?;
    Status::from_name(&name).ok_or_else(|| corrupt(id, "status", &name))
}

/// Reads the outcome of a job.
pub(in crate::store) fn outcome(row: &impl StoredRow) -> Result<Option<Outcome>, StoreError> {
    let name: Option<String> = row.value("outcome")?;
    Ok(name.as_deref().and_then(Outcome::from_name))
}

/// Reads the summary of a job.
pub(in crate::store) fn summary(
    id: Uuid,
    row: &impl StoredRow,
) -> Result<Option<Summary>, StoreError> {
    let text: Option<String> = row.value("summary")?;
    text.map(|text| parsed(id, "summary", &text)).transpose()
}

/// Reads a time, ms since 1970.
pub(in crate::store) fn time(
    row: &impl StoredRow,
    column: &str,
) -> Result<Option<String>, StoreError> {
    Ok(row.value::<Option<_>>(column)?.map(timestamp))
}

/// Reads a count.
pub(in crate::store) fn unsigned<T: TryFrom<i64> + Default>(
    row: &impl StoredRow,
    column: &str,
) -> Result<T, StoreError> {
    Ok(row.value::<i64>(column)?.try_into().unwrap_or_default())
}

/// Reads the entry of a file in a manifest.
pub(in crate::store) fn entry(row: &impl StoredRow) -> Result<ResultFile, StoreError> {
    let cycle: Option<i64> = row.value("cycle")?;
    Ok(ResultFile {
        name: row.value("name")?,
        cycle: cycle.and_then(|cycle| cycle.try_into().ok()),
        media_type: row.value("media_type")?,
        bytes: unsigned(row, "bytes")?,
        sha256: row.value("sha256")?,
        damaged: row.value("damaged")?,
    })
}

/// Reads a token of a worker.
pub(in crate::store) fn token(row: &impl StoredRow) -> Result<WorkerToken, StoreError> {
    Ok(WorkerToken {
        id: row.id("id")?,
        name: row.value("name")?,
        created_at: timestamp(row.value("created_at")?),
        revoked_at: time(row, "revoked_at")?,
    })
}

/// Reads a job under its new lease.
pub(in crate::store) fn claim(
    id: Uuid,
    row: &impl StoredRow,
    now: Now,
    checkpoint: Option<ClaimedCheckpoint>,
) -> Result<Claim, StoreError> {
    let deadline_at: Option<i64> = row.value("deadline_at")?;
    Ok(Claim {
        id,
        lease: row.value("lease")?,
        spec: row.value("spec")?,
        attempt: unsigned(row, "attempts")?,
        waited_ms: now.monotonic_ms.saturating_sub(row.value("queued_at")?),
        deadline_in_ms: deadline_at.map(|at| at.saturating_sub(now.monotonic_ms)),
        memory_mb: row.value("memory_mb")?,
        cpu_ms: row.value("cpu_ms")?,
        checkpoint,
    })
}

/// A snapshot from its texts: profile, pressure and friction loop.
pub(in crate::store) fn snapshot(
    id: Uuid,
    (profile, pressure, friction_loop): &(String, String, String),
) -> Result<Snapshot, StoreError> {
    Ok(Snapshot {
        profile: parsed(id, "snapshot", profile)?,
        pressure: parsed(id, "snapshot", pressure)?,
        friction_loop: parsed(id, "snapshot", friction_loop)?,
    })
}

/// Parses a stored JSON document.
pub(in crate::store) fn parsed<T: DeserializeOwned>(
    id: Uuid,
    what: &'static str,
    text: &str,
) -> Result<T, StoreError> {
    serde_json::from_str(text).map_err(|cause| corrupt(id, what, &cause))
}

/// The error of a stored value that cannot be read.
pub(in crate::store) fn corrupt(id: Uuid, what: &'static str, cause: &impl ToString) -> StoreError {
    StoreError::Corrupt {
        id,
        what,
        cause: cause.to_string(),
    }
}

/// Converts a count or cycle to the integer of a database; saturates.
pub(in crate::store) fn integer(value: impl TryInto<i64>) -> i64 {
    value.try_into().unwrap_or(i64::MAX)
}

/// Returns a remote worker at a time on the clock of its contacts, ms.
pub(in crate::store) fn remote_worker(
    row: &impl StoredRow,
    now: i64,
) -> Result<RemoteWorker, StoreError> {
    let since = now.saturating_sub(row.value("last_contact_at")?);
    Ok(RemoteWorker {
        id: row.id("id")?,
        host: row.value("host")?,
        slots: unsigned(row, "slots")?,
        jobs: unsigned(row, "jobs")?,
        memory_mb: unsigned(row, "memory_mb")?,
        free_memory_mb: unsigned(row, "free_memory_mb")?,
        last_contact_s: (since / 1_000).try_into().unwrap_or_default(),
        is_draining: row.value::<i64>("is_draining")? != 0,
        failing: row.value("failing")?,
    })
}

/// The document of the event of a new attempt, which starts at a cycle.
pub(in crate::store) fn attempt_event(attempt: u32, from_cycle: u64) -> Result<String, StoreError> {
    Ok(serde_json::to_string(&Attempt {
        attempt,
        from_cycle,
    })?)
}

/// Formats milliseconds since 1970 as RFC 3339.
pub(in crate::store) fn timestamp(milliseconds: i64) -> String {
    Timestamp::from_millisecond(milliseconds)
        .map_or_else(|_| milliseconds.to_string(), |time| time.to_string())
}
