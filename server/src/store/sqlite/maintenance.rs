//! Maintenance: deadlines of queued jobs, retention of ended ones, and the write-ahead log.

use api::job::{Outcome, Status};
use uuid::Uuid;

use crate::queue::Transition;
use crate::store::sqlite::queries::{BEGIN, job_id};
use crate::store::sqlite::transitions::end_queued;
use crate::store::{End, Store, StoreError};

/// Largest number of jobs deleted in a call; bounds how long other writes wait.
const DELETE_LIMIT: i64 = 50;

impl Store {
    /// Fails queued jobs whose deadline has passed. Returns how many.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn expire(&self, now: i64) -> Result<usize, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let late: Vec<String> =
            sqlx::query_scalar("SELECT id FROM jobs WHERE status = 'queued' AND deadline_at <= ?")
                .bind(now)
                .fetch_all(&mut *transaction)
                .await?;
        let end = End {
            outcome: Some(Outcome::DeadlineExceeded),
            ..End::without_result(Transition::Expire, "its deadline passed while it waited")
        };
        let mut ended = Vec::with_capacity(late.len());
        for text in late {
            let id = job_id(&text)?;
            end_queued(&mut transaction, id, &end, now).await?;
            ended.push(id);
        }
        transaction.commit().await?;
        for id in &ended {
            self.concluded(*id, Some(Status::Failed));
        }
        Ok(ended.len())
    }

    /// Deletes jobs that ended before a time, the oldest first and a limited number, and batches without remaining jobs.
    /// Returns the number of jobs.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete_ended_before(&self, time: i64) -> Result<usize, StoreError> {
        let old: Vec<String> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE finished_at < ? ORDER BY finished_at LIMIT ?",
        )
        .bind(time)
        .bind(DELETE_LIMIT)
        .fetch_all(&self.readers)
        .await?;
        let old: Vec<Uuid> = old.iter().map(|id| job_id(id)).collect::<Result<_, _>>()?;
        for id in &old {
            self.delete(*id).await?;
        }
        if !old.is_empty() {
            sqlx::query(
                "DELETE FROM sweeps WHERE created_at < ? \
                 AND NOT EXISTS (SELECT 1 FROM sweep_jobs WHERE sweep_id = sweeps.id)",
            )
            .bind(time)
            .execute(&self.writer)
            .await?;
        }
        Ok(old.len())
    }

    /// Moves the write-ahead log into the database, as far as readers allow and without waiting for them.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn checkpoint_wal(&self) -> Result<(), StoreError> {
        sqlx::query("PRAGMA wal_checkpoint(PASSIVE)")
            .execute(&self.writer)
            .await?;
        Ok(())
    }
}
