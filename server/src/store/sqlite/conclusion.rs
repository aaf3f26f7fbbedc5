//! How a running job moves on: to its end, with `done` as its last event, or back to the queue.

use api::event::Done;
use api::job::{Outcome, Status};
use api::results::Summary;
use sqlx::{Sqlite, SqliteConnection, Transaction};
use uuid::Uuid;

use crate::queue::{Transition, Tries, after};
use crate::store::StoreError;
use crate::store::sqlite::checkpoints;
use crate::store::sqlite::queries::insert_event;

/// How a worker ends a job.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// The move: succeed, fail, cancel, lose or give back.
    pub step: Transition,
    /// Why, in words.
    pub reason: Option<String>,
    /// How the solve ended.
    pub outcome: Option<Outcome>,
    /// The result in short.
    pub summary: Option<Summary>,
}

/// A running job's state as far as its end depends on it.
#[derive(sqlx::FromRow)]
pub(in crate::store) struct Standing {
    pub(in crate::store) attempts: i64,
    pub(in crate::store) cancel_requested: bool,
}

impl Standing {
    /// With what the service allows.
    pub(in crate::store) fn limited(&self, attempt_limit: u32) -> Limited {
        Limited {
            tries: Tries {
                made: u32::try_from(self.attempts).unwrap_or(u32::MAX),
                limit: attempt_limit,
            },
            cancel_requested: self.cancel_requested,
        }
    }
}

/// The same beside what the service allows.
pub(in crate::store) struct Limited {
    tries: Tries,
    cancel_requested: bool,
}

impl Limited {
    /// Whether a move ends a running job.
    pub(in crate::store) fn ends(&self, step: Transition) -> bool {
        let status = after(Status::Running, step, self.tries, self.cancel_requested);
        status.is_some_and(Status::is_terminal)
    }
}

/// Moves a running job on; with `done` as its last event if nothing follows.
pub(in crate::store) async fn conclude(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
    standing: &Limited,
    end: &End,
    progress: Option<&str>,
    now: i64,
) -> Result<Option<Status>, StoreError> {
    let tries = standing.tries;
    let Some(status) = after(Status::Running, end.step, tries, standing.cancel_requested) else {
        return Ok(None);
    };
    let (reason, outcome) = words(status, tries, end);
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
    .bind(i64::from(status == Status::Queued && end.step == Transition::GiveBack))
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
        insert_event(transaction, id, seq, "done", &serde_json::to_string(&done)?).await?;
        checkpoints::remove(transaction, id).await?;
    }
    Ok(Some(status))
}

/// Ends a waiting job, with `done` as its last event.
pub(in crate::store) async fn end_waiting(
    connection: &mut SqliteConnection,
    id: Uuid,
    end: &End,
    now: i64,
) -> Result<(), StoreError> {
    // Attempts decide about lost workers only.
    let tries = Tries { made: 0, limit: 0 };
    let Some(status) = after(
        Status::Queued,
        end.step,
        tries,
        end.step == Transition::Cancel,
    ) else {
        return Ok(());
    };
    let seq: i64 = sqlx::query_scalar(
        "UPDATE jobs SET status = ?, status_reason = ?, outcome = ?, cancel_requested = ?, finished_at = ?, \
         last_event = last_event + 1, version = version + 1 WHERE id = ? AND status = 'queued' RETURNING last_event",
    )
    .bind(status.as_str())
    .bind(&end.reason)
    .bind(end.outcome.map(Outcome::as_str))
    .bind(end.step == Transition::Cancel)
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
    insert_event(
        &mut *connection,
        id,
        seq,
        "done",
        &serde_json::to_string(&done)?,
    )
    .await?;
    checkpoints::remove(connection, id).await
}

/// Reason and outcome as the user reads them.
fn words(status: Status, tries: Tries, end: &End) -> (Option<String>, Option<Outcome>) {
    let Tries { made, limit } = tries;
    let cause = end.reason.as_deref().unwrap_or("its worker was lost");
    match (end.step, status) {
        (Transition::Lose, Status::Queued) => (
            Some(format!(
                "attempt {made} of {limit}: {cause}; waiting for a worker"
            )),
            None,
        ),
        (Transition::Lose, Status::Failed) => (
            Some(format!("worker_lost: {made} attempts; the last: {cause}")),
            Some(Outcome::WorkerLost),
        ),
        (Transition::GiveBack, Status::Queued) => {
            (Some(format!("{cause}; waiting for a worker")), None)
        }
        (_, Status::Cancelled) => (Some("cancelled while running".to_owned()), end.outcome),
        _ => (end.reason.clone(), end.outcome),
    }
}
