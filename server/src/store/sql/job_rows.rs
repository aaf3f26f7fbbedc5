//! Statements about one job within a transaction.

use api::job::Status;
use sqlx::AssertSqlSafe;
use uuid::Uuid;

use super::dialect::{Connection, FOR_UPDATE, stored_id};
use super::queries::insert_event;
use super::transitions::end_job;
use crate::clock::Now;
use crate::queue;
use crate::queue::Transition;
use crate::store::ending::{EndingJob, retried};
use crate::store::rows::status;
use crate::store::{Cancelled, End, Retried, StoreError};

/// Locks the row of a job and returns its status; `None` if there is no such job.
pub(super) async fn lock(
    connection: &mut Connection,
    id: Uuid,
) -> Result<Option<Status>, StoreError> {
    let statement = format!("SELECT status FROM jobs WHERE id = $1{FOR_UPDATE}");
    let row = sqlx::query(AssertSqlSafe(statement))
        .bind(stored_id(id))
        .fetch_optional(connection)
        .await?;
    row.map(|row| status(id, &row)).transpose()
}

/// Requests the end of a job, within a transaction.
pub(in super::super) async fn cancel(
    connection: &mut Connection,
    id: Uuid,
    now: Now,
) -> Result<Option<Cancelled>, StoreError> {
    Ok(match lock(connection, id).await? {
        Some(Status::Queued) => {
            let end = End::without_result(Transition::Cancel, "cancelled while waiting");
            let job = EndingJob::queued(id, true);
            end_job(connection, &job, &end, now).await?;
            Some(Cancelled::AtOnce)
        }
        Some(Status::Running) => {
            sqlx::query(
                "UPDATE jobs SET cancel_requested = true, status_reason = 'cancel requested', version = version + 1 WHERE id = $1",
            )
            .bind(stored_id(id))
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
    connection: &mut Connection,
    id: Uuid,
    now: Now,
) -> Result<Option<Retried>, StoreError> {
    let Some(status) = lock(connection, id).await? else {
        return Ok(None);
    };
    let queued = match retried(status) {
        Ok(queued) => queued,
        Err(effect) => return Ok(Some(effect)),
    };
    let (seq, progress): (i64, String) = sqlx::query_as(
        "UPDATE jobs SET status = $1, status_reason = $2, outcome = NULL, summary = NULL, finished_at = NULL, \
         cancel_requested = false, fruitless = 0, deadline_at = deadline_at - queued_at + $3, queued_at = $3, \
         last_event = last_event + 1, version = version + 1 WHERE id = $4 RETURNING last_event, progress",
    )
    .bind(queued.as_str())
    .bind(queue::WAITING_FOR_WORKER)
    .bind(now.monotonic_ms)
    .bind(stored_id(id))
    .fetch_one(&mut *connection)
    .await?;
    insert_event(connection, id, seq, "progress", &progress).await?;
    Ok(Some(Retried::Queued))
}
