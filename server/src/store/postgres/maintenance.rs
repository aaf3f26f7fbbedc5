//! Maintenance: deadlines of queued jobs, retention of ended ones.

use api::job::{Outcome, Status};
use uuid::Uuid;

use crate::queue::Transition;
use crate::store::ending::EndingJob;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::transitions::end_job;
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

    pub(in crate::store) async fn time(&self) -> Result<i64, StoreError> {
        let mut connection = self.pool.acquire().await?;
        Ok(self.now(&mut connection).await?.system_ms)
    }

    pub(in crate::store) async fn delete_ended_before(
        &self,
        time: i64,
    ) -> Result<usize, StoreError> {
        let old: Vec<Uuid> = sqlx::query_scalar(
            "SELECT id FROM jobs WHERE finished_at < $1 ORDER BY finished_at LIMIT $2",
        )
        .bind(time)
        .bind(DELETE_LIMIT)
        .fetch_all(&self.pool)
        .await?;
        for id in &old {
            self.delete(*id).await?;
        }
        if !old.is_empty() {
            sqlx::query(
                "DELETE FROM sweeps WHERE created_at < $1 \
                 AND NOT EXISTS (SELECT 1 FROM sweep_jobs WHERE sweep_id = sweeps.id) \
                 AND NOT EXISTS (SELECT 1 FROM expansions WHERE sweep_id = sweeps.id AND NOT is_over)",
            )
            .bind(time)
            .execute(&self.pool)
            .await?;
        }
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

    /// Several processes may serve the database.
    #[expect(
        clippy::unused_async,
        reason = "other engines note in the database which process serves it"
    )]
    pub(in crate::store) async fn beat(&self) -> Result<(), StoreError> {
        Ok(())
    }
}
