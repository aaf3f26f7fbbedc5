//! Maintenance: deadlines of queued jobs, retention of ended ones.

use std::time::Duration;

use api::job::{Outcome, Status};
use uuid::Uuid;

use crate::queue::Transition;
use crate::store::ending::EndingJob;
use crate::store::limits::LONGEST_COUNTED_MS;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::transitions::end_job;
use crate::store::rows::integer;
use crate::store::{End, StoreError};

/// Largest number of jobs deleted in a call; bounds how long other writes wait.
const DELETE_LIMIT: i64 = 50;
/// Revisions whose deletions are kept.
pub(super) const KEPT_REVISIONS: i64 = 1_000_000;

impl PostgresStore {
    pub(in crate::store) async fn expire(&self) -> Result<usize, StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let late: Vec<Uuid> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE status = 'queued' AND deadline_at <= $1 ORDER BY id FOR UPDATE SKIP LOCKED",
        )
        .bind(now.monotonic_ms)
        .fetch_all(&mut *transaction)
        .await?;
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
            self.local.concluded(*id, Some(Status::Failed));
        }
        Ok(late.len())
    }

    /// Several services of a database count the same time once.
    pub(in crate::store) async fn count_time(&self) -> Result<(), StoreError> {
        let mut connection = self.pool.acquire().await?;
        let now = self.now(&mut connection).await?;
        sqlx::query(
            "UPDATE service_time SET passed_ms = passed_ms + LEAST(GREATEST($1 - counted_at, 0), $2), counted_at = $1",
        )
        .bind(now.monotonic_ms)
        .bind(LONGEST_COUNTED_MS)
        .execute(&mut *connection)
        .await?;
        Ok(())
    }

    pub(in crate::store) async fn delete_older(&self, age: Duration) -> Result<usize, StoreError> {
        let old: Vec<Uuid> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE finished_at IS NOT NULL AND ended_ms < (SELECT passed_ms FROM service_time) - $1 \
             ORDER BY ended_ms, finished_at LIMIT $2",
        )
        .bind(integer(age.as_millis()))
        .bind(DELETE_LIMIT)
        .fetch_all(&self.pool)
        .await?;
        for id in &old {
            self.delete(*id).await?;
        }
        sqlx::query(
            "DELETE FROM sweeps WHERE submitted_ms < (SELECT passed_ms FROM service_time) - $1 \
             AND NOT EXISTS (SELECT 1 FROM sweep_jobs WHERE sweep_id = sweeps.id) \
             AND NOT EXISTS (SELECT 1 FROM expansions WHERE sweep_id = sweeps.id AND NOT is_over)",
        )
        .bind(integer(age.as_millis()))
        .execute(&self.pool)
        .await?;
        Ok(old.len())
    }

    /// The server keeps its own log; what is removed here are old notes of deletions.
    pub(in crate::store) async fn checkpoint_wal(&self) -> Result<(), StoreError> {
        sqlx::query(
            "DELETE FROM deleted_jobs WHERE revision <= (SELECT fretwear_last_revision()) - $1",
        )
        .bind(KEPT_REVISIONS)
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// The server does it by itself.
    #[expect(clippy::unused_async, reason = "a file has to be asked")]
    pub(in crate::store) async fn give_pages_back(&self) -> Result<(), StoreError> {
        Ok(())
    }

    /// Several processes may serve the database.
    #[expect(
        clippy::unused_async,
        reason = "other engines note in the database which process serves it"
    )]
    pub(in crate::store) async fn beat(&self) -> Result<(), StoreError> {
        Ok(())
    }
}
