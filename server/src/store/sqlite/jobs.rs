//! Submitting, reading, listing, cancelling and deleting jobs.

use api::job::{Job, Progress, Status};
use api::plan::Plan;
use api::spec::Spec;
use sqlx::{QueryBuilder, Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::queue;
use crate::queue::Transition;
use crate::store::sqlite::conclusion::{End, end_waiting};
use crate::store::sqlite::document::{JobRow, timestamp};
use crate::store::sqlite::queries::{BEGIN, insert_event};
use crate::store::{Store, StoreError};

const COLUMNS: &str = "SELECT id, spec, plan, status, status_reason, outcome, created_at, started_at, finished_at, \
                       priority, deadline_at, progress, summary, attempts, last_event, version FROM jobs";

/// A job to be queued.
#[derive(Debug, Clone, PartialEq)]
pub struct NewJob {
    /// The resolved specification.
    pub spec: Spec,
    /// Its plan.
    pub plan: Plan,
    /// What else its user asked for.
    pub wishes: SubmitOptions,
}

/// What a user may ask for besides the study itself.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SubmitOptions {
    /// How many minutes older it counts in the queue than it is.
    pub priority: i32,
    /// How long after its submission it fails unless it has ended, s.
    pub deadline_s: Option<u32>,
}

/// A job as it is stored.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredJob {
    /// The document.
    pub document: Job,
    /// Raised by every change.
    pub version: i64,
    /// Number of its newest event.
    pub last_event: i64,
}

/// Which jobs a list holds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Filter {
    /// Any of these; all if empty.
    pub statuses: Vec<Status>,
    /// This kind of system.
    pub system: Option<String>,
    /// All of these labels.
    pub labels: Vec<(String, String)>,
    /// Accepted at this time or later, ms since 1970.
    pub created_from: Option<i64>,
    /// Accepted before this time, ms since 1970.
    pub created_before: Option<i64>,
    /// Of this sweep.
    pub sweep: Option<Uuid>,
    /// Older than this job.
    pub before: Option<Uuid>,
    /// At most so many.
    pub limit: u32,
}

/// What a cancel request did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cancelled {
    /// The job was waiting and is cancelled.
    AtOnce,
    /// The job runs; its worker ends it.
    Requested,
    /// The job had ended already.
    Already,
}

/// What a delete request did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deleted {
    /// The job and its results are gone.
    Done,
    /// The job has not ended.
    Active,
    /// There is no such job.
    Missing,
}

/// The key that a client gave to a submission, and the digest of what it submitted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RequestKey {
    /// The key.
    pub key: String,
    /// SHA-256 of the body.
    pub body_sha256: [u8; 32],
}

/// What became of a submission.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Submitted {
    /// A job, queued now or by an earlier request with the same key and body.
    Job(Uuid),
    /// The key was used with another body.
    KeyTaken,
}

impl Store {
    /// A job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn job(&self, id: Uuid) -> Result<Option<StoredJob>, StoreError> {
        let mut query = QueryBuilder::<Sqlite>::new(COLUMNS);
        query.push(" WHERE id = ").push_bind(id.to_string());
        let row: Option<JobRow> = query.build_query_as().fetch_optional(&self.readers).await?;
        row.map(|row| stored(&row)).transpose()
    }

    /// Jobs, newest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn list(&self, filter: &Filter) -> Result<Vec<Job>, StoreError> {
        let mut query = QueryBuilder::<Sqlite>::new(COLUMNS);
        query.push(" WHERE 1");
        if !filter.statuses.is_empty() {
            query.push(" AND status IN (");
            let mut list = query.separated(", ");
            for status in &filter.statuses {
                list.push_bind(status.as_str());
            }
            query.push(")");
        }
        if let Some(system) = &filter.system {
            query.push(" AND system = ").push_bind(system.clone());
        }
        for (key, value) in &filter.labels {
            query
                .push(" AND id IN (SELECT job_id FROM labels WHERE key = ")
                .push_bind(key.clone());
            query
                .push(" AND value = ")
                .push_bind(value.clone())
                .push(")");
        }
        if let Some(from) = filter.created_from {
            query.push(" AND created_at >= ").push_bind(from);
        }
        if let Some(before) = filter.created_before {
            query.push(" AND created_at < ").push_bind(before);
        }
        if let Some(sweep) = filter.sweep {
            query
                .push(" AND id IN (SELECT job_id FROM sweep_jobs WHERE sweep_id = ")
                .push_bind(sweep.to_string())
                .push(")");
        }
        if let Some(before) = filter.before {
            query.push(" AND id < ").push_bind(before.to_string());
        }
        query
            .push(" ORDER BY id DESC LIMIT ")
            .push_bind(filter.limit);
        let rows: Vec<JobRow> = query.build_query_as().fetch_all(&self.readers).await?;
        rows.iter().map(JobRow::document).collect()
    }

    /// Asks for the end of a job: a waiting one ends at once, a running one is ended by its worker. Nothing if there is
    /// no such job.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn cancel(&self, id: Uuid, now: i64) -> Result<Option<Cancelled>, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let did = cancel(&mut transaction, id, now).await?;
        transaction.commit().await?;
        let ended = (did == Some(Cancelled::AtOnce)).then_some(Status::Cancelled);
        self.concluded(id, ended);
        Ok(did)
    }

    /// Deletes a job that has ended, with its events, results and files.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn delete(&self, id: Uuid) -> Result<Deleted, StoreError> {
        let mut transaction = self.writer.begin_with(BEGIN).await?;
        let did = match status(&mut transaction, id).await? {
            None => Deleted::Missing,
            Some(status) if !status.is_terminal() => Deleted::Active,
            Some(_) => {
                sqlx::query("DELETE FROM jobs WHERE id = ?")
                    .bind(id.to_string())
                    .execute(&mut *transaction)
                    .await?;
                Deleted::Done
            }
        };
        transaction.commit().await?;
        if did == Deleted::Done {
            self.remove_files(id).await;
        }
        self.changed(id);
        Ok(did)
    }
}

fn stored(row: &JobRow) -> Result<StoredJob, StoreError> {
    Ok(StoredJob {
        document: row.document()?,
        version: row.version,
        last_event: row.last_event,
    })
}

async fn status(connection: &mut SqliteConnection, id: Uuid) -> Result<Option<Status>, StoreError> {
    let name: Option<String> = sqlx::query_scalar("SELECT status FROM jobs WHERE id = ?")
        .bind(id.to_string())
        .fetch_optional(connection)
        .await?;
    name.map(|name| {
        Status::from_name(&name).ok_or(StoreError::Corrupt {
            id,
            what: "status",
            cause: name,
        })
    })
    .transpose()
}

/// Asks for the end of a job, within a transaction.
pub(in crate::store) async fn cancel(
    connection: &mut SqliteConnection,
    id: Uuid,
    now: i64,
) -> Result<Option<Cancelled>, StoreError> {
    let Some(status) = status(&mut *connection, id).await? else {
        return Ok(None);
    };
    let did = if status == Status::Queued {
        let end = End {
            step: Transition::Cancel,
            reason: Some("cancelled while waiting".to_owned()),
            outcome: None,
            summary: None,
        };
        end_waiting(&mut *connection, id, &end, now).await?;
        Cancelled::AtOnce
    } else if status == Status::Running {
        sqlx::query("UPDATE jobs SET cancel_requested = 1, status_reason = 'cancel requested', version = version + 1 WHERE id = ?")
                .bind(id.to_string())
                .execute(&mut *connection)
                .await?;
        Cancelled::Requested
    } else {
        Cancelled::Already
    };
    Ok(Some(did))
}

/// Adds a job to the queue, with its first event.
pub(in crate::store) async fn insert(
    transaction: &mut Transaction<'_, Sqlite>,
    job: &NewJob,
    now: i64,
) -> Result<Uuid, StoreError> {
    let id = Uuid::now_v7();
    let SubmitOptions {
        priority,
        deadline_s,
    } = job.wishes;
    let system = job
        .spec
        .system
        .kind
        .known()
        .map_or("", api::spec::SystemKind::as_str);
    let progress = Progress {
        cycles: crate::spec::cycles(&job.spec),
        updated_at: Some(timestamp(now)),
        ..Progress::default()
    };
    let progress = serde_json::to_string(&progress)?;
    sqlx::query(
        "INSERT INTO jobs (id, system, spec, plan, status, status_reason, created_at, progress, last_event, priority, \
         place, deadline_at, memory_mb) VALUES (?, ?, ?, ?, 'queued', ?, ?, ?, 1, ?, ?, ?, ?)",
    )
    .bind(id.to_string())
    .bind(system)
    .bind(serde_json::to_string(&job.spec)?)
    .bind(serde_json::to_string(&job.plan)?)
    .bind(queue::WAITING_FOR_WORKER)
    .bind(now)
    .bind(&progress)
    .bind(priority)
    .bind(queue::place(now, priority))
    .bind(deadline_s.map(|s| now.saturating_add(1_000 * i64::from(s))))
    .bind(memory_mb(&job.plan))
    .execute(&mut **transaction)
    .await?;
    for (key, value) in &job.spec.labels {
        sqlx::query("INSERT INTO labels (job_id, key, value) VALUES (?, ?, ?)")
            .bind(id.to_string())
            .bind(key)
            .bind(value)
            .execute(&mut **transaction)
            .await?;
    }
    insert_event(transaction, id, 1, "progress", &progress).await?;
    Ok(id)
}

/// What the plan expects the solve to need, MB.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the value is clamped to a range that fits"
)]
fn memory_mb(plan: &Plan) -> i64 {
    let estimate = plan.estimates.get("memory_mb").copied().unwrap_or_default();
    estimate.ceil().clamp(0.0, 1e9) as i64
}
