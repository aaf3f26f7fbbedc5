//! Reclaiming jobs from lost workers: into the queue, or under a new lease to be ended.

use std::time::{Duration, Instant};

use api::job::Status;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::ending::EndingJob;
use crate::store::leases;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::compared::Compared;
use crate::store::postgres::transitions::end_job;
use crate::store::rows;
use crate::store::rows::integer;
use crate::store::{Lease, Reclaimed, StoreError};

const REASON: &str = "its worker was lost";

impl PostgresStore {
    /// Reclaims jobs whose lease has ended; each job is reclaimed by one of the processes that serve the database.
    pub(in crate::store) async fn reclaim_expired(
        &self,
        length: Duration,
    ) -> Result<Reclaimed, StoreError> {
        // Leases that end while this waits for the database are left to the next call: their workers may be waiting to renew them.
        let asked = Instant::now();
        let (mut transaction, now) = self.begin().await?;
        if !self.is_steady(now).await {
            return Ok(Reclaimed::default());
        }
        let waited_ms = match self.given_now() {
            Some(_) => 0,
            None => integer(asked.elapsed().as_millis()),
        };
        let ended_by = now.monotonic_ms - waited_ms;
        let lost: Vec<(Uuid, i64, bool, i64)> = sqlx::query_as(
            "SELECT id, fruitless, cancel_requested, lease_expires_at FROM jobs WHERE status = 'running' AND lease_expires_at <= $1 \
             ORDER BY id FOR UPDATE SKIP LOCKED",
        )
        .bind(ended_by)
        .fetch_all(&mut *transaction)
        .await?;
        let (mut queued, mut ending) = (Vec::new(), Vec::new());
        for (id, fruitless, cancel_requested, ended_at) in lost {
            let end = leases::reclaim(ended_at, REASON);
            let fruitless = fruitless.try_into().unwrap_or_default();
            let limit = self.process.attempt_limit;
            let job = EndingJob::running(id, fruitless, limit, cancel_requested);
            if job.after(end.transition).is_some_and(Status::is_terminal) {
                // Nothing is solved under the new lease, which this process holds.
                let row = sqlx::query(
                    "UPDATE jobs SET lease = lease + $3, lease_expires_at = $1, last_write = 0, worker = NULL, claim_number = NULL, lease_token = NULL, \
                     is_remote = false WHERE id = $2 RETURNING lease, spec, attempts, queued_at, deadline_at, memory_mb, cpu_ms",
                )
                .bind(now.end_of(length))
                .bind(id)
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
            reason: REASON,
        })
    }

    /// Returns `true` if the clock of the database has made no recent step against that of this process.
    async fn is_steady(&self, now: Now) -> bool {
        if self.given_now().is_some() {
            return true;
        }
        let mut compared = self.compared.lock().await;
        let next = Compared::after(compared.as_ref(), Instant::now(), now.system_ms);
        let is_steady = next.is_steady();
        *compared = Some(next);
        is_steady
    }

    /// No job belongs to a process that serves the database: leases end by themselves.
    #[expect(
        clippy::unused_async,
        reason = "other engines take the jobs of the process that served before"
    )]
    pub(in crate::store) async fn reclaim_at_start(
        &self,
        _length: Duration,
        _remote: Duration,
    ) -> Result<Reclaimed, StoreError> {
        Ok(Reclaimed::default())
    }
}
