//! Reclaiming jobs from lost workers: into the queue, or under a new lease to be ended.

use std::time::Duration;

use api::job::Status;
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::store::ending::EndingJob;
use crate::store::leases;
use crate::store::leases::ENDED_BY_RESTORE;
use crate::store::rows;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::transitions::end_job;
use crate::store::{Lease, Reclaimed, StoreError};

/// Which running jobs are reclaimed.
enum Lost {
    /// Those whose lease has ended by this time, ms.
    EndedBy(i64),
    /// Leases of workers in the process that served before.
    OfLastProcess,
}

impl SqliteStore {
    pub(in crate::store) async fn reclaim_expired(
        &self,
        length: Duration,
    ) -> Result<Reclaimed, StoreError> {
        let lost = Lost::EndedBy(self.process.clock.now().monotonic_ms);
        self.reclaim(lost, length, "its worker was lost").await
    }

    pub(in crate::store) async fn reclaim_at_start(
        &self,
        length: Duration,
        remote: Duration,
    ) -> Result<Reclaimed, StoreError> {
        sqlx::query(
            "UPDATE jobs SET lease_expires_at = ? WHERE status = 'running' AND is_remote AND lease_expires_at <> ?",
        )
        .bind(self.process.clock.end_of(remote))
        .bind(ENDED_BY_RESTORE)
        .execute(&self.writer)
        .await?;
        let reason = "the service was ended while it ran";
        self.reclaim(Lost::OfLastProcess, length, reason).await
    }

    async fn reclaim(
        &self,
        lost: Lost,
        length: Duration,
        reason: &'static str,
    ) -> Result<Reclaimed, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let lost: Vec<(Hyphenated, u32, bool, i64)> = match lost {
            Lost::EndedBy(by) => sqlx::query_as(
                "SELECT id, fruitless, cancel_requested, lease_expires_at FROM jobs INDEXED BY jobs_leased \
                 WHERE status = 'running' AND lease_expires_at <= ?",
            )
            .bind(by),
            Lost::OfLastProcess => sqlx::query_as(
                "SELECT id, fruitless, cancel_requested, lease_expires_at FROM jobs \
                 WHERE status = 'running' AND (NOT is_remote OR lease_expires_at = ?)",
            )
            .bind(ENDED_BY_RESTORE),
        }
        .fetch_all(&mut *transaction)
        .await?;
        let (mut queued, mut ending) = (Vec::new(), Vec::new());
        for (id, fruitless, cancel_requested, ended_at) in lost {
            let id = Uuid::from(id);
            let end = leases::reclaim(ended_at, reason);
            let job =
                EndingJob::running(id, fruitless, self.process.attempt_limit, cancel_requested);
            if job.after(end.transition).is_some_and(Status::is_terminal) {
                // Nothing is solved under the new lease, which this process holds.
                let row = sqlx::query(
                    "UPDATE jobs SET lease = lease + ?, lease_expires_at = ?, last_write = 0, worker = NULL, claim_number = NULL, lease_token = NULL, \
                     is_remote = 0 WHERE id = ? \
                     RETURNING lease, spec, attempts, queued_at, deadline_at, memory_mb, cpu_ms",
                )
                .bind(Lease::step())
                .bind(now.end_of(length))
                .bind(id.to_string())
                .fetch_one(&mut *transaction)
                .await?;
                ending.push(rows::claim(id, &row, now, None)?);
            } else {
                let status = end_job(&mut transaction, &job, &end, now).await?;
                queued.push((id, status));
            }
        }
        transaction.commit().await?;
        for (id, status) in &queued {
            self.process.ended_by_worker(*id, *status);
        }
        for _ in 0..queued.len() + ending.len() {
            self.process.metrics.reclaimed.inc();
        }
        Ok(Reclaimed {
            queued: queued.len(),
            ending,
            reason,
        })
    }
}
