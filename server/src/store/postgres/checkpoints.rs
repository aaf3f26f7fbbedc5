//! Checkpoints of jobs.

use sha2::{Digest, Sha256};
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::rows::integer;
use crate::store::{Lease, StoreError, integrity};

/// Returns the checkpoint of a job and deletes the results after its cycle. A checkpoint whose checksum differs is
/// deleted with all results.
pub(super) async fn restore(
    connection: &mut PgConnection,
    id: Uuid,
) -> Result<Option<EncodedCheckpoint>, StoreError> {
    let stored: Option<(i64, Vec<u8>, Vec<u8>)> =
        sqlx::query_as("SELECT cycle, sha256, state FROM checkpoints WHERE job_id = $1")
            .bind(id)
            .fetch_optional(&mut *connection)
            .await?;
    let valid = stored.and_then(|(cycle, sha256, state)| {
        integrity::checkpoint(id, cycle.try_into().unwrap_or_default(), &sha256, state)
    });
    delete_results_after(connection, id, valid.as_ref().map(|found| found.cycle)).await?;
    Ok(valid)
}

/// Deletes rows, snapshots and files after a cycle, and the block; without a cycle all of them, and the checkpoint.
pub(super) async fn delete_results_after(
    connection: &mut PgConnection,
    id: Uuid,
    cycle: Option<u64>,
) -> Result<(), StoreError> {
    // The block is made of them, and made again at the end.
    sqlx::query(
        "WITH history AS (DELETE FROM history_rows WHERE job_id = $1 AND cycle > $2), \
         profiles AS (DELETE FROM snapshots WHERE job_id = $1 AND cycle > $2), \
         files AS (DELETE FROM result_files WHERE job_id = $1 AND COALESCE(cycle, 0) > $2), \
         state AS (DELETE FROM checkpoints WHERE job_id = $1 AND cycle > $2) \
         DELETE FROM result_blocks WHERE job_id = $1",
    )
    .bind(id)
    .bind(cycle.map_or(-1, integer))
    .execute(connection)
    .await?;
    Ok(())
}

/// Replaces the checkpoint of a job, in a transaction that has checked the lease.
pub(super) async fn write(
    connection: &mut PgConnection,
    lease: Lease,
    checkpoint: &EncodedCheckpoint,
    now: Now,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO checkpoints (job_id, lease, cycle, written_at, sha256, state) VALUES ($1, $2, $3, $4, $5, $6) \
         ON CONFLICT (job_id) DO UPDATE SET lease = excluded.lease, cycle = excluded.cycle, written_at = excluded.written_at, \
         sha256 = excluded.sha256, state = excluded.state",
    )
    .bind(lease.job)
    .bind(lease.number)
    .bind(integer(checkpoint.cycle))
    .bind(now.system_ms)
    .bind(Sha256::digest(&checkpoint.state).as_slice())
    .bind(&checkpoint.state)
    .execute(connection)
    .await?;
    Ok(())
}
