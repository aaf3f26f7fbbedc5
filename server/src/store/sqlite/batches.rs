//! Batches: jobs that were queued together. An evaluation plan is a row of the table `studies`.

use std::collections::BTreeMap;
use std::time::Instant;

use sqlx::{Sqlite, SqliteExecutor, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::clock::Now;
use crate::store::batch_rows::{batch_job, batch_overview, no_jobs, refused_job};
use crate::store::batches::{
    BatchDetail, BatchFilter, BatchJob, BatchOverview, BatchPart, NewBatch, StoredBatch,
};
use crate::store::rows::{StoredRow, integer};
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::expansions::{insert_expansion, insert_jobs};
use crate::store::sqlite::queries::BEGIN;
use crate::store::{RequestKey, StoreError, Submitted};

/// The columns of an overview, of `sweeps` beside `expansions`.
macro_rules! overviews {
    () => {
        "SELECT id, name, created_at, jobs AS asked, COALESCE(iif(is_over, 0, jobs - next), 0) AS to_come, \
         COALESCE(iif(is_over, jobs - next, 0), 0) AS never_queued, \
         COALESCE(refused, 0) AS refused"
    };
}

impl SqliteStore {
    pub(in crate::store) async fn submit_batch(
        &self,
        batch: &NewBatch,
        key: Option<&RequestKey>,
    ) -> Result<Submitted, StoreError> {
        self.local.disk.check()?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        if let Some(key) = key
            && let Some(earlier) = submitted(&mut *transaction, key).await?
        {
            return Ok(earlier);
        }
        let id = insert_batch(&mut transaction, batch, key, self.local.clock.now()).await?;
        transaction.commit().await?;
        self.local.many_wait();
        Ok(Submitted::Job(id))
    }

    pub(in crate::store) async fn submitted_batch(
        &self,
        key: &RequestKey,
    ) -> Result<Option<Submitted>, StoreError> {
        submitted(&self.readers, key).await
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
             LEFT JOIN studies ON studies.sweep_id = id WHERE id = ? AND ending IS NOT 'delete'",
        ))
        .bind(id.to_string())
        .fetch_optional(&self.readers)
        .await?;
        let Some(batch) = batch else {
            return Ok(None);
        };
        let jobs = self.batch_jobs(id, part, detail).await?;
        let refused = sqlx::query(
            "SELECT position, overrides, reason FROM refused_jobs WHERE sweep_id = ? ORDER BY position",
        )
        .bind(id.to_string())
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
            "SELECT job_id, position, overrides, status, status_reason, outcome, CASE WHEN ? THEN summary END AS summary \
             FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_jobs.sweep_id = ? AND position >= ? \
             ORDER BY position LIMIT ?",
        )
        .bind(detail >= BatchDetail::Summaries)
        .bind(id.to_string())
        .bind(integer(part.from))
        .bind(part.limit)
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
            sqlx::query_scalar("SELECT base FROM sweeps WHERE id = ?")
                .bind(batch.to_string())
                .fetch_optional(&self.readers)
                .await?;
        Ok(base.flatten())
    }

    pub(in crate::store) async fn batches(
        &self,
        filter: BatchFilter,
    ) -> Result<Vec<BatchOverview>, StoreError> {
        // Ids are hexadecimal text, all of which sorts before `g`.
        let before = filter.before.map_or("g".to_owned(), |id| id.to_string());
        let rows = sqlx::query(concat!(
            overviews!(),
            " FROM sweeps LEFT JOIN expansions ON expansions.sweep_id = id \
             WHERE id < ? AND ending IS NOT 'delete' AND (NOT ? OR id IN (SELECT sweep_id FROM studies)) ORDER BY id DESC LIMIT ?",
        ))
        .bind(before)
        .bind(filter.with_plan)
        .bind(filter.limit)
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
             WHERE id = ? AND ending IS NOT 'delete' AND (NOT ? OR plan IS NOT NULL))",
        )
        .bind(id.to_string())
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
        let rows: Vec<(String, u64)> = sqlx::query_as(
            "SELECT status, count(*) FROM jobs INDEXED BY jobs_by_sweep WHERE sweep_id = ? GROUP BY status",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let mut counts = no_jobs();
        counts.extend(rows);
        self.local.batch_counts.keep(id, &counts, began);
        Ok(counts)
    }
}

async fn insert_batch(
    transaction: &mut Transaction<'_, Sqlite>,
    batch: &NewBatch,
    key: Option<&RequestKey>,
    now: Now,
) -> Result<Uuid, StoreError> {
    let id = Uuid::now_v7();
    sqlx::query(
        "INSERT INTO sweeps (id, name, base, created_at, request_key, body_sha256, submitted_ms) \
         VALUES (?, ?, ?, ?, ?, ?, (SELECT passed_ms FROM service_time))",
    )
    .bind(id.to_string())
    .bind(&batch.name)
    .bind(&batch.base)
    .bind(now.system_ms)
    .bind(key.map(|key| &key.key))
    .bind(key.map(|key| key.meaning_sha256.as_slice()))
    .execute(&mut **transaction)
    .await?;
    if let Some(plan) = &batch.plan {
        sqlx::query("INSERT INTO studies (sweep_id, plan) VALUES (?, ?)")
            .bind(id.to_string())
            .bind(plan)
            .execute(&mut **transaction)
            .await?;
    }
    if let Some(expansion) = &batch.expansion {
        insert_expansion(transaction, id, expansion).await?;
    }
    insert_jobs(transaction, id, &batch.jobs, now).await?;
    Ok(id)
}

/// Returns the batch that an earlier request with the same key queued.
async fn submitted(
    database: impl SqliteExecutor<'_>,
    key: &RequestKey,
) -> Result<Option<Submitted>, StoreError> {
    let earlier: Option<(Vec<u8>, Hyphenated)> =
        sqlx::query_as("SELECT body_sha256, id FROM sweeps WHERE request_key = ?")
            .bind(&key.key)
            .fetch_optional(database)
            .await?;
    Ok(earlier.map(|(body, id)| key.repeated(&body, id.into())))
}
