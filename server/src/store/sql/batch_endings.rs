//! Requests to cancel or delete all jobs of a batch.

use uuid::Uuid;

use super::dialect::{Connection, EngineStore, StoredId, read_id, stored_id};
use crate::store::{BatchEnding, Deleted, StoreError};

impl EngineStore {
    pub(in crate::store) async fn note_cancellation(&self, batch: Uuid) -> Result<(), StoreError> {
        let write = async || {
            let (mut transaction, _) = self.begin().await?;
            for statement in [
                "UPDATE expansions SET is_over = true WHERE sweep_id = $1 AND NOT is_over",
                "UPDATE sweeps SET ending = 'cancel' WHERE id = $1 AND ending IS NULL",
            ] {
                sqlx::query(statement)
                    .bind(stored_id(batch))
                    .execute(&mut *transaction)
                    .await?;
            }
            Ok(transaction.commit().await?)
        };
        self.with_reserve(write).await
    }

    pub(in crate::store) async fn note_deletion(&self, batch: Uuid) -> Result<Deleted, StoreError> {
        let write = async || {
            let (mut transaction, _) = self.begin().await?;
            if is_active(&mut transaction, batch).await? {
                return Ok(Deleted::Active);
            }
            let noted = sqlx::query(
                "UPDATE sweeps SET ending = 'delete' WHERE id = $1 AND ending IS DISTINCT FROM 'delete'",
            )
            .bind(stored_id(batch))
            .execute(&mut *transaction)
            .await?;
            transaction.commit().await?;
            Ok(match noted.rows_affected() {
                0 => Deleted::Missing,
                _ => Deleted::Done,
            })
        };
        self.with_reserve(write).await
    }

    pub(in crate::store) async fn batch_endings(
        &self,
    ) -> Result<Vec<(Uuid, BatchEnding)>, StoreError> {
        let rows: Vec<(StoredId, String)> =
            sqlx::query_as("SELECT id, ending FROM sweeps WHERE ending IS NOT NULL ORDER BY id")
                .fetch_all(&self.readers)
                .await?;
        let rows = rows.into_iter();
        let endings =
            rows.filter_map(|(id, name)| Some((read_id(id), BatchEnding::from_name(&name)?)));
        Ok(endings.collect())
    }

    pub(in crate::store) async fn forget_ending(
        &self,
        batch: Uuid,
        ending: BatchEnding,
    ) -> Result<(), StoreError> {
        let write = async || {
            sqlx::query("UPDATE sweeps SET ending = NULL WHERE id = $1 AND ending = $2")
                .bind(stored_id(batch))
                .bind(ending.as_str())
                .execute(&self.writer)
                .await?;
            Ok(())
        };
        self.with_reserve(write).await
    }
}

/// Checks whether jobs of a batch wait, run or are still to be queued.
pub(in super::super) async fn is_active(
    connection: &mut Connection,
    batch: Uuid,
) -> Result<bool, StoreError> {
    let is_active = sqlx::query_scalar(
        "SELECT EXISTS (SELECT 1 FROM jobs WHERE sweep_id = $1 AND status IN ('queued', 'running')) \
         OR EXISTS (SELECT 1 FROM expansions WHERE sweep_id = $1 AND NOT is_over)",
    )
    .bind(stored_id(batch));
    Ok(is_active.fetch_one(connection).await?)
}
