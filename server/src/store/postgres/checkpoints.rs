//! Checkpoints of jobs.

use std::time::Duration;

use sha2::{Digest, Sha256};
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::objects::Objects;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::checkpoint_object::CheckpointObject;
use crate::store::postgres::PostgresStore;
use crate::store::rows::integer;
use crate::store::{ClaimedCheckpoint, Lease, StoreError, integrity};

/// Returns the checkpoint of a job and deletes the results after its cycle. A checkpoint whose checksum differs is
/// deleted with all results.
pub(super) async fn restore(
    connection: &mut PgConnection,
    id: Uuid,
) -> Result<Option<ClaimedCheckpoint>, StoreError> {
    let stored: Option<(i64, Vec<u8>, Vec<u8>, bool)> = sqlx::query_as(
        "SELECT cycle, sha256, state, object IS NOT NULL FROM checkpoints WHERE job_id = $1",
    )
    .bind(id)
    .fetch_optional(&mut *connection)
    .await?;
    let valid = stored.and_then(|(cycle, sha256, state, is_object)| {
        let cycle = cycle.try_into().unwrap_or_default();
        if is_object {
            return Some(ClaimedCheckpoint::Stored { cycle });
        }
        integrity::checkpoint(id, cycle, &sha256, state).map(ClaimedCheckpoint::Given)
    });
    let cycle = valid.as_ref().map(ClaimedCheckpoint::cycle);
    delete_results_after(connection, id, cycle).await?;
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

/// Replaces the checkpoint of a job, in a transaction that has checked the lease. Its state is in an object, unless that is being removed
/// already.
pub(super) async fn write(
    connection: &mut PgConnection,
    lease: Lease,
    (checkpoint, object): (&EncodedCheckpoint, Option<&str>),
    now: Now,
) -> Result<(), StoreError> {
    let named = match object {
        Some(key) if name(connection, key).await? => Some(key),
        _ => None,
    };
    let state = named.map_or(&checkpoint.state[..], |_| &[]);
    sqlx::query(
        "INSERT INTO checkpoints (job_id, lease, cycle, written_at, sha256, state, object) VALUES ($1, $2, $3, $4, $5, $6, $7) \
         ON CONFLICT (job_id) DO UPDATE SET lease = excluded.lease, cycle = excluded.cycle, written_at = excluded.written_at, \
         sha256 = excluded.sha256, state = excluded.state, object = excluded.object",
    )
    .bind(lease.job)
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

/// Removes the note of an object that gets a name; false if it is being removed.
async fn name(connection: &mut PgConnection, key: &str) -> Result<bool, StoreError> {
    let noted = sqlx::query("DELETE FROM unnamed_objects WHERE key = $1 AND NOT is_removing")
        .bind(key)
        .execute(&mut *connection)
        .await?;
    if noted.rows_affected() > 0 {
        return Ok(true);
    }
    // The object may have been written after its removal.
    sqlx::query("INSERT INTO unnamed_objects (key) VALUES ($1) ON CONFLICT DO NOTHING")
        .bind(key)
        .execute(connection)
        .await?;
    Ok(false)
}

impl PostgresStore {
    pub(in crate::store) async fn note_object(&self, key: &str) -> Result<(), StoreError> {
        // A service that started meanwhile may have noted another store of objects.
        let address = self.local.objects.as_ref().map(Objects::location);
        let noted = sqlx::query(
            "INSERT INTO unnamed_objects (key, noted_at) SELECT $1, fretwear_now() FROM object_store WHERE address = $2",
        )
        .bind(key)
        .bind(address)
        .execute(&self.pool)
        .await?;
        if noted.rows_affected() > 0 {
            return Ok(());
        }
        let stored = sqlx::query_scalar("SELECT address FROM object_store");
        let stored: Option<String> = stored.fetch_optional(&self.pool).await?;
        Err(StoreError::OtherObjects {
            stored: stored.unwrap_or_default(),
            given: address.unwrap_or_default().to_owned(),
        })
    }

    pub(in crate::store) async fn keep_object(
        &self,
        key: &str,
        content: Option<&[u8]>,
        length: Duration,
    ) -> Result<bool, StoreError> {
        let kept = sqlx::query(
            "UPDATE unnamed_objects SET noted_at = fretwear_now() + $3, content = $2 WHERE key = $1 AND NOT is_removing",
        )
        .bind(key)
        .bind(content)
        .bind(integer(length.as_millis()))
        .execute(&self.pool)
        .await?;
        Ok(kept.rows_affected() > 0)
    }

    pub(in crate::store) async fn checkpoint_object(
        &self,
        lease: Lease,
    ) -> Result<Option<CheckpointObject>, StoreError> {
        let found: Option<(i64, Vec<u8>, String)> = sqlx::query_as(
            "SELECT cycle, sha256, object FROM checkpoints JOIN jobs ON id = job_id \
             WHERE id = $1 AND jobs.lease = $2 AND status = 'running' AND object IS NOT NULL",
        )
        .bind(lease.job)
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
