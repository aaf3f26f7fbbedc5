//! Batches: jobs that were queued together. An evaluation plan is a row of the table `studies`.

use std::collections::BTreeMap;
use std::time::Instant;

use sqlx::postgres::{PgConnection, PgExecutor};
use uuid::Uuid;

use crate::clock::Now;
use crate::store::batch_rows::{batch_job, batch_overview, no_jobs, refused_job};
use crate::store::batches::{
    BatchDetail, BatchFilter, BatchJob, BatchOverview, BatchPart, NewBatch, StoredBatch,
};
use crate::store::job_ids::new_id;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::expansions::{insert_expansion, insert_jobs};
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

impl PostgresStore {
    pub(in crate::store) async fn submit_batch(
        &self,
        batch: &NewBatch,
        key: Option<&RequestKey>,
    ) -> Result<Submitted, StoreError> {
        self.local.disk.check()?;
        let (mut transaction, now) = self.begin().await?;
        let id = new_id(now.system_ms);
        if !insert_batch(&mut transaction, (id, batch), key, now).await?
            && let Some(key) = key
        {
            // The transaction of the earlier request has ended: this one has waited for it.
            let earlier = submitted(&mut *transaction, key).await?;
            return earlier.ok_or(StoreError::Unwritten);
        }
        if let Some(expansion) = &batch.expansion {
            insert_expansion(&mut transaction, id, expansion).await?;
        }
        insert_jobs(&mut transaction, id, &batch.jobs, now).await?;
        transaction.commit().await?;
        self.local.many_wait();
        Ok(Submitted::Job(id))
    }

    pub(in crate::store) async fn submitted_batch(
        &self,
        key: &RequestKey,
    ) -> Result<Option<Submitted>, StoreError> {
        submitted(&self.pool, key).await
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
        .bind(id)
        .fetch_optional(&self.readers)
        .await?;
        let Some(batch) = batch else {
            return Ok(None);
        };
        let jobs = self.batch_jobs(id, part, detail).await?;
        let refused = sqlx::query(
            "SELECT position, overrides, reason FROM refused_jobs WHERE sweep_id = $1 ORDER BY position",
        )
        .bind(id)
        .fetch_all(&self.readers)
        .await?;
        let refused = refused.iter().map(|row| refused_job(id, row));
        Ok(Some(StoredBatch {
            overview: batch_overview(&batch, self.batch_counts(id).await?)?,
            plan: batch.optional_text("plan")?,
            request: batch.optional_text("request")?,
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
        .bind(id)
        .bind(integer(part.from))
        .bind(i64::from(part.limit))
        .fetch_all(&self.readers)
        .await?;
        let jobs = rows.iter().map(|row| batch_job(&self.local, row));
        jobs.collect()
    }

    pub(in crate::store) async fn sent_base(
        &self,
        batch: Uuid,
    ) -> Result<Option<String>, StoreError> {
        let base: Option<Option<String>> =
            sqlx::query_scalar("SELECT base FROM sweeps WHERE id = $1")
                .bind(batch)
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
        .bind(filter.before.unwrap_or(Uuid::max()))
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
        .bind(id)
        .bind(with_plan)
        .fetch_one(&self.readers);
        Ok(found.await?)
    }

    /// Counts the jobs of a batch by status; of a large one, every now and then.
    async fn batch_counts(&self, id: Uuid) -> Result<BTreeMap<String, u64>, StoreError> {
        if let Some(kept) = self.local.batch_counts.kept(id) {
            return Ok(kept);
        }
        let began = Instant::now();
        let rows: Vec<(String, i64)> =
            sqlx::query_as("SELECT status, count(*) FROM jobs WHERE sweep_id = $1 GROUP BY status")
                .bind(id)
                .fetch_all(&self.readers)
                .await?;
        let mut counts = no_jobs();
        let count = |(status, count): (String, i64)| (status, count.try_into().unwrap_or_default());
        counts.extend(rows.into_iter().map(count));
        self.local.batch_counts.keep(id, &counts, began);
        Ok(counts)
    }
}

/// Adds a batch without its jobs; false if an earlier request with the same key has added one.
async fn insert_batch(
    connection: &mut PgConnection,
    (id, batch): (Uuid, &NewBatch),
    key: Option<&RequestKey>,
    now: Now,
) -> Result<bool, StoreError> {
    let added = sqlx::query(
        "INSERT INTO sweeps (id, name, base, created_at, request_key, body_sha256, submitted_ms) \
         VALUES ($1, $2, $3, $4, $5, $6, (SELECT passed_ms FROM service_time)) \
         ON CONFLICT (request_key) DO NOTHING",
    )
    .bind(id)
    .bind(&batch.name)
    .bind(&batch.base)
    .bind(now.system_ms)
    .bind(key.map(|key| &key.key))
    .bind(key.map(|key| key.meaning_sha256.as_slice()))
    .execute(&mut *connection)
    .await?;
    if let Some(plan) = batch.plan.as_ref().filter(|_| added.rows_affected() > 0) {
        sqlx::query("INSERT INTO studies (sweep_id, plan) VALUES ($1, $2)")
            .bind(id)
            .bind(plan)
            .execute(connection)
            .await?;
    }
    Ok(added.rows_affected() > 0)
}

/// Returns the batch that an earlier request with the same key queued.
async fn submitted(
    database: impl PgExecutor<'_>,
    key: &RequestKey,
) -> Result<Option<Submitted>, StoreError> {
    let earlier: Option<(Vec<u8>, Uuid)> =
        sqlx::query_as("SELECT body_sha256, id FROM sweeps WHERE request_key = $1")
            .bind(&key.key)
            .fetch_optional(database)
            .await?;
    Ok(earlier.map(|(body, id)| key.repeated(&body, id)))
}
