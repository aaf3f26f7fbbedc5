//! Checkpoints of jobs.

use sha2::{Digest, Sha256};
use sqlx::{Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::clock::now_ms;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::rows::integer;
use crate::store::{Lease, StoreError, integrity};

/// Returns the checkpoint of a job and deletes the results after its cycle. A checkpoint whose checksum differs is
/// deleted with all results.
pub(super) async fn restore(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
) -> Result<Option<EncodedCheckpoint>, StoreError> {
    let stored: Option<(u64, Vec<u8>, Vec<u8>)> =
        sqlx::query_as("SELECT cycle, sha256, state FROM checkpoints WHERE job_id = ?")
            .bind(id.to_string())
            .fetch_optional(&mut **transaction)
            .await?;
    let valid =
        stored.and_then(|(cycle, sha256, state)| integrity::checkpoint(id, cycle, &sha256, state));
    delete_results_after(transaction, id, valid.as_ref().map(|found| found.cycle)).await?;
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

/// Replaces the checkpoint of a job, in a transaction that has checked the lease.
pub(super) async fn write(
    transaction: &mut Transaction<'_, Sqlite>,
    lease: Lease,
    checkpoint: &EncodedCheckpoint,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT OR REPLACE INTO checkpoints (job_id, lease, cycle, written_at, sha256, state) VALUES (?, ?, ?, ?, ?, ?)",
    )
    .bind(lease.job.to_string())
    .bind(lease.number)
    .bind(integer(checkpoint.cycle))
    .bind(now_ms())
    .bind(Sha256::digest(&checkpoint.state).as_slice())
    .bind(&checkpoint.state)
    .execute(&mut **transaction)
    .await?;
    Ok(())
}
