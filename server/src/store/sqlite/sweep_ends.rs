//! Cancelling and deleting sweeps with all their jobs.

use api::job::Status;
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::store::sqlite::jobs::cancel;
use crate::store::sqlite::queries::{BEGIN, job_id};
use crate::store::{Cancelled, Deleted, Store, StoreError};

impl Store {
    /// Asks for the end of all jobs of a sweep; `false` if there is no such sweep.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn cancel_sweep(&self, id: Uuid, now: i64) -> Result<bool, StoreError> {
        if self.sweep_head(id).await?.is_none() {
            return Ok(false);
        }
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let jobs = jobs_of(&mut transaction, id).await?;
        let mut changed = Vec::with_capacity(jobs.len());
        for job in jobs {
            match cancel(&mut transaction, job, now).await? {
                Some(Cancelled::AtOnce) => changed.push((job, Some(Status::Cancelled))),
                Some(Cancelled::Requested) => changed.push((job, None)),
                Some(Cancelled::Already) | None => {}
            }
        }
        transaction.commit().await?;
        for (job, ended) in changed {
            self.concluded(job, ended);
        }
        Ok(true)
    }

    /// Deletes a sweep whose jobs have all ended, with the jobs, their events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete_sweep(&self, id: Uuid) -> Result<Deleted, StoreError> {
        if self.sweep_head(id).await?.is_none() {
            return Ok(Deleted::Missing);
        }
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let active: i64 = sqlx::query_scalar(
            "SELECT count(*) FROM sweep_jobs JOIN jobs ON jobs.id = job_id \
             WHERE sweep_id = ? AND finished_at IS NULL",
        )
        .bind(id.to_string())
        .fetch_one(&mut *transaction)
        .await?;
        if active > 0 {
            return Ok(Deleted::Active);
        }
        let jobs = jobs_of(&mut transaction, id).await?;
        for statement in [
            "DELETE FROM jobs WHERE id IN (SELECT job_id FROM sweep_jobs WHERE sweep_id = ?)",
            "DELETE FROM sweeps WHERE id = ?",
        ] {
            sqlx::query(statement)
                .bind(id.to_string())
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        for job in jobs {
            self.remove_files(job).await;
            self.changed(job);
        }
        Ok(Deleted::Done)
    }
}

async fn jobs_of(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
) -> Result<Vec<Uuid>, StoreError> {
    let jobs: Vec<String> = sqlx::query_scalar("SELECT job_id FROM sweep_jobs WHERE sweep_id = ?")
        .bind(id.to_string())
        .fetch_all(&mut **transaction)
        .await?;
    jobs.iter().map(|id| job_id(id)).collect()
}
