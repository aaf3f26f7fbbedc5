//! Reclaiming jobs from lost workers: into the queue, or under a new lease to be ended.

use std::time::{Duration, Instant};

use sqlx::AssertSqlSafe;

use crate::clock::Now;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::compared::Compared;
use crate::store::postgres::sql::lost_jobs::SELECT_LOST;
use crate::store::rows::integer;
use crate::store::{Reclaimed, StoreError};

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
        let statement = format!(
            "{SELECT_LOST} WHERE status = 'running' AND lease_expires_at <= $1 ORDER BY id FOR UPDATE SKIP LOCKED"
        );
        let lost = sqlx::query(AssertSqlSafe(statement))
            .bind(ended_by)
            .fetch_all(&mut *transaction)
            .await?;
        self.reclaim_lost(transaction, lost, now, length, REASON)
            .await
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
