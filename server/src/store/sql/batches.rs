//! Batches: jobs that were queued together. An evaluation plan is a row of the table `studies`.

use std::collections::BTreeMap;
use std::time::Instant;

use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{BY_SWEEP, Engine, EngineStore, StoredId, read_id, stored_id};
use crate::store::batch_rows::{batch_job, batch_overview, no_jobs, refused_job};
use crate::store::batches::{
    BatchDetail, BatchFilter, BatchJob, BatchOverview, BatchPart, StoredBatch,
};
use crate::store::rows::{StoredRow, integer};
use crate::store::{RequestKey, StoreError, Submitted};

/// The columns of an overview, of `sweeps` beside `expansions`.
macro_rules! overviews {
    () => {
        "SELECT id, name, created_at, jobs AS asked, \
         COALESCE(CASE WHEN is_over THEN 0 ELSE jobs - next END, 0) AS to_come, \
         COALESCE(CASE WHEN is_over THEN jobs - next ELSE 0 END, 0) AS never_queued, \
         COALESCE(refused, 0) AS refused"
    };
}

impl EngineStore {
    pub(in crate::store) async fn submitted_batch(
        &self,
        key: &RequestKey,
    ) -> Result<Option<Submitted>, StoreError> {
        submitted(self.priority_readers(), key).await
    }

    pub(in crate::store) async fn batch_without_profiles(
        &self,
        id: Uuid,
        part: BatchPart,
        detail: BatchDetail,
    ) -> Result<Option<StoredBatch>, StoreError> {
        let batch = sqlx::query(concat!(
            overviews!(),
            ", plan, request FROM sweeps LEFT JOIN expansions ON expansions.sweep_id = id \
             LEFT JOIN studies ON studies.sweep_id = id WHERE id = $1 AND ending IS DISTINCT FROM 'delete'",
        ))
        .bind(stored_id(id))
        .fetch_optional(&self.readers)
        .await?;
        let Some(batch) = batch else {
            return Ok(None);
        };
        let jobs = self.batch_jobs(id, part, detail).await?;
        let refused = sqlx::query(
            "SELECT position, overrides, reason FROM refused_jobs WHERE sweep_id = $1 ORDER BY position",
        )
        .bind(stored_id(id))
        .fetch_all(&self.readers)
        .await?;
        let refused = refused.iter().map(|row| refused_job(id, row));
        Ok(Some(StoredBatch {
            overview: batch_overview(&batch, self.batch_counts(id).await?)?,
            plan: batch.value("plan")?,
            request: batch.value("request")?,
            jobs,
            refused: refused.collect::<Result<_, _>>()?,
        }))
    }

    pub(in crate::store) async fn batch_jobs(
        &self,
        id: Uuid,
        part: BatchPart,
        detail: BatchDetail,
    ) -> Result<Vec<BatchJob>, StoreError> {
        let rows = sqlx::query(
            "SELECT job_id, position, overrides, status, status_reason, outcome, CASE WHEN $1 THEN summary END AS summary \
             FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_jobs.sweep_id = $2 AND position >= $3 \
             ORDER BY position LIMIT $4",
        )
        .bind(detail >= BatchDetail::Summaries)
        .bind(stored_id(id))
        .bind(integer(part.from))
        .bind(i64::from(part.limit))
        .fetch_all(&self.readers)
        .await?;
        let jobs = rows.iter().map(|row| batch_job(&self.process, row));
        jobs.collect()
    }

    pub(in crate::store) async fn sent_base(
        &self,
        batch: Uuid,
    ) -> Result<Option<String>, StoreError> {
        let base: Option<Option<String>> =
            sqlx::query_scalar("SELECT base FROM sweeps WHERE id = $1")
                .bind(stored_id(batch))
                .fetch_optional(&self.readers)
                .await?;
        Ok(base.flatten())
    }

    pub(in crate::store) async fn batches(
        &self,
        filter: BatchFilter,
    ) -> Result<Vec<BatchOverview>, StoreError> {
        let rows = sqlx::query(concat!(
            overviews!(),
            " FROM sweeps LEFT JOIN expansions ON expansions.sweep_id = id \
             WHERE id < $1 AND ending IS DISTINCT FROM 'delete' AND (NOT $2 OR id IN (SELECT sweep_id FROM studies)) \
             ORDER BY id DESC LIMIT $3",
        ))
        .bind(stored_id(filter.before.unwrap_or(Uuid::max())))
        .bind(filter.with_plan)
        .bind(i64::from(filter.limit))
        .fetch_all(&self.readers)
        .await?;
        let mut batches = Vec::with_capacity(rows.len());
        for row in rows {
            let counts = self.batch_counts(row.id("id")?).await?;
            batches.push(batch_overview(&row, counts)?);
        }
        Ok(batches)
    }

    pub(in crate::store) async fn has_batch(
        &self,
        id: Uuid,
        with_plan: bool,
    ) -> Result<bool, StoreError> {
        let found = sqlx::query_scalar(
            "SELECT EXISTS (SELECT 1 FROM sweeps LEFT JOIN studies ON sweep_id = id \
             WHERE id = $1 AND ending IS DISTINCT FROM 'delete' AND (NOT $2 OR plan IS NOT NULL))",
        )
        .bind(stored_id(id))
        .bind(with_plan)
        .fetch_one(&self.readers);
        Ok(found.await?)
    }

    /// Counts the jobs of a batch by status; of a large one, every now and then.
    async fn batch_counts(&self, id: Uuid) -> Result<BTreeMap<String, u64>, StoreError> {
        if let Some(kept) = self.process.batch_counts.kept(id) {
            return Ok(kept);
        }
        let began = Instant::now();
        let statement = format!(
            "SELECT status, count(*) FROM jobs{BY_SWEEP} WHERE sweep_id = $1 GROUP BY status"
        );
        let rows: Vec<(String, i64)> = sqlx::query_as(AssertSqlSafe(statement))
            .bind(stored_id(id))
            .fetch_all(&self.readers)
            .await?;
        let mut counts = no_jobs();
        let count = |(status, count): (String, i64)| (status, count.try_into().unwrap_or_default());
        counts.extend(rows.into_iter().map(count));
        self.process.batch_counts.keep(id, &counts, began);
        Ok(counts)
    }
}

/// Returns the batch that an earlier request with the same key queued.
pub(super) async fn submitted(
    database: impl sqlx::Executor<'_, Database = Engine>,
    key: &RequestKey,
) -> Result<Option<Submitted>, StoreError> {
    let earlier: Option<(Vec<u8>, StoredId)> =
        sqlx::query_as("SELECT body_sha256, id FROM sweeps WHERE request_key = $1")
            .bind(&key.key)
            .fetch_optional(database)
            .await?;
    Ok(earlier.map(|(body, batch)| key.repeated(&body, read_id(batch))))
}
