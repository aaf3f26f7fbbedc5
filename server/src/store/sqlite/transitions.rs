//! Transitions to an end, with `done` as the last event, or back into the queue.

use api::event::Done;
use api::job::{Outcome, Status};
use sqlx::{Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::queue::{Attempts, Transition, next_status};
use crate::store::sqlite::checkpoints;
use crate::store::sqlite::queries::{attempt_count, insert_event};
use crate::store::{End, StoreError};

/// What the next status of a running job depends on.
pub(super) struct RunningJob {
    attempts: Attempts,
    cancel_requested: bool,
}

impl RunningJob {
    /// From the stored number of attempts and cancel request.
    pub(super) fn new(attempts: i64, cancel_requested: bool, attempt_limit: u32) -> Self {
        Self {
            attempts: Attempts {
                made: attempt_count(attempts),
                limit: attempt_limit,
            },
            cancel_requested,
        }
    }

    /// Returns the status after a transition.
    pub(super) fn after(&self, transition: Transition) -> Option<Status> {
        next_status(
            Status::Running,
            transition,
            self.attempts,
            self.cancel_requested,
        )
    }
}

/// Ends a running job or returns it to the queue; `None` if the transition is not allowed.
pub(super) async fn end_running(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
    job: &RunningJob,
    end: &End,
    progress: Option<&str>,
    now: i64,
) -> Result<Option<Status>, StoreError> {
    let Some(status) = job.after(end.transition) else {
        return Ok(None);
    };
    let (reason, outcome) = reason_and_outcome(status, job.attempts, end);
    let seq: i64 = sqlx::query_scalar(
        "UPDATE jobs SET status = ?, status_reason = ?, outcome = ?, summary = ?, lease_expires_at = NULL, \
         finished_at = ?, progress = COALESCE(?, progress), attempts = attempts - ?, \
         last_event = last_event + ?, version = version + 1 \
         WHERE id = ? AND status = 'running' RETURNING last_event",
    )
    .bind(status.as_str())
    .bind(&reason)
    .bind(outcome.map(Outcome::as_str))
    .bind(end.summary.as_ref().map(serde_json::to_string).transpose()?)
    .bind(status.is_terminal().then_some(now))
    .bind(progress)
    .bind(i64::from(status == Status::Queued && end.transition == Transition::Release))
    .bind(i64::from(status.is_terminal()))
    .bind(id.to_string())
    .fetch_one(&mut **transaction)
    .await?;
    if status.is_terminal() {
        let done = Done {
            status,
            status_reason: reason,
            outcome,
            summary: end.summary.clone(),
        };
        write_done(transaction, id, seq, &done).await?;
    }
    Ok(Some(status))
}

/// Ends a queued job.
pub(super) async fn end_queued(
    connection: &mut SqliteConnection,
    id: Uuid,
    end: &End,
    now: i64,
) -> Result<(), StoreError> {
    // The number of attempts matters for lost workers only.
    let attempts = Attempts { made: 0, limit: 0 };
    let cancelled = end.transition == Transition::Cancel;
    let Some(status) = next_status(Status::Queued, end.transition, attempts, cancelled) else {
        return Ok(());
    };
    let seq: i64 = sqlx::query_scalar(
        "UPDATE jobs SET status = ?, status_reason = ?, outcome = ?, cancel_requested = ?, finished_at = ?, \
         last_event = last_event + 1, version = version + 1 WHERE id = ? AND status = 'queued' RETURNING last_event",
    )
    .bind(status.as_str())
    .bind(&end.reason)
    .bind(end.outcome.map(Outcome::as_str))
    .bind(cancelled)
    .bind(now)
    .bind(id.to_string())
    .fetch_one(&mut *connection)
    .await?;
    let done = Done {
        status,
        status_reason: end.reason.clone(),
        outcome: end.outcome,
        summary: None,
    };
    write_done(connection, id, seq, &done).await
}

/// Appends the last event of a job and deletes its checkpoint.
async fn write_done(
    connection: &mut SqliteConnection,
    id: Uuid,
    seq: i64,
    done: &Done,
) -> Result<(), StoreError> {
    let data = serde_json::to_string(done)?;
    insert_event(&mut *connection, id, seq, "done", &data).await?;
    checkpoints::delete(connection, id).await
}

/// Status reason and outcome for the user.
fn reason_and_outcome(
    status: Status,
    attempts: Attempts,
    end: &End,
) -> (Option<String>, Option<Outcome>) {
    let Attempts { made, limit } = attempts;
    let cause = end.reason.as_deref().unwrap_or("its worker was lost");
    match (end.transition, status) {
        (Transition::WorkerLost, Status::Queued) => (
            Some(format!(
                "attempt {made} of {limit}: {cause}; waiting for a worker"
            )),
            None,
        ),
        (Transition::WorkerLost, Status::Failed) => (
            Some(format!("worker_lost: {made} attempts; the last: {cause}")),
            Some(Outcome::WorkerLost),
        ),
        (Transition::Release, Status::Queued) => {
            (Some(format!("{cause}; waiting for a worker")), None)
        }
        (_, Status::Cancelled) => (Some("cancelled while running".to_owned()), end.outcome),
        _ => (end.reason.clone(), end.outcome),
    }
}
