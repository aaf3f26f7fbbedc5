//! Upkeep: deadlines of waiting jobs, and the retention of ended ones.

use uuid::Uuid;

use crate::queue::Transition;
use crate::store::sqlite::conclusion::{End, end_waiting};
use crate::store::sqlite::queries::{BEGIN, job_id};
use crate::store::{Store, StoreError};
use api::job::{Outcome, Status};

/// Ended jobs removed at once, so that nobody waits long for the writer.
const REMOVED_AT_ONCE: i64 = 50;

impl Store {
    /// Fails waiting jobs whose deadline has passed. Returns how many.
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
            step: Transition::Expire,
            reason: Some("its deadline passed while it waited".to_owned()),
            outcome: Some(Outcome::DeadlineExceeded),
            summary: None,
        };
        let mut ended = Vec::with_capacity(late.len());
        for text in late {
            let id = job_id(&text)?;
            end_waiting(&mut transaction, id, &end, now).await?;
            ended.push(id);
        }
        transaction.commit().await?;
        for id in &ended {
            self.concluded(*id, Some(Status::Failed));
        }
        Ok(ended.len())
    }

    /// Deletes some of the jobs that ended before a time, the oldest first, and sweeps that this leaves without jobs.
    /// Returns how many jobs.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete_ended_before(&self, time: i64) -> Result<usize, StoreError> {
        let old: Vec<String> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE finished_at < ? ORDER BY finished_at LIMIT ?",
        )
        .bind(time)
        .bind(REMOVED_AT_ONCE)
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
}
