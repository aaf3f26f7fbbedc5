//! Reclaiming jobs from lost workers: into the queue, or under a new lease to be ended.

use api::job::Status;
use uuid::Uuid;

use crate::queue::Transition;
use crate::store::sqlite::queries::{BEGIN, attempt_count, job_id};
use crate::store::sqlite::transitions::{RunningJob, end_running};
use crate::store::{Claim, End, Reclaimed, Store, StoreError};

#[derive(sqlx::FromRow)]
struct LostRow {
    id: String,
    spec: String,
    attempts: i64,
    cancel_requested: bool,
    deadline_at: Option<i64>,
    memory_mb: i64,
}

impl LostRow {
    /// A claim under a new lease; nothing is solved under it.
    fn claim(self, id: Uuid, lease: i64) -> Claim {
        Claim {
            id,
            lease,
            spec: self.spec,
            attempt: attempt_count(self.attempts),
            waited_ms: 0,
            deadline_at: self.deadline_at,
            memory_mb: self.memory_mb,
            checkpoint: None,
        }
    }
}

impl Store {
    /// Reclaims running jobs whose lease has ended by this time. Those without another attempt are held under new leases
    /// until `expires_at`.
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
        let lost: Vec<LostRow> = sqlx::query_as(
            "SELECT id, spec, attempts, cancel_requested, deadline_at, memory_mb FROM jobs \
             WHERE status = 'running' AND lease_expires_at <= ?",
        )
        .bind(by)
        .fetch_all(&mut *transaction)
        .await?;
        let end = End::without_result(Transition::WorkerLost, reason);
        let (mut queued, mut ending) = (Vec::new(), Vec::new());
        for row in lost {
            let id = job_id(&row.id)?;
            let job = RunningJob::new(row.attempts, row.cancel_requested, self.attempt_limit);
            if job.after(end.transition).is_some_and(Status::is_terminal) {
                let lease = sqlx::query_scalar(
                    "UPDATE jobs SET lease = lease + 1, lease_expires_at = ? WHERE id = ? RETURNING lease",
                )
                .bind(expires_at)
                .bind(&row.id)
                .fetch_one(&mut *transaction)
                .await?;
                ending.push(row.claim(id, lease));
            } else {
                let status = end_running(&mut transaction, id, &job, &end, None, 0).await?;
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
