//! Batches: jobs that were queued together. An evaluation plan is a row of the table `studies`.

use std::collections::BTreeMap;

use sqlx::{Sqlite, SqliteExecutor, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::clock::Now;
use crate::store::batch_rows::{batch_job, batch_overview, no_jobs};
use crate::store::batches::{BatchDetail, BatchFilter, BatchOverview, NewBatch, StoredBatch};
use crate::store::rows::StoredRow;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::job_rows::{cancel, insert};
use crate::store::sqlite::queries::BEGIN;
use crate::store::{Deleted, RequestKey, StoreError, Submitted};

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
        detail: BatchDetail,
    ) -> Result<Option<StoredBatch>, StoreError> {
        let batch = sqlx::query(
            "SELECT id, name, created_at, plan FROM sweeps LEFT JOIN studies ON sweep_id = id WHERE id = ?",
        )
        .bind(id.to_string())
        .fetch_optional(&self.readers)
        .await?;
        let Some(batch) = batch else {
            return Ok(None);
        };
        let rows = sqlx::query(
            "SELECT job_id, overrides, status, status_reason, outcome, CASE WHEN ? THEN summary END AS summary \
             FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_id = ? ORDER BY position",
        )
        .bind(detail >= BatchDetail::Summaries)
        .bind(id.to_string())
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
        // Ids are hexadecimal text, all of which sorts before `g`.
        let before = filter.before.map_or("g".to_owned(), |id| id.to_string());
        let rows = sqlx::query(
            "SELECT id, name, created_at FROM sweeps \
             WHERE id < ? AND (NOT ? OR id IN (SELECT sweep_id FROM studies)) ORDER BY id DESC LIMIT ?",
        )
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
             WHERE id = ? AND (NOT ? OR plan IS NOT NULL))",
        )
        .bind(id.to_string())
        .bind(with_plan)
        .fetch_one(&self.readers);
        Ok(found.await?)
    }

    pub(in crate::store) async fn cancel_batch(&self, id: Uuid) -> Result<(), StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            let (jobs, now) = (jobs_of(&mut transaction, id).await?, self.local.clock.now());
            let mut effects = Vec::with_capacity(jobs.len());
            for job in jobs {
                effects.push((job, cancel(&mut transaction, job, now).await?));
            }
            transaction.commit().await?;
            Ok(effects)
        };
        for (job, effect) in self.local.disk.with_reserve(write).await? {
            self.local.cancelled(job, effect);
        }
        Ok(())
    }

    pub(in crate::store) async fn delete_batch(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let active: i64 = sqlx::query_scalar(
            "SELECT count(*) FROM sweep_jobs JOIN jobs ON jobs.id = job_id \
             WHERE sweep_id = ? AND finished_at IS NULL",
        )
        .bind(id.to_string())
        .fetch_one(&mut *transaction)
        .await?;
        if active > 0 {
            return Ok(Deleted::Active);
        }
        let jobs = jobs_of(&mut transaction, id).await?;
        sqlx::query(
            "DELETE FROM jobs WHERE id IN (SELECT job_id FROM sweep_jobs WHERE sweep_id = ?)",
        )
        .bind(id.to_string())
        .execute(&mut *transaction)
        .await?;
        let deleted = sqlx::query("DELETE FROM sweeps WHERE id = ?")
            .bind(id.to_string())
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
        let rows: Vec<(String, u64)> = sqlx::query_as(
            "SELECT status, count(*) FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_id = ? GROUP BY status",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let mut counts = no_jobs();
        counts.extend(rows);
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
        "INSERT INTO sweeps (id, name, created_at, request_key, body_sha256) VALUES (?, ?, ?, ?, ?)",
    )
    .bind(id.to_string())
    .bind(&batch.name)
    .bind(now.system_ms)
    .bind(key.map(|key| &key.key))
    .bind(key.map(|key| key.meaning_sha256.as_slice()))
    .execute(&mut **transaction)
    .await?;
    for (position, (job, overrides)) in (0_i64..).zip(&batch.jobs) {
        let job = insert(transaction, job, now).await?;
        sqlx::query(
            "INSERT INTO sweep_jobs (sweep_id, position, job_id, overrides) VALUES (?, ?, ?, ?)",
        )
        .bind(id.to_string())
        .bind(position)
        .bind(job.to_string())
        .bind(serde_json::to_string(overrides)?)
        .execute(&mut **transaction)
        .await?;
    }
    if let Some(plan) = &batch.plan {
        sqlx::query("INSERT INTO studies (sweep_id, plan) VALUES (?, ?)")
            .bind(id.to_string())
            .bind(plan)
            .execute(&mut **transaction)
            .await?;
    }
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

async fn jobs_of(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
) -> Result<Vec<Uuid>, StoreError> {
    let jobs: Vec<Hyphenated> =
        sqlx::query_scalar("SELECT job_id FROM sweep_jobs WHERE sweep_id = ?")
            .bind(id.to_string())
            .fetch_all(&mut **transaction)
            .await?;
    Ok(jobs.into_iter().map(Uuid::from).collect())
}
