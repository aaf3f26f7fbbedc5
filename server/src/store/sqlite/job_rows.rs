//! Statements about one job within a transaction.

use api::job::Status;
use sqlx::{Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::clock::Now;
use crate::queue;
use crate::queue::Transition;
use crate::store::ending::{EndingJob, retried};
use crate::store::new_row::NewRow;
use crate::store::rows::status;
use crate::store::sqlite::queries::insert_event;
use crate::store::sqlite::transitions::end_job;
use crate::store::{Cancelled, End, NewJob, Retried, StoreError};

/// Returns the status of a job; `None` if there is no such job.
pub(super) async fn status_of(
    connection: &mut SqliteConnection,
    id: Uuid,
) -> Result<Option<Status>, StoreError> {
    let row = sqlx::query("SELECT status FROM jobs WHERE id = ?")
        .bind(id.to_string())
        .fetch_optional(connection)
        .await?;
    row.map(|row| status(id, &row)).transpose()
}

/// Requests the end of a job, within a transaction.
pub(super) async fn cancel(
    connection: &mut SqliteConnection,
    id: Uuid,
    now: Now,
) -> Result<Option<Cancelled>, StoreError> {
    Ok(match status_of(connection, id).await? {
        Some(Status::Queued) => {
            let end = End::without_result(Transition::Cancel, "cancelled while waiting");
            let job = EndingJob::queued(id, true);
            end_job(connection, &job, &end, None, now).await?;
            Some(Cancelled::AtOnce)
        }
        Some(Status::Running) => {
            sqlx::query(
                "UPDATE jobs SET cancel_requested = 1, status_reason = 'cancel requested', version = version + 1 WHERE id = ?",
            )
            .bind(id.to_string())
            .execute(connection)
            .await?;
            Some(Cancelled::Requested)
        }
        Some(_) => Some(Cancelled::Already),
        None => None,
    })
}

/// Queues a failed or cancelled job again, within a transaction.
pub(super) async fn retry(
    connection: &mut SqliteConnection,
    id: Uuid,
    now: Now,
) -> Result<Option<Retried>, StoreError> {
    let Some(status) = status_of(connection, id).await? else {
        return Ok(None);
    };
    let queued = match retried(status) {
        Ok(queued) => queued,
        Err(effect) => return Ok(Some(effect)),
    };
    let (seq, progress): (i64, String) = sqlx::query_as(
        "UPDATE jobs SET status = ?1, status_reason = ?2, outcome = NULL, summary = NULL, finished_at = NULL, \
         cancel_requested = 0, fruitless = 0, deadline_at = deadline_at - queued_at + ?3, queued_at = ?3, \
         last_event = last_event + 1, version = version + 1 WHERE id = ?4 RETURNING last_event, progress",
    )
    .bind(queued.as_str())
    .bind(queue::WAITING_FOR_WORKER)
    .bind(now.monotonic_ms)
    .bind(id.to_string())
    .fetch_one(&mut *connection)
    .await?;
    insert_event(connection, id, seq, "progress", &progress).await?;
    Ok(Some(Retried::Queued))
}

/// Adds a job to the queue, with its first event; `batch` is the one that it belongs to.
pub(super) async fn insert(
    transaction: &mut Transaction<'_, Sqlite>,
    job: &NewJob,
    batch: Option<Uuid>,
    now: Now,
) -> Result<Uuid, StoreError> {
    let new = NewRow::of(job, Uuid::now_v7(), now)?;
    let id = new.id.to_string();
    sqlx::query(
        "INSERT INTO jobs (id, system, spec, plan, status, status_reason, created_at, progress, last_event, priority, \
         place, deadline_at, memory_mb, cpu_ms, queued_at, sweep_id) \
         VALUES (?, ?, ?, ?, 'queued', ?, ?, ?, 1, ?, ?, ?, ?, ?, ?, ?)",
    )
    .bind(&id)
    .bind(new.system)
    .bind(&new.spec)
    .bind(&new.plan)
    .bind(queue::WAITING_FOR_WORKER)
    .bind(now.system_ms)
    .bind(&new.progress)
    .bind(job.options.priority)
    .bind(new.place)
    .bind(new.deadline_at)
    .bind(new.memory_mb)
    .bind(new.cpu_ms)
    .bind(now.monotonic_ms)
    .bind(batch.map(|batch| batch.to_string()))
    .execute(&mut **transaction)
    .await?;
    sqlx::query("INSERT INTO sent_specifications (job_id, spec) VALUES (?, ?)")
        .bind(&id)
        .bind(&job.sent)
        .execute(&mut **transaction)
        .await?;
    for (key, value) in &job.spec.labels {
        sqlx::query("INSERT INTO labels (job_id, key, value) VALUES (?, ?, ?)")
            .bind(&id)
            .bind(key)
            .bind(value)
            .execute(&mut **transaction)
            .await?;
    }
    insert_event(transaction, new.id, 1, "progress", &new.progress).await?;
    Ok(new.id)
}
