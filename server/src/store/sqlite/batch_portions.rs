//! Cancellation and deletion of the jobs of a batch, a limited number in a transaction.

use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::store::StoreError;
use crate::store::batches::JOBS_AT_ONCE;
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::sql::batch_endings::is_active;
use crate::store::sqlite::sql::job_rows::cancel;

impl SqliteStore {
    pub(in crate::store) async fn cancel_some(&self, batch: Uuid) -> Result<bool, StoreError> {
        let write = async || {
            let (mut transaction, now) = self.begin().await?;
            let jobs: Vec<Hyphenated> = sqlx::query_scalar(
                "SELECT id FROM jobs WHERE sweep_id = ? AND status IN ('queued', 'running') \
                 AND (status = 'queued' OR NOT cancel_requested) LIMIT ?",
            )
            .bind(batch.to_string())
            .bind(JOBS_AT_ONCE)
            .fetch_all(&mut *transaction)
            .await?;
            let mut effects = Vec::with_capacity(jobs.len());
            for job in jobs.into_iter().map(Uuid::from) {
                effects.push((job, cancel(&mut transaction, job, now).await?));
            }
            transaction.commit().await?;
            Ok(effects)
        };
        let effects = self.process.disk.with_reserve(write).await?;
        for (job, effect) in &effects {
            self.process.cancelled(*job, *effect);
        }
        Ok(!effects.is_empty())
    }

    pub(in crate::store) async fn delete_some(&self, batch: Uuid) -> Result<bool, StoreError> {
        let write = async || {
            let (mut transaction, _) = self.begin().await?;
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
        let Some(jobs) = self.process.disk.with_reserve(write).await? else {
            return Ok(false);
        };
        let is_left = integer(jobs.len()) >= JOBS_AT_ONCE;
        for job in jobs.into_iter().map(Uuid::from) {
            self.process.remove_files(job).await;
            self.process.changed(job);
        }
        Ok(is_left)
    }
}
