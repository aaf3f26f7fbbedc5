//! Checkpoints of jobs.

use sha2::{Digest, Sha256};
use uuid::Uuid;

use super::checkpoint_objects::{delete_results_after, name_object};
use super::dialect::{Connection, EngineStore, stored_id};
use crate::clock::Now;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::checkpoint_object::CheckpointObject;
use crate::store::rows::integer;
use crate::store::{ClaimedCheckpoint, Lease, StoreError, checksum};

/// Returns the checkpoint of a job and deletes the results after its cycle. A checkpoint whose checksum differs is
/// deleted with all results.
pub(in super::super) async fn restore(
    connection: &mut Connection,
    id: Uuid,
) -> Result<Option<ClaimedCheckpoint>, StoreError> {
    let stored: Option<(i64, Vec<u8>, Vec<u8>, bool)> = sqlx::query_as(
        "SELECT cycle, sha256, state, object IS NOT NULL FROM checkpoints WHERE job_id = $1",
    )
    .bind(stored_id(id))
    .fetch_optional(&mut *connection)
    .await?;
    let valid = stored.and_then(|(cycle, sha256, state, is_object)| {
        let cycle = cycle.try_into().unwrap_or_default();
        if is_object {
            return Some(ClaimedCheckpoint::Stored { cycle });
        }
        checksum::checkpoint(id, cycle, &sha256, state).map(ClaimedCheckpoint::Given)
    });
    let cycle = valid.as_ref().map(ClaimedCheckpoint::cycle);
    delete_results_after(connection, id, cycle).await?;
    Ok(valid)
}

/// Replaces the checkpoint of a job, in a transaction that has checked the lease. Its state is in an object, unless that may have been
/// removed already.
pub(in super::super) async fn write(
    connection: &mut Connection,
    lease: Lease,
    checkpoint: &EncodedCheckpoint,
    object: Option<&str>,
    now: Now,
) -> Result<(), StoreError> {
    let named = match object {
        Some(key) if name_object(connection, key).await? => Some(key),
        _ => None,
    };
    let state = named.map_or(&checkpoint.state[..], |_| &[]);
    sqlx::query(
        "INSERT INTO checkpoints (job_id, lease, cycle, written_at, sha256, state, object) VALUES ($1, $2, $3, $4, $5, $6, $7) \
         ON CONFLICT (job_id) DO UPDATE SET lease = excluded.lease, cycle = excluded.cycle, written_at = excluded.written_at, \
         sha256 = excluded.sha256, state = excluded.state, object = excluded.object",
    )
    .bind(stored_id(lease.job))
    .bind(lease.number)
    .bind(integer(checkpoint.cycle))
    .bind(now.system_ms)
    .bind(Sha256::digest(&checkpoint.state).as_slice())
    .bind(state)
    .bind(named)
    .execute(connection)
    .await?;
    Ok(())
}

impl EngineStore {
    pub(in crate::store) async fn checkpoint_object(
        &self,
        lease: Lease,
    ) -> Result<Option<CheckpointObject>, StoreError> {
        let found: Option<(i64, Vec<u8>, String)> = sqlx::query_as(
            "SELECT cycle, sha256, object FROM checkpoints JOIN jobs ON id = job_id \
             WHERE id = $1 AND jobs.lease = $2 AND status = 'running' AND object IS NOT NULL",
        )
        .bind(stored_id(lease.job))
        .bind(lease.number)
        .fetch_optional(&self.readers)
        .await?;
        Ok(found.map(|(cycle, sha256, key)| CheckpointObject {
            cycle: cycle.try_into().unwrap_or_default(),
            sha256,
            key,
        }))
    }
}
