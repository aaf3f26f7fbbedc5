//! Maintenance: deadlines of queued jobs, retention of ended ones.

use std::time::Duration;

use api::job::{Outcome, Status};
use uuid::fmt::Hyphenated;

use crate::queue::Transition;
use crate::store::ending::EndingJob;
use crate::store::limits::LONGEST_COUNTED_MS;
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::queries::BEGIN;
use crate::store::sqlite::transitions::end_job;
use crate::store::{End, StoreError};

/// Largest number of jobs deleted in a call; bounds how long other writes wait.
const DELETE_LIMIT: i64 = 50;

impl SqliteStore {
    pub(in crate::store) async fn expire(&self) -> Result<usize, StoreError> {
        let now = self.local.clock.now();
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let late: Vec<Hyphenated> =
            sqlx::query_scalar("SELECT id FROM jobs INDEXED BY jobs_by_deadline WHERE status = 'queued' AND deadline_at <= ?")
                .bind(now.monotonic_ms)
                .fetch_all(&mut *transaction)
                .await?;
        let end = End {
            outcome: Some(Outcome::DeadlineExceeded),
            ..End::without_result(Transition::Expire, "its deadline passed while it waited")
        };
        for id in &late {
            let job = EndingJob::queued((*id).into(), false);
            end_job(&mut transaction, &job, &end, None, now).await?;
        }
        transaction.commit().await?;
        for id in &late {
            self.local.concluded((*id).into(), Some(Status::Failed));
        }
        Ok(late.len())
    }

    pub(in crate::store) async fn count_time(&self) -> Result<(), StoreError> {
        sqlx::query(
            "UPDATE service_time SET passed_ms = passed_ms + min(max(?1 - counted_at, 0), ?2), counted_at = ?1",
        )
        .bind(self.local.clock.now().monotonic_ms)
        .bind(LONGEST_COUNTED_MS)
        .execute(&self.writer)
        .await?;
        Ok(())
    }

    pub(in crate::store) async fn delete_older(&self, age: Duration) -> Result<usize, StoreError> {
        let old: Vec<Hyphenated> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE finished_at IS NOT NULL AND ended_ms < (SELECT passed_ms FROM service_time) - ? \
             ORDER BY ended_ms, finished_at LIMIT ?",
        )
        .bind(integer(age.as_millis()))
        .bind(DELETE_LIMIT)
        .fetch_all(&self.readers)
        .await?;
        for id in &old {
            self.delete((*id).into()).await?;
        }
        sqlx::query(
            "DELETE FROM sweeps WHERE submitted_ms < (SELECT passed_ms FROM service_time) - ? \
             AND NOT EXISTS (SELECT 1 FROM sweep_jobs WHERE sweep_id = sweeps.id) \
             AND NOT EXISTS (SELECT 1 FROM expansions WHERE sweep_id = sweeps.id AND NOT is_over)",
        )
        .bind(integer(age.as_millis()))
        .execute(&self.writer)
        .await?;
        Ok(old.len())
    }
}
