//! Batches: jobs that were queued together. An evaluation plan is a row of the table `studies`.

use std::collections::BTreeMap;

use sqlx::postgres::{PgConnection, PgExecutor};
use uuid::Uuid;

use crate::clock::Now;
use crate::store::batch_rows::{batch_job, batch_overview, no_jobs};
use crate::store::batches::{BatchDetail, BatchFilter, BatchOverview, NewBatch, StoredBatch};
use crate::store::job_ids::new_id;
use crate::store::new_row::NewRow;
use crate::store::postgres::job_rows::{cancel, insert};
use crate::store::postgres::{PostgresStore, begin};
use crate::store::rows::StoredRow;
use crate::store::{Deleted, RequestKey, StoreError, Submitted};

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
        insert_jobs(&mut transaction, (id, batch), now).await?;
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
        detail: BatchDetail,
    ) -> Result<Option<StoredBatch>, StoreError> {
        let batch = sqlx::query(
            "SELECT id, name, created_at, plan FROM sweeps LEFT JOIN studies ON sweep_id = id WHERE id = $1",
        )
        .bind(id)
        .fetch_optional(&self.readers)
        .await?;
        let Some(batch) = batch else {
            return Ok(None);
        };
        let rows = sqlx::query(
            "SELECT job_id, overrides, status, status_reason, outcome, CASE WHEN $1 THEN summary END AS summary \
             FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_id = $2 ORDER BY position",
        )
        .bind(detail >= BatchDetail::Summaries)
        .bind(id)
        .fetch_all(&self.readers)
        .await?;
        let mut counts = no_jobs();
        let mut jobs = Vec::with_capacity(rows.len());
        for row in rows {
            let job = batch_job(&self.local, &row)?;
            *counts.entry(job.status.as_str().to_owned()).or_default() += 1;
            jobs.push(job);
        }
        Ok(Some(StoredBatch {
            overview: batch_overview(&batch, counts)?,
            plan: batch.optional_text("plan")?,
            jobs,
        }))
    }

    pub(in crate::store) async fn batches(
        &self,
        filter: BatchFilter,
    ) -> Result<Vec<BatchOverview>, StoreError> {
        let rows = sqlx::query(
            "SELECT id, name, created_at FROM sweeps WHERE id < $1 \
             AND (NOT $2 OR id IN (SELECT sweep_id FROM studies)) ORDER BY id DESC LIMIT $3",
        )
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
             WHERE id = $1 AND (NOT $2 OR plan IS NOT NULL))",
        )
        .bind(id)
        .bind(with_plan)
        .fetch_one(&self.readers);
        Ok(found.await?)
    }

    pub(in crate::store) async fn cancel_batch(&self, id: Uuid) -> Result<(), StoreError> {
        let (mut transaction, now) = self.begin().await?;
        let mut effects = Vec::new();
        for job in locked_jobs(&mut transaction, id).await? {
            effects.push((job, cancel(&mut transaction, job, now).await?));
        }
        transaction.commit().await?;
        for (job, effect) in effects {
            self.local.cancelled(job, effect);
        }
        Ok(())
    }

    pub(in crate::store) async fn delete_batch(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let mut transaction = begin(&self.pool, None).await?;
        let jobs = locked_jobs(&mut transaction, id).await?;
        let active: i64 = sqlx::query_scalar(
            "SELECT count(*) FROM jobs WHERE id = ANY($1) AND finished_at IS NULL",
        )
        .bind(&jobs)
        .fetch_one(&mut *transaction)
        .await?;
        if active > 0 {
            return Ok(Deleted::Active);
        }
        sqlx::query("DELETE FROM jobs WHERE id = ANY($1)")
            .bind(&jobs)
            .execute(&mut *transaction)
            .await?;
        let deleted = sqlx::query("DELETE FROM sweeps WHERE id = $1")
            .bind(id)
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        for job in jobs {
            self.local.remove_files(job).await;
            self.local.changed(job);
        }
        Ok(match deleted.rows_affected() {
            0 => Deleted::Missing,
            _ => Deleted::Done,
        })
    }

    async fn batch_counts(&self, id: Uuid) -> Result<BTreeMap<String, u64>, StoreError> {
        let rows: Vec<(String, i64)> = sqlx::query_as(
            "SELECT status, count(*) FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_id = $1 GROUP BY status",
        )
        .bind(id)
        .fetch_all(&self.readers)
        .await?;
        let mut counts = no_jobs();
        let count = |(status, count): (String, i64)| (status, count.try_into().unwrap_or_default());
        counts.extend(rows.into_iter().map(count));
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
        "INSERT INTO sweeps (id, name, created_at, request_key, body_sha256) VALUES ($1, $2, $3, $4, $5) \
         ON CONFLICT (request_key) DO NOTHING",
    )
    .bind(id)
    .bind(&batch.name)
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

/// Queues the jobs of a batch.
async fn insert_jobs(
    connection: &mut PgConnection,
    (id, batch): (Uuid, &NewBatch),
    now: Now,
) -> Result<(), StoreError> {
    let (mut jobs, mut overrides) = (Vec::new(), Vec::new());
    for (job, changes) in &batch.jobs {
        let new = NewRow::of(job, new_id(now.system_ms), now)?;
        insert(connection, job, &new, now).await?;
        jobs.push(new.id);
        overrides.push(serde_json::to_string(changes)?);
    }
    sqlx::query(
        "INSERT INTO sweep_jobs (sweep_id, position, job_id, overrides) SELECT $1, n - 1, job, overrides \
         FROM unnest($2::uuid[], $3::text[]) WITH ORDINALITY AS new (job, overrides, n)",
    )
    .bind(id)
    .bind(jobs)
    .bind(overrides)
    .execute(connection)
    .await?;
    Ok(())
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

/// Locks the jobs of a batch, in the order of their ids.
async fn locked_jobs(connection: &mut PgConnection, id: Uuid) -> Result<Vec<Uuid>, StoreError> {
    let jobs = sqlx::query_scalar(
        "SELECT id FROM jobs WHERE id IN (SELECT job_id FROM sweep_jobs WHERE sweep_id = $1) ORDER BY id FOR UPDATE",
    )
    .bind(id);
    Ok(jobs.fetch_all(connection).await?)
}
