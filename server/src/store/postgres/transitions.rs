//! Transitions to an end, or back into the queue.

use api::job::Status;
use sqlx::postgres::PgConnection;

use crate::store::ending::EndingJob;
use crate::store::postgres::queries::insert_event;
use crate::store::{End, StoreError};

/// Ends a job, whose row the transaction has locked, or returns it to the queue; `None` if the transition is not allowed.
pub(super) async fn end_job(
    connection: &mut PgConnection,
    job: &EndingJob,
    end: &End,
    progress: Option<&str>,
    now: i64,
) -> Result<Option<Status>, StoreError> {
    let Some(ending) = job.ending(end)? else {
        return Ok(None);
    };
    let status = ending.status;
    let seq: i64 = sqlx::query_scalar(
        "UPDATE jobs SET status = $1, status_reason = $2, outcome = $3, summary = $4, cancel_requested = $5, \
         lease_expires_at = NULL, finished_at = $6, progress = COALESCE($7, progress), attempts = attempts - $8, \
         fruitless = GREATEST(fruitless - $8, 0), last_event = last_event + $9, version = version + 1 \
         WHERE id = $10 AND status = $11 RETURNING last_event",
    )
    .bind(status.as_str())
    .bind(&ending.status_reason)
    .bind(ending.outcome)
    .bind(&ending.summary)
    .bind(job.cancel_requested)
    .bind(status.is_terminal().then_some(now))
    .bind(progress)
    .bind(i64::from(ending.is_released))
    .bind(i64::from(status.is_terminal()))
    .bind(job.id)
    .bind(job.status.as_str())
    .fetch_one(&mut *connection)
    .await?;
    if let Some(done) = &ending.done {
        insert_event(connection, job.id, seq, "done", done).await?;
    }
    if status == Status::Succeeded {
        // Other ends may be followed by another try.
        sqlx::query("DELETE FROM checkpoints WHERE job_id = $1")
            .bind(job.id)
            .execute(connection)
            .await?;
    }
    Ok(Some(status))
}
