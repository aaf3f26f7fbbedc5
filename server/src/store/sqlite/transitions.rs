//! Transitions to an end, with `done` as the last event, or back into the queue.

use api::event::Done;
use api::job::{Outcome, Status};
use sqlx::SqliteConnection;
use uuid::Uuid;

use crate::clock::Now;
use crate::queue::{Attempts, Transition, next_status};
use crate::store::sqlite::queries::insert_event;
use crate::store::{End, StoreError};

/// A job that ends or returns to the queue, and what its next status depends on.
pub(super) struct EndingJob {
    id: Uuid,
    status: Status,
    attempts: Attempts,
    cancel_requested: bool,
}

impl EndingJob {
    /// A running job.
    pub(super) fn running(id: Uuid, fruitless: u32, limit: u32, cancel_requested: bool) -> Self {
        Self {
            id,
            status: Status::Running,
            attempts: Attempts { fruitless, limit },
            cancel_requested,
        }
    }

    /// A queued job; the number of its attempts matters for lost workers only.
    pub(super) fn queued(id: Uuid, cancel_requested: bool) -> Self {
        Self {
            status: Status::Queued,
            ..Self::running(id, 0, 0, cancel_requested)
        }
    }

    /// Returns the status after a transition.
    pub(super) fn after(&self, transition: Transition) -> Option<Status> {
        next_status(
            self.status,
            transition,
            self.attempts,
            self.cancel_requested,
        )
    }
}

/// Ends a job or returns it to the queue; `None` if the transition is not allowed.
pub(super) async fn end_job(
    connection: &mut SqliteConnection,
    job: &EndingJob,
    end: &End,
    progress: Option<&str>,
    now: i64,
) -> Result<Option<Status>, StoreError> {
    let Some(status) = job.after(end.transition) else {
        return Ok(None);
    };
    let (status_reason, outcome) = reason_and_outcome(status, job.attempts, end);
    // What is not measured any more is shown by the system's clock.
    let step_ms = if status.is_terminal() {
        Now::read().stepped_ms()
    } else {
        0
    };
    let is_released = status == Status::Queued && end.transition == Transition::Release;
    let seq: i64 = sqlx::query_scalar(
        "UPDATE jobs SET status = ?, status_reason = ?, outcome = ?, summary = ?, cancel_requested = ?, \
         lease_expires_at = NULL, finished_at = ?, progress = COALESCE(?, progress), attempts = attempts - ?, \
         fruitless = max(fruitless - ?, 0), last_event = last_event + ?, version = version + 1, \
         queued_at = queued_at + ?, deadline_at = deadline_at + ? \
         WHERE id = ? AND status = ? RETURNING last_event",
    )
    .bind(status.as_str())
    .bind(&status_reason)
    .bind(outcome.map(Outcome::as_str))
    .bind(end.summary.as_ref().map(serde_json::to_string).transpose()?)
    .bind(job.cancel_requested)
    .bind(status.is_terminal().then_some(now))
    .bind(progress)
    .bind(is_released)
    .bind(is_released)
    .bind(status.is_terminal())
    .bind(step_ms)
    .bind(step_ms)
    .bind(job.id.to_string())
    .bind(job.status.as_str())
    .fetch_one(&mut *connection)
    .await?;
    if status.is_terminal() {
        let done = Done {
            status,
            status_reason,
            outcome,
            // That of a succeeded job stays, and is added where the event is read.
            summary: (end.summary.clone()).filter(|_| status != Status::Succeeded),
        };
        let data = serde_json::to_string(&done)?;
        insert_event(connection, job.id, seq, "done", &data).await?;
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

/// Status reason and outcome for the user.
fn reason_and_outcome(
    status: Status,
    Attempts { fruitless, limit }: Attempts,
    end: &End,
) -> (Option<String>, Option<Outcome>) {
    let cause = end.reason.as_deref().unwrap_or("its worker was lost");
    let (reason, outcome) = match (end.transition, status) {
        (Transition::WorkerLost, Status::Queued) if fruitless == 0 => (
            format!("{cause}; it continues from its last checkpoint; waiting for a worker"),
            None,
        ),
        (Transition::WorkerLost, Status::Queued) => (
            format!(
                "attempt {fruitless} of {limit} without a new checkpoint: {cause}; waiting for a worker"
            ),
            None,
        ),
        (Transition::WorkerLost, Status::Failed) => (
            format!(
                "worker_lost: {fruitless} attempts without a new checkpoint; the last: {cause}"
            ),
            Some(Outcome::WorkerLost),
        ),
        (Transition::Release, Status::Queued) => (format!("{cause}; waiting for a worker"), None),
        // The cancel request was made before the worker was lost or released the job.
        (Transition::WorkerLost | Transition::Release, Status::Cancelled) => {
            ("cancelled while running".to_owned(), end.outcome)
        }
        _ => return (end.reason.clone(), end.outcome),
    };
    (Some(reason), outcome)
}
