//! Batches with jobs that are queued only when others have been solved.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::StoreError;
use crate::store::batches::{NewBatchJob, Portion};
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::insertion::insert;

impl SqliteStore {
    pub(in crate::store) async fn extend_batch(
        &self,
        portion: &Portion,
    ) -> Result<bool, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let positions = &portion.positions;
        let refused: Option<i64> = sqlx::query_scalar(
            "UPDATE expansions SET next = ?1, is_over = ?1 >= jobs, refused = refused + ?4 \
             WHERE sweep_id = ?2 AND next = ?3 AND NOT is_over RETURNING refused",
        )
        .bind(integer(positions.end))
        .bind(portion.batch.to_string())
        .bind(integer(positions.start))
        .bind(integer(portion.refused.len()))
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(refused) = refused else {
            return Ok(false);
        };
        insert_jobs(&mut transaction, portion.batch, &portion.jobs, now).await?;
        for refused in portion.stored_refusals(refused) {
            sqlx::query(
                "INSERT INTO refused_jobs (sweep_id, position, overrides, reason) VALUES (?, ?, ?, ?)",
            )
            .bind(portion.batch.to_string())
            .bind(integer(refused.position))
            .bind(serde_json::to_string(&refused.overrides)?)
            .bind(&refused.reason)
            .execute(&mut *transaction)
            .await?;
        }
        transaction.commit().await?;
        self.process.many_wait();
        Ok(true)
    }
}

/// Queues jobs of a batch.
pub(super) async fn insert_jobs(
    connection: &mut SqliteConnection,
    batch: Uuid,
    jobs: &[NewBatchJob],
    now: Now,
) -> Result<(), StoreError> {
    for new in jobs {
        let id = insert(connection, &new.job, Some(batch), now).await?;
        sqlx::query(
            "INSERT INTO sweep_jobs (sweep_id, position, job_id, overrides) VALUES (?, ?, ?, ?)",
        )
        .bind(batch.to_string())
        .bind(integer(new.position))
        .bind(id.to_string())
        .bind(serde_json::to_string(&new.overrides)?)
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}
