//! Objects with checkpoints, and the results that a checkpoint makes obsolete.

use std::time::Duration;

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::clock::monotonic_ms;
use crate::store::StoreError;
use crate::store::checkpoint_object::NAMED_WITHIN_MS;
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;

/// Deletes rows, snapshots and files after a cycle, and the block; without a cycle all of them, and the checkpoint.
pub(super) async fn delete_results_after(
    connection: &mut SqliteConnection,
    id: Uuid,
    cycle: Option<u64>,
) -> Result<(), StoreError> {
    let last = cycle.map_or(-1, integer);
    for statement in [
        "DELETE FROM history_rows WHERE job_id = ? AND cycle > ?",
        "DELETE FROM snapshots WHERE job_id = ? AND cycle > ?",
        "DELETE FROM result_files WHERE job_id = ? AND COALESCE(cycle, 0) > ?",
        "DELETE FROM checkpoints WHERE job_id = ? AND cycle > ?",
    ] {
        sqlx::query(statement)
            .bind(id.to_string())
            .bind(last)
            .execute(&mut *connection)
            .await?;
    }
    // Made of them, and made again at the end.
    sqlx::query("DELETE FROM result_blocks WHERE job_id = ?")
        .bind(id.to_string())
        .execute(connection)
        .await?;
    Ok(())
}

/// Removes the note of an object that gets a name; false if it may have been removed.
pub(super) async fn name_object(
    connection: &mut SqliteConnection,
    key: &str,
) -> Result<bool, StoreError> {
    let noted = sqlx::query("DELETE FROM unnamed_objects WHERE key = ? AND noted_at > ?")
        .bind(key)
        .bind(monotonic_ms() - NAMED_WITHIN_MS)
        .execute(&mut *connection)
        .await?;
    if noted.rows_affected() > 0 {
        return Ok(true);
    }
    // The object may have been written after its removal.
    sqlx::query("INSERT OR IGNORE INTO unnamed_objects (key) VALUES (?)")
        .bind(key)
        .execute(&mut *connection)
        .await?;
    Ok(false)
}

impl SqliteStore {
    pub(in crate::store) async fn note_object(&self, key: &str) -> Result<(), StoreError> {
        self.process.disk.check()?;
        sqlx::query("INSERT INTO unnamed_objects (key, noted_at) VALUES (?, ?)")
            .bind(key)
            .bind(monotonic_ms())
            .execute(&self.writer)
            .await?;
        Ok(())
    }

    #[expect(
        clippy::unused_async,
        reason = "the one service of a file has files of attempts in its folder"
    )]
    pub(in crate::store) async fn keep_object(
        &self,
        _key: &str,
        _content: Option<&[u8]>,
        _length: Duration,
    ) -> Result<bool, StoreError> {
        Ok(false)
    }
}
