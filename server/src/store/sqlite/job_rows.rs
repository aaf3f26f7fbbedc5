//! Statements about one job within a transaction.

use api::job::{Progress, Status};
use api::plan::Plan;
use api::spec::SystemKind;
use sqlx::{Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::clock::Now;
use crate::queue;
use crate::queue::{Attempts, Transition, next_status};
use crate::store::sqlite::document::timestamp;
use crate::store::sqlite::queries::{insert_event, status};
use crate::store::sqlite::transitions::{EndingJob, end_job};
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
    now: i64,
) -> Result<Option<Cancelled>, StoreError> {
    Ok(match status_of(connection, id).await? {
        Some(Status::Queued) => {
            let end = End::without_result(Transition::Cancel, "cancelled while waiting");
            end_job(connection, &EndingJob::queued(id, true), &end, None, now).await?;
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
    let attempts = Attempts {
        fruitless: 0,
        limit: 0,
    };
    let Some(queued) = next_status(status, Transition::Retry, attempts, false) else {
        let is_terminal = status.is_terminal();
        let effect = if is_terminal {
            Retried::Succeeded
        } else {
            Retried::Already
        };
        return Ok(Some(effect));
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

/// Adds a job to the queue, with its first event.
pub(super) async fn insert(
    transaction: &mut Transaction<'_, Sqlite>,
    job: &NewJob,
    now: Now,
) -> Result<Uuid, StoreError> {
    let Now {
        system_ms,
        monotonic_ms,
    } = now;
    let id = Uuid::now_v7();
    let options = job.options;
    let system = job.spec.system.kind.known().map_or("", SystemKind::as_str);
    let progress = Progress {
        cycles: crate::spec::cycles(&job.spec),
        updated_at: Some(timestamp(system_ms)),
        ..Progress::default()
    };
    let progress = serde_json::to_string(&progress)?;
    sqlx::query(
        "INSERT INTO jobs (id, system, spec, plan, status, status_reason, created_at, progress, last_event, priority, \
         place, deadline_at, memory_mb, cpu_ms, queued_at) VALUES (?, ?, ?, ?, 'queued', ?, ?, ?, 1, ?, ?, ?, ?, ?, ?)",
    )
    .bind(id.to_string())
    .bind(system)
    .bind(serde_json::to_string(&job.spec)?)
    .bind(serde_json::to_string(&job.plan)?)
    .bind(queue::WAITING_FOR_WORKER)
    .bind(system_ms)
    .bind(&progress)
    .bind(options.priority)
    .bind(queue::sort_key(monotonic_ms, options.priority))
    .bind(options.deadline_s.map(|s| monotonic_ms.saturating_add(1_000 * i64::from(s))))
    .bind(estimated(&job.plan, "memory_mb", 1.0))
    .bind(estimated(&job.plan, "cpu_s", 1e3))
    .bind(monotonic_ms)
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

/// Returns an estimate of the plan, rounded up; 0 where it is not known.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the value is clamped to a range that fits"
)]
fn estimated(plan: &Plan, name: &str, per_unit: f64) -> i64 {
    let estimate = plan.estimates.get(name).copied().unwrap_or_default();
    (per_unit * estimate).ceil().clamp(0.0, 1e12) as i64
}
