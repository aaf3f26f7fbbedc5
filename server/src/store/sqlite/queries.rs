//! Statements that several parts of the store share.

use api::event::Attempt;
use sqlx::SqliteConnection;
use sqlx::sqlite::SqlitePool;
use uuid::Uuid;

use crate::store::{Store, StoreError};

/// Takes the write lock at once: a transaction that reads first and writes later would fail under contention.
pub(in crate::store) const BEGIN: &str = "BEGIN IMMEDIATE";

/// The id of a job as it is stored.
pub(in crate::store) fn job_id(text: &str) -> Result<Uuid, StoreError> {
    Uuid::parse_str(text).map_err(|cause| StoreError::Corrupt {
        id: Uuid::nil(),
        what: "id",
        cause: cause.to_string(),
    })
}

/// The version of the linked SQLite.
pub(in crate::store) async fn sqlite_version(pool: &SqlitePool) -> Result<String, StoreError> {
    Ok(sqlx::query_scalar("SELECT sqlite_version()")
        .fetch_one(pool)
        .await?)
}

/// Moves the write-ahead log into the database and empties it; for start-up, when nobody reads.
pub(in crate::store) async fn checkpoint(pool: &SqlitePool) -> Result<(), StoreError> {
    sqlx::query("PRAGMA wal_checkpoint(TRUNCATE)")
        .execute(pool)
        .await?;
    Ok(())
}

impl Store {
    /// Moves the write-ahead log into the database, as far as readers let it and without waiting for them.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn checkpoint(&self) -> Result<(), StoreError> {
        sqlx::query("PRAGMA wal_checkpoint(PASSIVE)")
            .execute(&self.writer)
            .await?;
        Ok(())
    }
}

/// Appends the event that an attempt begins, at a cycle.
pub(in crate::store) async fn attempt_event(
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

/// Appends an event and returns nothing; the caller has raised `jobs.last_event` to `seq` in the same transaction.
pub(in crate::store) async fn insert_event(
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
