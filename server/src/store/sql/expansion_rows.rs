//! Batches whose jobs are still to be queued.

use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{BY_SWEEP, Connection, EngineStore, stored_id};
use super::expansions::{insert_jobs, insert_refusals};
use crate::store::StoreError;
use crate::store::batch_rows::expansion;
use crate::store::batches::{Expansion, NewExpansion, Portion};
use crate::store::gauges::UNKNOWN_CPU_MS;
use crate::store::new_row::estimated;
use crate::store::rows::integer;

impl EngineStore {
    pub(in crate::store) async fn expansions(&self) -> Result<Vec<Expansion>, StoreError> {
        let statement = format!(
            "SELECT sweep_id, next, jobs, (SELECT count(*) FROM jobs{BY_SWEEP} \
             WHERE jobs.sweep_id = expansions.sweep_id AND status = 'queued') AS waiting \
             FROM expansions WHERE NOT is_over ORDER BY sweep_id"
        );
        let rows = sqlx::query(AssertSqlSafe(statement))
            .fetch_all(&self.readers)
            .await?;
        rows.iter().map(expansion).collect()
    }

    pub(in crate::store) async fn expansion_request(
        &self,
        batch: Uuid,
    ) -> Result<Option<String>, StoreError> {
        let request = sqlx::query_scalar(
            "SELECT request FROM expansions WHERE sweep_id = $1 AND NOT is_over",
        )
        .bind(stored_id(batch));
        Ok(request.fetch_optional(&self.readers).await?)
    }

    pub(in crate::store) async fn extend_batch(
        &self,
        portion: &Portion,
    ) -> Result<bool, StoreError> {
        self.process.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let positions = &portion.positions;
        let refused: Option<i64> = sqlx::query_scalar(
            "UPDATE expansions SET next = $1, is_over = $1 >= jobs, refused = refused + $4 \
             WHERE sweep_id = $2 AND next = $3 AND NOT is_over RETURNING refused",
        )
        .bind(integer(positions.end))
        .bind(stored_id(portion.batch))
        .bind(integer(positions.start))
        .bind(integer(portion.refused.len()))
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(refused) = refused else {
            return Ok(false);
        };
        insert_jobs(&mut transaction, portion.batch, &portion.jobs, now).await?;
        let refusals = portion.stored_refusals(refused);
        insert_refusals(&mut transaction, portion.batch, refusals).await?;
        transaction.commit().await?;
        self.process.many_wait();
        Ok(true)
    }
}

/// Notes the jobs that are to be queued.
pub(super) async fn insert_expansion(
    connection: &mut Connection,
    batch: Uuid,
    expansion: &NewExpansion,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO expansions (sweep_id, request, jobs, next, cpu_ms) VALUES ($1, $2, $3, $4, $5)",
    )
    .bind(stored_id(batch))
    .bind(&expansion.request)
    .bind(integer(expansion.jobs))
    .bind(integer(expansion.next))
    .bind(expansion.cpu_s.map_or(UNKNOWN_CPU_MS, |s| estimated(s, 1e3)))
    .execute(connection)
    .await?;
    Ok(())
}
