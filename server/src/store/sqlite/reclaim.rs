//! Reclaiming jobs from lost workers: into the queue, or under a new lease to be ended.

use api::job::Status;
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::queue::Transition;
use crate::store::sqlite::claims::claimed;
use crate::store::sqlite::queries::BEGIN;
use crate::store::sqlite::transitions::{EndingJob, end_job};
use crate::store::{End, Reclaimed, Store, StoreError};

impl Store {
    /// Reclaims running jobs whose lease has ended by this time. Those without another attempt are held under new
    /// leases until `expires_at`.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn reclaim_expired(&self, by: i64, expires_at: i64) -> Result<Reclaimed, StoreError> {
        self.reclaim(by, expires_at, "its worker was lost").await
    }

    /// Reclaims all running jobs, at start-up: the process that held them has ended.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn reclaim_all(&self, expires_at: i64) -> Result<Reclaimed, StoreError> {
        let reason = "the service was ended while it ran";
        self.reclaim(i64::MAX, expires_at, reason).await
    }

    async fn reclaim(
        &self,
        by: i64,
        expires_at: i64,
        reason: &'static str,
    ) -> Result<Reclaimed, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let lost: Vec<(Hyphenated, u32, bool)> = sqlx::query_as(
            "SELECT id, fruitless, cancel_requested FROM jobs WHERE status = 'running' AND lease_expires_at <= ?",
        )
        .bind(by)
        .fetch_all(&mut *transaction)
        .await?;
        let end = End::without_result(Transition::WorkerLost, reason);
        let (mut queued, mut ending) = (Vec::new(), Vec::new());
        for (id, fruitless, cancel_requested) in lost {
            let id = Uuid::from(id);
            let job = EndingJob::running(id, fruitless, self.attempt_limit, cancel_requested);
            if job.after(end.transition).is_some_and(Status::is_terminal) {
                // Nothing is solved under the new lease.
                let row = sqlx::query(
                    "UPDATE jobs SET lease = lease + 1, lease_expires_at = ? WHERE id = ? \
                     RETURNING lease, spec, attempts, deadline_at, memory_mb",
                )
                .bind(expires_at)
                .bind(id.to_string())
                .fetch_one(&mut *transaction)
                .await?;
                ending.push(claimed(id, &row, 0, None)?);
            } else {
                let status = end_job(&mut transaction, &job, &end, None, 0).await?;
                queued.push((id, status));
            }
        }
        transaction.commit().await?;
        for (id, status) in &queued {
            self.concluded(*id, *status);
        }
        for _ in 0..queued.len() + ending.len() {
            self.metrics.reclaimed.inc();
        }
        Ok(Reclaimed {
            queued: queued.len(),
            ending,
            reason,
        })
    }
}
