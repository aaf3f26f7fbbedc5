//! Reclaiming jobs from lost workers: into the queue, or under a new lease to be ended.

use std::time::Duration;

use sqlx::AssertSqlSafe;

use crate::store::leases::ENDED_BY_RESTORE;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::sql::lost_jobs::SELECT_LOST;
use crate::store::{Reclaimed, StoreError};

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
        let (condition, limit) = match lost {
            Lost::EndedBy(by) => (
                "INDEXED BY jobs_leased WHERE status = 'running' AND lease_expires_at <= ?",
                by,
            ),
            Lost::OfLastProcess => (
                "WHERE status = 'running' AND (NOT is_remote OR lease_expires_at = ?)",
                ENDED_BY_RESTORE,
            ),
        };
        let lost = sqlx::query(AssertSqlSafe(format!("{SELECT_LOST} {condition}")))
            .bind(limit)
            .fetch_all(&mut *transaction)
            .await?;
        self.reclaim_lost(transaction, lost, now, length, reason)
            .await
    }
}
