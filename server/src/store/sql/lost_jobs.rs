//! Jobs of lost workers: into the queue, or under a new lease to be ended.

use std::time::Duration;

use api::job::Status;
use sqlx::Transaction;

use super::dialect::{Engine, EngineStore, Row, stored_id};
use super::transitions::end_job;
use crate::clock::Now;
use crate::store::ending::EndingJob;
use crate::store::leases::reclaim;
use crate::store::rows::{self, StoredRow, unsigned};
use crate::store::{Lease, Reclaimed, StoreError};

/// Selects what is read of running jobs to reclaim them; the condition follows.
pub(in super::super) const SELECT_LOST: &str =
    "SELECT id, fruitless, cancel_requested, lease_expires_at FROM jobs";

impl EngineStore {
    /// Reclaims jobs in a transaction that has locked them, and commits it. Those without another attempt are held under new leases of
    /// this length.
    pub(in super::super) async fn reclaim_lost(
        &self,
        mut transaction: Transaction<'_, Engine>,
        lost: Vec<Row>,
        now: Now,
        length: Duration,
        reason: &'static str,
    ) -> Result<Reclaimed, StoreError> {
        let (mut queued, mut ending) = (Vec::new(), Vec::new());
        for row in lost {
            let id = row.id("id")?;
            let end = reclaim(row.value("lease_expires_at")?, reason);
            let limit = self.process.attempt_limit;
            let fruitless = unsigned(&row, "fruitless")?;
            let job = EndingJob::running(id, fruitless, limit, row.value("cancel_requested")?);
            if job.after(end.transition).is_some_and(Status::is_terminal) {
                // Nothing is solved under the new lease, which this process holds.
                let row = sqlx::query(
                    "UPDATE jobs SET lease = lease + $3, lease_expires_at = $1, last_write = 0, worker = NULL, claim_number = NULL, lease_token = NULL, \
                     is_remote = false WHERE id = $2 RETURNING lease, spec, attempts, queued_at, deadline_at, memory_mb, cpu_ms",
                )
                .bind(now.end_of(length))
                .bind(stored_id(id))
                .bind(Lease::step())
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
