//! Checkpoints of jobs.

use std::time::Duration;

use sha2::{Digest, Sha256};
use sqlx::{Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::clock::{monotonic_ms, now_ms};
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::checkpoint_object::{CheckpointObject, NAMED_WITHIN_MS};
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::{ClaimedCheckpoint, Lease, StoreError, integrity};

/// Returns the checkpoint of a job and deletes the results after its cycle. A checkpoint whose checksum differs is
/// deleted with all results.
pub(super) async fn restore(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
) -> Result<Option<ClaimedCheckpoint>, StoreError> {
    let stored: Option<(u64, Vec<u8>, Vec<u8>, bool)> = sqlx::query_as(
        "SELECT cycle, sha256, state, object IS NOT NULL FROM checkpoints WHERE job_id = ?",
    )
    .bind(id.to_string())
    .fetch_optional(&mut **transaction)
    .await?;
    let valid = stored.and_then(|(cycle, sha256, state, is_object)| {
        if is_object {
            return Some(ClaimedCheckpoint::Stored { cycle });
        }
        integrity::checkpoint(id, cycle, &sha256, state).map(ClaimedCheckpoint::Given)
    });
    delete_results_after(
        transaction,
        id,
        valid.as_ref().map(ClaimedCheckpoint::cycle),
    )
    .await?;
    Ok(valid)
}

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

/// Replaces the checkpoint of a job, in a transaction that has checked the lease. Its state is in an object, unless that may have been removed
/// already.
pub(super) async fn write(
    transaction: &mut Transaction<'_, Sqlite>,
    lease: Lease,
    checkpoint: &EncodedCheckpoint,
    object: Option<&str>,
) -> Result<(), StoreError> {
    let named = match object {
        Some(key) if name(transaction, key).await? => Some(key),
        _ => None,
    };
    let state = named.map_or(&checkpoint.state[..], |_| &[]);
    sqlx::query(
        "INSERT INTO checkpoints (job_id, lease, cycle, written_at, sha256, state, object) VALUES (?, ?, ?, ?, ?, ?, ?) \
         ON CONFLICT (job_id) DO UPDATE SET lease = excluded.lease, cycle = excluded.cycle, written_at = excluded.written_at, \
         sha256 = excluded.sha256, state = excluded.state, object = excluded.object",
    )
    .bind(lease.job.to_string())
    .bind(lease.number)
    .bind(integer(checkpoint.cycle))
    .bind(now_ms())
    .bind(Sha256::digest(&checkpoint.state).as_slice())
    .bind(state)
    .bind(named)
    .execute(&mut **transaction)
    .await?;
    Ok(())
}

/// Removes the note of an object that gets a name; false if it may have been removed.
async fn name(transaction: &mut Transaction<'_, Sqlite>, key: &str) -> Result<bool, StoreError> {
    let noted = sqlx::query("DELETE FROM unnamed_objects WHERE key = ? AND noted_at > ?")
        .bind(key)
        .bind(monotonic_ms() - NAMED_WITHIN_MS)
        .execute(&mut **transaction)
        .await?;
    if noted.rows_affected() > 0 {
        return Ok(true);
    }
    // The object may have been written after its removal.
    sqlx::query("INSERT OR IGNORE INTO unnamed_objects (key) VALUES (?)")
        .bind(key)
        .execute(&mut **transaction)
        .await?;
    Ok(false)
}

impl SqliteStore {
    pub(in crate::store) async fn note_object(&self, key: &str) -> Result<(), StoreError> {
        self.local.disk.check()?;
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

    pub(in crate::store) async fn checkpoint_object(
        &self,
        lease: Lease,
    ) -> Result<Option<CheckpointObject>, StoreError> {
        let found: Option<(u64, Vec<u8>, String)> = sqlx::query_as(
            "SELECT cycle, sha256, object FROM checkpoints JOIN jobs ON id = job_id \
             WHERE id = ? AND jobs.lease = ? AND status = 'running' AND object IS NOT NULL",
        )
        .bind(lease.job.to_string())
        .bind(lease.number)
        .fetch_optional(&self.readers)
        .await?;
        Ok(found.map(|(cycle, sha256, key)| CheckpointObject { cycle, sha256, key }))
    }
}
