//! Checkpoints of jobs: from where another attempt goes on.

use sha2::{Digest, Sha256};
use sqlx::{Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::clock::now_ms;
use crate::store::sqlite::leases::Claim;
use crate::store::sqlite::queries::{BEGIN, attempt_event};
use crate::store::{Held, Store, StoreError};

/// A checkpoint on its way to the store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewCheckpoint {
    /// Its cycle; all rows and snapshots up to it are stored with it or before.
    pub cycle: u64,
    /// The solver's state, encoded.
    pub state: Vec<u8>,
}

impl Store {
    /// Throws away what earlier attempts left, because their checkpoint cannot be read: the attempt begins anew.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn begin_anew(&self, claim: &Claim) -> Result<Held, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let held: Option<(i64, bool)> = sqlx::query_as(
            "UPDATE jobs SET last_event = last_event + 1, version = version + 1 \
             WHERE id = ? AND lease = ? AND status = 'running' RETURNING last_event, cancel_requested",
        )
        .bind(claim.id.to_string())
        .bind(claim.lease)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((event, cancel_requested)) = held else {
            return Ok(self.refused());
        };
        forget_after(&mut transaction, claim.id, None).await?;
        attempt_event(&mut transaction, claim.id, event, claim.attempt, 0).await?;
        transaction.commit().await?;
        self.changed(claim.id);
        Ok(Held::Yes { cancel_requested })
    }
}

/// The newest checkpoint of a job whose state is what was written; what follows its cycle is forgotten. A damaged one is
/// forgotten with everything else.
pub(in crate::store) async fn latest(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
) -> Result<Option<NewCheckpoint>, StoreError> {
    let stored: Option<(i64, Vec<u8>, Vec<u8>)> =
        sqlx::query_as("SELECT cycle, sha256, state FROM checkpoints WHERE job_id = ?")
            .bind(id.to_string())
            .fetch_optional(&mut **transaction)
            .await?;
    let sound = stored.and_then(|(cycle, sha256, state)| {
        if Sha256::digest(&state).as_slice() == sha256 {
            let cycle = u64::try_from(cycle).unwrap_or_default();
            return Some(NewCheckpoint { cycle, state });
        }
        tracing::error!(job = %id, cycle, "the checkpoint is damaged: its checksum differs; the job begins anew");
        None
    });
    forget_after(transaction, id, sound.as_ref().map(|found| found.cycle)).await?;
    Ok(sound)
}

/// Forgets rows, snapshots and files after a cycle; all of them, and the checkpoint, if there is none to go on from.
async fn forget_after(
    connection: &mut SqliteConnection,
    id: Uuid,
    cycle: Option<u64>,
) -> Result<(), StoreError> {
    let kept = cycle.map_or(-1, |cycle| i64::try_from(cycle).unwrap_or(i64::MAX));
    for statement in [
        "DELETE FROM history_rows WHERE job_id = ? AND cycle > ?",
        "DELETE FROM snapshots WHERE job_id = ? AND cycle > ?",
        "DELETE FROM result_files WHERE job_id = ? AND COALESCE(cycle, 0) > ?",
        "DELETE FROM checkpoints WHERE job_id = ? AND cycle > ?",
    ] {
        sqlx::query(statement)
            .bind(id.to_string())
            .bind(kept)
            .execute(&mut *connection)
            .await?;
    }
    Ok(())
}

/// Replaces the checkpoint of a job, in a transaction that has checked the lease.
pub(in crate::store) async fn write(
    transaction: &mut Transaction<'_, Sqlite>,
    claim: &Claim,
    checkpoint: &NewCheckpoint,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT OR REPLACE INTO checkpoints (job_id, lease, cycle, written_at, sha256, state) VALUES (?, ?, ?, ?, ?, ?)",
    )
    .bind(claim.id.to_string())
    .bind(claim.lease)
    .bind(i64::try_from(checkpoint.cycle).unwrap_or(i64::MAX))
    .bind(now_ms())
    .bind(Sha256::digest(&checkpoint.state).as_slice())
    .bind(&checkpoint.state)
    .execute(&mut **transaction)
    .await?;
    Ok(())
}

/// Removes the checkpoint of a job that has ended.
pub(in crate::store) async fn remove(
    connection: &mut SqliteConnection,
    id: Uuid,
) -> Result<(), StoreError> {
    sqlx::query("DELETE FROM checkpoints WHERE job_id = ?")
        .bind(id.to_string())
        .execute(connection)
        .await?;
    Ok(())
}
