//! Batches with jobs that are queued only when others have been solved.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::store::StoreError;
use crate::store::batch_rows::expansion;
use crate::store::batches::{Expansion, NewBatchJob, NewExpansion, Portion};
use crate::store::gauges::UNKNOWN_CPU_MS;
use crate::store::new_row::estimated;
use crate::store::rows::integer;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::insertion::insert;
use crate::store::sqlite::queries::BEGIN;

impl SqliteStore {
    pub(in crate::store) async fn expansions(&self) -> Result<Vec<Expansion>, StoreError> {
        let rows = sqlx::query(
            "SELECT sweep_id, next, jobs, (SELECT count(*) FROM jobs INDEXED BY jobs_by_sweep \
             WHERE jobs.sweep_id = expansions.sweep_id AND status = 'queued') AS waiting \
             FROM expansions WHERE NOT is_over ORDER BY sweep_id",
        )
        .fetch_all(&self.readers)
        .await?;
        rows.iter().map(expansion).collect()
    }

    pub(in crate::store) async fn expansion_request(
        &self,
        batch: Uuid,
    ) -> Result<Option<String>, StoreError> {
        let request =
            sqlx::query_scalar("SELECT request FROM expansions WHERE sweep_id = ? AND NOT is_over")
                .bind(batch.to_string());
        Ok(request.fetch_optional(&self.readers).await?)
    }

    pub(in crate::store) async fn extend_batch(
        &self,
        portion: &Portion,
    ) -> Result<bool, StoreError> {
        self.local.disk.check()?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
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
        let now = self.local.clock.now();
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
        self.local.many_wait();
        Ok(true)
    }
}

/// Notes the jobs that are to be queued.
pub(super) async fn insert_expansion(
    connection: &mut SqliteConnection,
    batch: Uuid,
    expansion: &NewExpansion,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO expansions (sweep_id, request, jobs, next, cpu_ms) VALUES (?, ?, ?, ?, ?)",
    )
    .bind(batch.to_string())
    .bind(&expansion.request)
    .bind(integer(expansion.jobs))
    .bind(integer(expansion.next))
    .bind(
        expansion
            .cpu_s
            .map_or(UNKNOWN_CPU_MS, |s| estimated(s, 1e3)),
    )
    .execute(connection)
    .await?;
    Ok(())
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
