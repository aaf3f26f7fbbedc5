//! Ends of jobs, with `done` as the last event, and returns to the queue: what is stored of them.

use api::event::Done;
use api::job::{Outcome, Status};
use uuid::Uuid;

use crate::queue::{Attempts, Transition, next_status};
use crate::store::{End, Retried, StoreError};

/// A job that ends or returns to the queue, and what its next status depends on.
pub(in crate::store) struct EndingJob {
    pub(in crate::store) id: Uuid,
    pub(in crate::store) status: Status,
    pub(in crate::store) cancel_requested: bool,
    attempts: Attempts,
}

/// Columns and event that a transition stores.
pub(in crate::store) struct Ending {
    pub(in crate::store) status: Status,
    pub(in crate::store) status_reason: Option<String>,
    pub(in crate::store) outcome: Option<&'static str>,
    /// Summary of the result, JSON.
    pub(in crate::store) summary: Option<String>,
    /// True if the worker releases the job, which costs no attempt.
    pub(in crate::store) is_released: bool,
    /// True if the next attempt is left to another worker, if there is one.
    pub(in crate::store) is_left: bool,
    /// The document of the event `done`, for a job that ends.
    pub(in crate::store) done: Option<String>,
}

impl EndingJob {
    /// A running job.
    pub(in crate::store) fn running(
        id: Uuid,
        fruitless: u32,
        limit: u32,
        cancel_requested: bool,
    ) -> Self {
        Self {
            id,
            status: Status::Running,
            attempts: Attempts { fruitless, limit },
            cancel_requested,
        }
    }

    /// A queued job; the number of its attempts matters for lost workers only.
    pub(in crate::store) fn queued(id: Uuid, cancel_requested: bool) -> Self {
        Self {
            status: Status::Queued,
            ..Self::running(id, 0, 0, cancel_requested)
        }
    }

    /// Returns the status after a transition.
    pub(in crate::store) fn after(&self, transition: Transition) -> Option<Status> {
        next_status(
            self.status,
            transition,
            self.attempts,
            self.cancel_requested,
        )
    }

    /// Returns the columns and the event that an end stores; `None` if its transition is not allowed.
    pub(in crate::store) fn ending(&self, end: &End) -> Result<Option<Ending>, StoreError> {
        let Some(status) = self.after(end.transition) else {
            return Ok(None);
        };
        let (status_reason, outcome) = reason_and_outcome(status, self.attempts, end);
        // The last output of a program may have the character U+0000, which databases cannot store in a text.
        let status_reason = status_reason.map(|reason| reason.replace('\0', "\u{fffd}"));
        let done = status.is_terminal().then(|| Done {
            status,
            status_reason: status_reason.clone(),
            outcome,
            // The summary of a succeeded job stays in its row, and is added where the event is read.
            summary: (end.summary.clone()).filter(|_| status != Status::Succeeded),
        });
        Ok(Some(Ending {
            status,
            status_reason,
            outcome: outcome.map(Outcome::as_str),
            summary: end
                .summary
                .as_ref()
                .map(serde_json::to_string)
                .transpose()?,
            is_released: status == Status::Queued
                && matches!(end.transition, Transition::Release | Transition::Decline),
            is_left: status == Status::Queued
                && matches!(end.transition, Transition::WorkerLost | Transition::Decline),
            done: done.as_ref().map(serde_json::to_string).transpose()?,
        }))
    }
}

/// The status of a job that is tried again, or why it is not.
pub(in crate::store) fn retried(status: Status) -> Result<Status, Retried> {
    let attempts = Attempts {
        fruitless: 0,
        limit: 0,
    };
    let queued = next_status(status, Transition::Retry, attempts, false);
    queued.ok_or(if status.is_terminal() {
        Retried::Succeeded
    } else {
        Retried::Already
    })
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
        (Transition::Release | Transition::Decline, Status::Queued) => {
            (format!("{cause}; waiting for a worker"), None)
        }
        // The cancel request was made before the worker was lost or released the job.
        (Transition::WorkerLost | Transition::Release | Transition::Decline, Status::Cancelled) => {
            ("cancelled while running".to_owned(), end.outcome)
        }
        _ => return (end.reason.clone(), end.outcome),
    };
    (Some(reason), outcome)
}
