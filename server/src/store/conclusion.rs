//! How a running job moves on: to its end, with `done` as its last event, or back to the queue.

use api::event::Done;
use api::job::{Outcome, Status};
use api::results::Summary;
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use super::StoreError;
use super::queries::insert_event;
use crate::queue::{ATTEMPT_LIMIT, Move, after};

/// How a worker ends a job.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// The move: succeed, fail, cancel, lose or give back.
    pub step: Move,
    /// Why, in words.
    pub reason: Option<String>,
    /// How the solve ended.
    pub outcome: Option<Outcome>,
    /// The result in short.
    pub summary: Option<Summary>,
}

/// A job's state as far as its end depends on it.
#[derive(sqlx::FromRow)]
pub(super) struct Standing {
    pub(super) attempts: i64,
    pub(super) cancel_requested: bool,
}

/// Moves a running job on; with `done` as its last event if nothing follows.
pub(super) async fn conclude(
    transaction: &mut Transaction<'_, Sqlite>,
    id: Uuid,
    standing: &Standing,
    end: &End,
    progress: Option<&str>,
    now: i64,
) -> Result<Option<Status>, StoreError> {
    let attempts = u32::try_from(standing.attempts).unwrap_or(u32::MAX);
    let Some(status) = after(
        Status::Running,
        end.step,
        attempts,
        standing.cancel_requested,
    ) else {
        return Ok(None);
    };
    let (reason, outcome) = words(status, attempts, end);
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
    .bind(i64::from(status == Status::Queued && end.step == Move::GiveBack))
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
    }
    Ok(Some(status))
}

/// Reason and outcome as the user reads them.
fn words(status: Status, attempts: u32, end: &End) -> (Option<String>, Option<Outcome>) {
    let cause = end.reason.as_deref().unwrap_or("its worker was lost");
    match (end.step, status) {
        (Move::Lose, Status::Queued) => (
            Some(format!(
                "attempt {attempts} of {ATTEMPT_LIMIT}: {cause}; waiting for a worker"
            )),
            None,
        ),
        (Move::Lose, Status::Failed) => (
            Some(format!(
                "worker_lost: {attempts} attempts; the last: {cause}"
            )),
            Some(Outcome::WorkerLost),
        ),
        (Move::GiveBack, Status::Queued) => (
            Some("the service was stopped; waiting for a worker".to_owned()),
            None,
        ),
        (_, Status::Cancelled) => (Some("cancelled while running".to_owned()), end.outcome),
        _ => (end.reason.clone(), end.outcome),
    }
}
