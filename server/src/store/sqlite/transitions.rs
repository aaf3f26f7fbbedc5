//! Transitions to an end, or back into the queue.

use api::job::Status;
use sqlx::SqliteConnection;

use crate::clock::Now;
use crate::store::candidates::left_until;
use crate::store::ending::EndingJob;
use crate::store::sqlite::queries::insert_event;
use crate::store::{End, StoreError};

/// Ends a job or returns it to the queue; `None` if the transition is not allowed.
pub(super) async fn end_job(
    connection: &mut SqliteConnection,
    job: &EndingJob,
    end: &End,
    now: Now,
) -> Result<Option<Status>, StoreError> {
    end_job_at(connection, job, end, None, now).await
}

/// Ends a job at its last progress.
pub(super) async fn end_job_at(
    connection: &mut SqliteConnection,
    job: &EndingJob,
    end: &End,
    progress: Option<&str>,
    now: Now,
) -> Result<Option<Status>, StoreError> {
    let Some(ending) = job.ending(end)? else {
        return Ok(None);
    };
    let status = ending.status;
    // The times of an ended job are stored by the system's clock, no longer by the monotonic one.
    let step_ms = if status.is_terminal() {
        Now::read().stepped_ms()
    } else {
        0
    };
    let seq: i64 = sqlx::query_scalar(
        "UPDATE jobs SET status = ?, status_reason = ?, outcome = ?, summary = ?, cancel_requested = ?, \
         lease_expires_at = NULL, finished_at = ?, ended_ms = (SELECT passed_ms FROM service_time), progress = COALESCE(?, progress), attempts = attempts - ?, \
         fruitless = max(fruitless - ?, 0), last_event = last_event + ?, version = version + 1, \
         queued_at = queued_at + ?, deadline_at = deadline_at + ?, avoided_worker = iif(?, worker, NULL), avoided_until = ? \
         WHERE id = ? AND status = ? RETURNING last_event",
    )
    .bind(status.as_str())
    .bind(&ending.status_reason)
    .bind(ending.outcome)
    .bind(&ending.summary)
    .bind(job.cancel_requested)
    .bind(status.is_terminal().then_some(now.system_ms))
    .bind(progress)
    .bind(ending.is_released)
    .bind(ending.is_released)
    .bind(status.is_terminal())
    .bind(step_ms)
    .bind(step_ms)
    .bind(ending.is_left)
    .bind(ending.is_left.then(|| left_until(now)))
    .bind(job.id.to_string())
    .bind(job.status.as_str())
    .fetch_one(&mut *connection)
    .await?;
    if let Some(done) = &ending.done {
        insert_event(connection, job.id, seq, "done", done).await?;
    }
    if status == Status::Succeeded {
        // Other ends may be followed by another try.
        sqlx::query("DELETE FROM checkpoints WHERE job_id = ?")
            .bind(job.id.to_string())
            .execute(connection)
            .await?;
    }
    Ok(Some(status))
}
