//! Sweeps: jobs that were submitted together.

use std::collections::BTreeMap;

use api::job::{Outcome, Status};
use api::results::Summary;
use api::sweep::{Changes, Sweep, SweepJob, SweepOverview};
use sqlx::SqliteExecutor;
use uuid::Uuid;

use crate::store::sqlite::document::timestamp;
use crate::store::sqlite::jobs::insert;
use crate::store::sqlite::queries::{BEGIN, job_id};
use crate::store::sqlite::studies::{StudyPlan, insert_study};
use crate::store::{NewJob, RequestKey, Store, StoreError, Submitted};

/// A sweep to be queued.
#[derive(Debug, Clone, PartialEq)]
pub struct NewSweep {
    /// Its name for people.
    pub name: Option<String>,
    /// Its jobs, with what sets each apart.
    pub jobs: Vec<(NewJob, Changes)>,
    /// What its results are compared by, if it is a study of accuracy.
    pub study: Option<StudyPlan>,
}

/// A job of a sweep with its result.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepOutcome {
    /// The job.
    pub job: SweepJob,
    /// Why it stands there.
    pub status_reason: Option<String>,
    /// The result in short, if there is one.
    pub summary: Option<Summary>,
}

#[derive(sqlx::FromRow)]
struct JobRow {
    job_id: String,
    overrides: String,
    status: String,
    status_reason: Option<String>,
    outcome: Option<String>,
    summary: Option<String>,
}

impl JobRow {
    fn outcome(self) -> Result<SweepOutcome, StoreError> {
        let id = job_id(&self.job_id)?;
        let corrupt = |what, cause: String| StoreError::Corrupt { id, what, cause };
        let overrides = serde_json::from_str(&self.overrides)
            .map_err(|cause| corrupt("overrides", cause.to_string()))?;
        let summary = self
            .summary
            .as_deref()
            .map(serde_json::from_str)
            .transpose()
            .map_err(|cause| corrupt("summary", cause.to_string()))?;
        let status =
            Status::from_name(&self.status).ok_or_else(|| corrupt("status", self.status))?;
        Ok(SweepOutcome {
            job: SweepJob {
                id,
                overrides,
                status,
                outcome: self.outcome.as_deref().and_then(Outcome::from_name),
            },
            status_reason: self.status_reason,
            summary,
        })
    }
}

impl Store {
    /// Queues all jobs of a sweep or none; or finds the sweep that a request with the same key made. `now` in
    /// milliseconds since 1970.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn submit_sweep(
        &self,
        sweep: &NewSweep,
        key: Option<&RequestKey>,
        now: i64,
    ) -> Result<Submitted, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        if let Some(key) = key
            && let Some(known) = known(&mut *transaction, key).await?
        {
            return Ok(known);
        }
        let id = Uuid::now_v7();
        sqlx::query(
            "INSERT INTO sweeps (id, name, created_at, request_key, body_sha256) VALUES (?, ?, ?, ?, ?)",
        )
        .bind(id.to_string())
        .bind(&sweep.name)
        .bind(now)
        .bind(key.map(|key| &key.key))
        .bind(key.map(|key| key.body_sha256.as_slice()))
        .execute(&mut *transaction)
        .await?;
        for (position, (job, overrides)) in (0_i64..).zip(&sweep.jobs) {
            let job = insert(&mut transaction, job, now).await?;
            sqlx::query(
                "INSERT INTO sweep_jobs (sweep_id, position, job_id, overrides) VALUES (?, ?, ?, ?)",
            )
            .bind(id.to_string())
            .bind(position)
            .bind(job.to_string())
            .bind(serde_json::to_string(overrides)?)
            .execute(&mut *transaction)
            .await?;
        }
        if let Some(study) = &sweep.study {
            insert_study(&mut transaction, id, study).await?;
        }
        transaction.commit().await?;
        // Every idle worker finds work now; one that misses the call looks for itself within a second.
        self.waiting.notify_waiters();
        self.waiting.notify_one();
        Ok(Submitted::Job(id))
    }

    /// The sweep that an earlier request with the same key made, if there was one.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn sweep_of(&self, key: &RequestKey) -> Result<Option<Submitted>, StoreError> {
        known(&self.readers, key).await
    }

    /// A sweep as it stands.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn sweep(&self, id: Uuid) -> Result<Option<Sweep>, StoreError> {
        let Some((name, created_at)) = self.sweep_head(id).await? else {
            return Ok(None);
        };
        let mut counts = no_jobs();
        let rows: Vec<JobRow> = sqlx::query_as(
            "SELECT job_id, overrides, status, NULL AS status_reason, outcome, NULL AS summary \
             FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_id = ? ORDER BY position",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let mut jobs = Vec::with_capacity(rows.len());
        for row in rows {
            let job = row.outcome()?.job;
            *counts.entry(job.status.as_str().to_owned()).or_default() += 1;
            jobs.push(job);
        }
        Ok(Some(Sweep {
            id,
            name,
            created_at: timestamp(created_at),
            counts,
            jobs,
            links: links(id),
        }))
    }

    /// The jobs of a sweep in order, with their results; nothing if there is no such sweep.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn sweep_outcomes(&self, id: Uuid) -> Result<Option<Vec<SweepOutcome>>, StoreError> {
        if self.sweep_head(id).await?.is_none() {
            return Ok(None);
        }
        let rows: Vec<JobRow> = sqlx::query_as(
            "SELECT job_id, overrides, status, status_reason, outcome, summary \
             FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_id = ? ORDER BY position",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let outcomes: Result<_, _> = rows.into_iter().map(JobRow::outcome).collect();
        Ok(Some(outcomes?))
    }

    /// Sweeps, newest first: at most so many, older than one of them if it is named.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn sweeps(
        &self,
        before: Option<Uuid>,
        limit: u32,
    ) -> Result<Vec<SweepOverview>, StoreError> {
        // Ids are made of times and digits, which `g` follows.
        let before = before.map_or("g".to_owned(), |id| id.to_string());
        let rows: Vec<(String, Option<String>, i64)> = sqlx::query_as(
            "SELECT id, name, created_at FROM sweeps WHERE id < ? ORDER BY id DESC LIMIT ?",
        )
        .bind(before)
        .bind(limit)
        .fetch_all(&self.readers)
        .await?;
        let mut sweeps = Vec::with_capacity(rows.len());
        for (id, name, created_at) in rows {
            let id = job_id(&id)?;
            sweeps.push(SweepOverview {
                id,
                name,
                created_at: timestamp(created_at),
                counts: self.sweep_counts(id).await?,
                links: links(id),
            });
        }
        Ok(sweeps)
    }

    async fn sweep_counts(&self, id: Uuid) -> Result<BTreeMap<String, u64>, StoreError> {
        let rows: Vec<(String, i64)> = sqlx::query_as(
            "SELECT status, count(*) FROM sweep_jobs JOIN jobs ON jobs.id = job_id WHERE sweep_id = ? GROUP BY status",
        )
        .bind(id.to_string())
        .fetch_all(&self.readers)
        .await?;
        let mut counts = no_jobs();
        for (status, count) in rows {
            counts.insert(status, u64::try_from(count).unwrap_or_default());
        }
        Ok(counts)
    }

    pub(in crate::store) async fn sweep_head(
        &self,
        id: Uuid,
    ) -> Result<Option<(Option<String>, i64)>, StoreError> {
        Ok(
            sqlx::query_as("SELECT name, created_at FROM sweeps WHERE id = ?")
                .bind(id.to_string())
                .fetch_optional(&self.readers)
                .await?,
        )
    }
}

/// What an earlier request with the same key made.
async fn known(
    database: impl SqliteExecutor<'_>,
    key: &RequestKey,
) -> Result<Option<Submitted>, StoreError> {
    let known: Option<(Vec<u8>, String)> =
        sqlx::query_as("SELECT body_sha256, id FROM sweeps WHERE request_key = ?")
            .bind(&key.key)
            .fetch_optional(database)
            .await?;
    let Some((body, id)) = known else {
        return Ok(None);
    };
    Ok(Some(if body == key.body_sha256 {
        Submitted::Job(job_id(&id)?)
    } else {
        Submitted::KeyTaken
    }))
}

/// Counts by status, of none.
fn no_jobs() -> BTreeMap<String, u64> {
    let all = Status::ALL.iter();
    all.map(|status| (status.as_str().to_owned(), 0)).collect()
}

fn links(id: Uuid) -> BTreeMap<String, String> {
    let own = format!("/v1/sweeps/{id}");
    BTreeMap::from([
        ("cancel".to_owned(), format!("{own}/cancel")),
        ("jobs".to_owned(), format!("/v1/jobs?sweep={id}")),
        ("outcomes".to_owned(), format!("{own}/outcomes")),
        ("self".to_owned(), own),
    ])
}
