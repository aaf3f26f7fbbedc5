//! Cancellation and deletion of all jobs of a batch, a limited number in a transaction.

use sqlx::{Sqlite, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::store::batches::JOBS_AT_ONCE;
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::job_rows::cancel;
use crate::store::sqlite::queries::BEGIN;
use crate::store::{BatchEnding, Deleted, StoreError};

impl SqliteStore {
    pub(in crate::store) async fn note_cancellation(&self, batch: Uuid) -> Result<(), StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            sqlx::query("UPDATE expansions SET is_over = 1 WHERE sweep_id = ? AND NOT is_over")
                .bind(batch.to_string())
                .execute(&mut *transaction)
                .await?;
            sqlx::query("UPDATE sweeps SET ending = 'cancel' WHERE id = ? AND ending IS NULL")
                .bind(batch.to_string())
                .execute(&mut *transaction)
                .await?;
            Ok(transaction.commit().await?)
        };
        self.local.disk.with_reserve(write).await
    }

    pub(in crate::store) async fn note_deletion(&self, batch: Uuid) -> Result<Deleted, StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            if is_active(&mut transaction, batch).await? {
                return Ok(Deleted::Active);
            }
            let noted = sqlx::query(
                "UPDATE sweeps SET ending = 'delete' WHERE id = ? AND ending IS NOT 'delete'",
            )
            .bind(batch.to_string())
            .execute(&mut *transaction)
            .await?;
            transaction.commit().await?;
            Ok(match noted.rows_affected() {
                0 => Deleted::Missing,
                _ => Deleted::Done,
            })
        };
        self.local.disk.with_reserve(write).await
    }

    pub(in crate::store) async fn batch_endings(
        &self,
    ) -> Result<Vec<(Uuid, BatchEnding)>, StoreError> {
        let rows: Vec<(Hyphenated, String)> =
            sqlx::query_as("SELECT id, ending FROM sweeps WHERE ending IS NOT NULL ORDER BY id")
                .fetch_all(&self.readers)
                .await?;
        let rows = rows.into_iter();
        let endings =
            rows.filter_map(|(id, name)| Some((id.into(), BatchEnding::from_name(&name)?)));
        Ok(endings.collect())
    }

    pub(in crate::store) async fn forget_ending(
        &self,
        batch: Uuid,
        ending: BatchEnding,
    ) -> Result<(), StoreError> {
        let write = async || {
            sqlx::query("UPDATE sweeps SET ending = NULL WHERE id = ? AND ending = ?")
                .bind(batch.to_string())
                .bind(ending.as_str())
                .execute(&self.writer)
                .await?;
            Ok(())
        };
        self.local.disk.with_reserve(write).await
    }

    pub(in crate::store) async fn cancel_some(&self, batch: Uuid) -> Result<bool, StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            let jobs: Vec<Hyphenated> = sqlx::query_scalar(
                "SELECT id FROM jobs WHERE sweep_id = ? AND status IN ('queued', 'running') \
                 AND (status = 'queued' OR NOT cancel_requested) LIMIT ?",
            )
            .bind(batch.to_string())
            .bind(JOBS_AT_ONCE)
            .fetch_all(&mut *transaction)
            .await?;
            let now = self.local.clock.now();
            let mut effects = Vec::with_capacity(jobs.len());
            for job in jobs.into_iter().map(Uuid::from) {
                effects.push((job, cancel(&mut transaction, job, now).await?));
            }
            transaction.commit().await?;
            Ok(effects)
        };
        let effects = self.local.disk.with_reserve(write).await?;
        for (job, effect) in &effects {
            self.local.cancelled(*job, *effect);
        }
        Ok(!effects.is_empty())
    }

    pub(in crate::store) async fn delete_some(&self, batch: Uuid) -> Result<bool, StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            if is_active(&mut transaction, batch).await? {
                return Ok(None);
            }
            let jobs: Vec<Hyphenated> = sqlx::query_scalar(
                "DELETE FROM jobs WHERE id IN (SELECT id FROM jobs WHERE sweep_id = ? LIMIT ?) RETURNING id",
            )
            .bind(batch.to_string())
            .bind(JOBS_AT_ONCE)
            .fetch_all(&mut *transaction)
            .await?;
            sqlx::query("DELETE FROM sweeps WHERE id = ? AND ?")
                .bind(batch.to_string())
                .bind(integer(jobs.len()) < JOBS_AT_ONCE)
                .execute(&mut *transaction)
                .await?;
            transaction.commit().await?;
            Ok(Some(jobs))
        };
        let Some(jobs) = self.local.disk.with_reserve(write).await? else {
            return Ok(false);
        };
        let is_left = integer(jobs.len()) >= JOBS_AT_ONCE;
        for job in jobs.into_iter().map(Uuid::from) {
            self.local.remove_files(job).await;
            self.local.changed(job);
        }
        Ok(is_left)
    }
}

/// Checks whether jobs of a batch wait, run or are still to be queued.
async fn is_active(
    transaction: &mut Transaction<'_, Sqlite>,
    batch: Uuid,
) -> Result<bool, StoreError> {
    let is_active = sqlx::query_scalar(
        "SELECT EXISTS (SELECT 1 FROM jobs WHERE sweep_id = ?1 AND status IN ('queued', 'running')) \
         OR EXISTS (SELECT 1 FROM expansions WHERE sweep_id = ?1 AND NOT is_over)",
    )
    .bind(batch.to_string());
    Ok(is_active.fetch_one(&mut **transaction).await?)
}
