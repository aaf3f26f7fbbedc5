//! Cancellation and deletion of the jobs of a batch, a limited number in a transaction.

use api::job::Status;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::batches::JOBS_AT_ONCE;
use crate::store::postgres::sql::batch_endings::is_active;
use crate::store::postgres::sql::job_rows::cancel;
use crate::store::postgres::{PostgresStore, begin};

impl PostgresStore {
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
            self.process.cancelled(*job, *effect);
        }
        // Jobs that have ended while this transaction waited for their locks are not among them.
        Ok(!effects.is_empty())
    }

    pub(in crate::store) async fn delete_some(&self, batch: Uuid) -> Result<bool, StoreError> {
        let mut transaction = begin(&self.writer, None).await?;
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
            self.process.remove_files(job).await;
            self.process.changed(job);
        }
        Ok(is_left)
    }
}
