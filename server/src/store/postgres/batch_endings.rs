//! Cancellation and deletion of all jobs of a batch, a limited number in a transaction.

use api::job::Status;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::store::batches::JOBS_AT_ONCE;
use crate::store::postgres::job_rows::cancel;
use crate::store::postgres::{PostgresStore, begin};
use crate::store::{BatchEnding, Deleted, StoreError};

impl PostgresStore {
    pub(in crate::store) async fn note_cancellation(&self, batch: Uuid) -> Result<(), StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        sqlx::query("UPDATE expansions SET is_over = true WHERE sweep_id = $1 AND NOT is_over")
            .bind(batch)
            .execute(&mut *transaction)
            .await?;
        sqlx::query("UPDATE sweeps SET ending = 'cancel' WHERE id = $1 AND ending IS NULL")
            .bind(batch)
            .execute(&mut *transaction)
            .await?;
        Ok(transaction.commit().await?)
    }

    pub(in crate::store) async fn note_deletion(&self, batch: Uuid) -> Result<Deleted, StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        if is_active(&mut transaction, batch).await? {
            return Ok(Deleted::Active);
        }
        let noted = sqlx::query(
            "UPDATE sweeps SET ending = 'delete' WHERE id = $1 AND ending IS DISTINCT FROM 'delete'",
        )
        .bind(batch)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(match noted.rows_affected() {
            0 => Deleted::Missing,
            _ => Deleted::Done,
        })
    }

    pub(in crate::store) async fn batch_endings(
        &self,
    ) -> Result<Vec<(Uuid, BatchEnding)>, StoreError> {
        let rows: Vec<(Uuid, String)> =
            sqlx::query_as("SELECT id, ending FROM sweeps WHERE ending IS NOT NULL ORDER BY id")
                .fetch_all(&self.readers)
                .await?;
        let rows = rows.into_iter();
        let endings = rows.filter_map(|(id, name)| Some((id, BatchEnding::from_name(&name)?)));
        Ok(endings.collect())
    }

    pub(in crate::store) async fn forget_ending(
        &self,
        batch: Uuid,
        ending: BatchEnding,
    ) -> Result<(), StoreError> {
        sqlx::query("UPDATE sweeps SET ending = NULL WHERE id = $1 AND ending = $2")
            .bind(batch)
            .bind(ending.as_str())
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    pub(in crate::store) async fn cancel_some(&self, batch: Uuid) -> Result<bool, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let mut jobs: Vec<Uuid> = Vec::new();
        for status in [Status::Queued, Status::Running] {
            if jobs.is_empty() {
                jobs = sqlx::query_scalar(
                    "SELECT id FROM jobs WHERE sweep_id = $1 AND status = $2 AND NOT cancel_requested \
                     ORDER BY id LIMIT $3 FOR UPDATE",
                )
                .bind(batch)
                .bind(status.as_str())
                .bind(JOBS_AT_ONCE)
                .fetch_all(&mut *transaction)
                .await?;
            }
        }
        let mut effects = Vec::with_capacity(jobs.len());
        for job in jobs {
            effects.push((job, cancel(&mut transaction, job, now).await?));
        }
        transaction.commit().await?;
        for (job, effect) in &effects {
            self.local.cancelled(*job, *effect);
        }
        // Jobs that have ended while this transaction waited for their locks are not among them.
        Ok(!effects.is_empty())
    }

    pub(in crate::store) async fn delete_some(&self, batch: Uuid) -> Result<bool, StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        if is_active(&mut transaction, batch).await? {
            return Ok(false);
        }
        let jobs: Vec<Uuid> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE sweep_id = $1 AND finished_at IS NOT NULL ORDER BY id LIMIT $2 FOR UPDATE",
        )
        .bind(batch)
        .bind(JOBS_AT_ONCE)
        .fetch_all(&mut *transaction)
        .await?;
        sqlx::query("DELETE FROM jobs WHERE id = ANY($1)")
            .bind(&jobs)
            .execute(&mut *transaction)
            .await?;
        let deleted = sqlx::query(
            "DELETE FROM sweeps WHERE id = $1 AND NOT EXISTS (SELECT 1 FROM jobs WHERE sweep_id = $1)",
        )
        .bind(batch)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        let is_left = deleted.rows_affected() == 0 && !jobs.is_empty();
        for job in jobs {
            self.local.remove_files(job).await;
            self.local.changed(job);
        }
        Ok(is_left)
    }
}

/// Checks whether jobs of a batch wait, run or are still to be queued.
async fn is_active(connection: &mut PgConnection, batch: Uuid) -> Result<bool, StoreError> {
    let is_active = sqlx::query_scalar(
        "SELECT EXISTS (SELECT 1 FROM jobs WHERE sweep_id = $1 AND status IN ('queued', 'running')) \
         OR EXISTS (SELECT 1 FROM expansions WHERE sweep_id = $1 AND NOT is_over)",
    )
    .bind(batch);
    Ok(is_active.fetch_one(connection).await?)
}
