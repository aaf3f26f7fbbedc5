//! Batches: jobs that were queued together. An evaluation plan is a row of the table `studies`.

use std::collections::BTreeMap;

use api::job::Status;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, Sqlite, SqliteExecutor, Transaction};
use uuid::Uuid;
use uuid::fmt::Hyphenated;

use crate::clock::Now;
use crate::store::batches::{
    BatchDetail, BatchFilter, BatchJob, BatchOverview, NewBatch, StoredBatch,
};
use crate::store::sqlite::document::status_and_reason;
use crate::store::sqlite::document::timestamp;
use crate::store::sqlite::job_rows::{cancel, insert};
use crate::store::sqlite::queries::{BEGIN, id, outcome, parsed, summary};
use crate::store::{DataDisk, Deleted, RequestKey, SnapshotPart, Store, StoreError, Submitted};

impl Store {
    /// Queues all jobs of a batch or none; returns the earlier batch if a request with the same key and body has queued
    /// one. `now` is the time of their submission.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submit_batch(
        &self,
        batch: &NewBatch,
        key: Option<&RequestKey>,
        now: impl Into<Now>,
    ) -> Result<Submitted, StoreError> {
        self.disk.check()?;
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        if let Some(key) = key
            && let Some(earlier) = submitted(&mut *transaction, key).await?
        {
            return Ok(earlier);
        }
        let id = insert_batch(&mut transaction, batch, key, now.into()).await?;
        transaction.commit().await?;
        // Wakes every idle worker; one that misses the notification polls within a second.
        self.waiting.notify_waiters();
        self.waiting.notify_one();
        Ok(Submitted::Job(id))
    }

    /// Returns the batch that an earlier request with the same key queued, if there was one.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submitted_batch(&self, key: &RequestKey) -> Result<Option<Submitted>, StoreError> {
        submitted(&self.readers, key).await
    }

    /// Returns a batch with its jobs and so much of their results; `None` if there is no batch of that id.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or a document in it cannot be read.
    pub async fn batch(
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
            let mut job = job(&self.disk, &row)?;
            *counts.entry(job.status.as_str().to_owned()).or_default() += 1;
            if detail >= BatchDetail::Profiles && job.summary.is_some() {
                job.profile = self.last_profile(job.id).await?;
            }
            jobs.push(job);
        }
        Ok(Some(StoredBatch {
            overview: overview(&batch, counts)?,
            plan: batch.try_get("plan")?,
            jobs,
        }))
    }

    /// Returns the last profile of a job; `None` if it has none, or if its results are damaged, so that the other jobs can be
    /// compared.
    async fn last_profile(&self, id: Uuid) -> Result<Option<String>, StoreError> {
        match self.snapshot(id, SnapshotPart::Profile, None).await {
            Err(error @ StoreError::DamagedResults { .. }) => {
                tracing::error!(%error, "a job is left out of a comparison");
                Ok(None)
            }
            found => found,
        }
    }

    /// Returns batches, newest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn batches(&self, filter: BatchFilter) -> Result<Vec<BatchOverview>, StoreError> {
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
            let counts = self.batch_counts(id(&row, "id")?).await?;
            batches.push(overview(&row, counts)?);
        }
        Ok(batches)
    }

    /// Checks whether a batch exists; with `with_plan`, whether it has an evaluation plan too.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn has_batch(&self, id: Uuid, with_plan: bool) -> Result<bool, StoreError> {
        let found = sqlx::query_scalar(
            "SELECT EXISTS (SELECT 1 FROM sweeps LEFT JOIN studies ON sweep_id = id \
             WHERE id = ? AND (NOT ? OR plan IS NOT NULL))",
        )
        .bind(id.to_string())
        .bind(with_plan)
        .fetch_one(&self.readers);
        Ok(found.await?)
    }

    /// Cancels all jobs of a batch: waiting ones end at once, running ones are ended by their workers.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn cancel_batch(&self, id: Uuid, now: i64) -> Result<(), StoreError> {
        let write = async || {
            let mut transaction = self.writer.begin_with(BEGIN).await?;
            let jobs = jobs_of(&mut transaction, id).await?;
            let mut effects = Vec::with_capacity(jobs.len());
            for job in jobs {
                effects.push((job, cancel(&mut transaction, job, now).await?));
            }
            transaction.commit().await?;
            Ok(effects)
        };
        for (job, effect) in self.disk.with_reserve(write).await? {
            self.cancelled(job, effect);
        }
        Ok(())
    }

    /// Deletes a batch whose jobs have all ended, with the jobs, their events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete_batch(&self, id: Uuid) -> Result<Deleted, StoreError> {
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
            self.remove_files(job).await;
            self.changed(job);
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

/// Returns a batch without its jobs.
fn overview(row: &SqliteRow, counts: BTreeMap<String, u64>) -> Result<BatchOverview, StoreError> {
    Ok(BatchOverview {
        id: id(row, "id")?,
        name: row.try_get("name")?,
        created_at: timestamp(row.try_get("created_at")?),
        counts,
    })
}

/// Returns a job of a batch, without its profile.
fn job(disk: &DataDisk, row: &SqliteRow) -> Result<BatchJob, StoreError> {
    let id = id(row, "job_id")?;
    let (status, status_reason) = status_and_reason(disk, id, row)?;
    Ok(BatchJob {
        id,
        overrides: parsed(id, "overrides", row.try_get("overrides")?)?,
        status,
        status_reason,
        outcome: outcome(row)?,
        summary: summary(id, row)?,
        profile: None,
    })
}

/// Zero for every status.
fn no_jobs() -> BTreeMap<String, u64> {
    let all = Status::ALL.iter();
    all.map(|status| (status.as_str().to_owned(), 0)).collect()
}
