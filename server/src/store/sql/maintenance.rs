//! Maintenance: deadlines of queued jobs, retention of ended ones, the write probe.

use std::time::{Duration, Instant};

use api::job::{Outcome, Status};
use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{BY_DEADLINE, EngineStore, GREATEST, LEAST, SKIP_LOCKED, StoredId, read_id};
use super::transitions::end_job;
use crate::queue::Transition;
use crate::store::ending::EndingJob;
use crate::store::gauges::PROBE_INTERVAL;
use crate::store::limits::LONGEST_COUNTED_MS;
use crate::store::rows::integer;
use crate::store::{End, StoreError};

/// Largest number of jobs deleted in a call; bounds how long other writes wait.
const DELETE_LIMIT: i64 = 50;

impl EngineStore {
    pub(in crate::store) async fn expire(&self) -> Result<usize, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let statement = format!(
            "SELECT id FROM jobs{BY_DEADLINE} WHERE status = 'queued' AND deadline_at <= $1 ORDER BY id{SKIP_LOCKED}"
        );
        let late: Vec<StoredId> = sqlx::query_scalar(AssertSqlSafe(statement))
            .bind(now.monotonic_ms)
            .fetch_all(&mut *transaction)
            .await?;
        let late: Vec<Uuid> = late.into_iter().map(read_id).collect();
        let end = End {
            outcome: Some(Outcome::DeadlineExceeded),
            ..End::without_result(Transition::Expire, "its deadline passed while it waited")
        };
        for id in &late {
            let job = EndingJob::queued(*id, false);
            end_job(&mut transaction, &job, &end, now).await?;
        }
        transaction.commit().await?;
        for id in &late {
            self.process.concluded(*id, Some(Status::Failed));
        }
        Ok(late.len())
    }

    pub(in crate::store) async fn ready(&self) -> Result<(), StoreError> {
        self.process.disk.check()?;
        let mut last = self.last_probe.lock().await;
        if last.is_some_and(|at| at.elapsed() < PROBE_INTERVAL) {
            return Ok(());
        }
        let (mut transaction, now) = self.begin().await?;
        sqlx::query(
            "INSERT INTO probes (name, written_at) VALUES ('ready', $1) \
             ON CONFLICT (name) DO UPDATE SET written_at = excluded.written_at",
        )
        .bind(now.system_ms)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        *last = Some(Instant::now());
        Ok(())
    }

    /// Several services of a database count the same time once.
    pub(in crate::store) async fn count_time(&self) -> Result<(), StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let statement = format!(
            "UPDATE service_time SET passed_ms = passed_ms + {LEAST}({GREATEST}($1 - counted_at, 0), $2), counted_at = $1"
        );
        sqlx::query(AssertSqlSafe(statement))
            .bind(now.monotonic_ms)
            .bind(LONGEST_COUNTED_MS)
            .execute(&mut *transaction)
            .await?;
        Ok(transaction.commit().await?)
    }

    pub(in crate::store) async fn delete_older(&self, age: Duration) -> Result<usize, StoreError> {
        let old: Vec<StoredId> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE finished_at IS NOT NULL AND ended_ms < (SELECT passed_ms FROM service_time) - $1 \
             ORDER BY ended_ms, finished_at LIMIT $2",
        )
        .bind(integer(age.as_millis()))
        .bind(DELETE_LIMIT)
        .fetch_all(self.priority_readers())
        .await?;
        for id in old.iter().copied().map(read_id) {
            self.delete(id).await?;
        }
        sqlx::query(
            "DELETE FROM sweeps WHERE submitted_ms < (SELECT passed_ms FROM service_time) - $1 \
             AND NOT EXISTS (SELECT 1 FROM sweep_jobs WHERE sweep_id = sweeps.id) \
             AND NOT EXISTS (SELECT 1 FROM expansions WHERE sweep_id = sweeps.id AND NOT is_over)",
        )
        .bind(integer(age.as_millis()))
        .execute(&self.writer)
        .await?;
        Ok(old.len())
    }
}
