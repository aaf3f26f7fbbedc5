//! Insertion of jobs into the queue.

use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::queue;
use crate::store::new_row::NewRow;
use crate::store::sqlite::queries::insert_event;
use crate::store::{NewJob, StoreError};

/// Adds a job to the queue, with its first event; `batch` is the one that it belongs to.
pub(super) async fn insert(
    connection: &mut SqliteConnection,
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
    .execute(&mut *connection)
    .await?;
    sqlx::query("INSERT INTO sent_specifications (job_id, spec) VALUES (?, ?)")
        .bind(&id)
        .bind(&job.sent)
        .execute(&mut *connection)
        .await?;
    for (key, value) in &job.spec.labels {
        sqlx::query("INSERT INTO labels (job_id, key, value) VALUES (?, ?, ?)")
            .bind(&id)
            .bind(key)
            .bind(value)
            .execute(&mut *connection)
            .await?;
    }
    insert_event(connection, new.id, 1, "progress", &new.progress).await?;
    Ok(new.id)
}
