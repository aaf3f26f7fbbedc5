//! The queue's rules, as pure functions.
//!
//! Transitions: `queued -> running -> succeeded | failed | cancelled`; a running job returns to the queue when its
//! worker was lost (a bounded number of times), or released or declined it (which costs no attempt). A failed or cancelled job returns to
//! the queue if its user asks for another try.

mod admission;
mod order;

use api::job::Status;
use serde::{Deserialize, Serialize};

pub use admission::{Admission, Capacity, MemoryBudget, WaitingJob, admit};
pub use order::{MAX_PRIORITY, batch_priority, sort_key};

/// Status reason of a job that waits for a free worker only.
pub const WAITING_FOR_WORKER: &str = "waiting for a worker";

/// Default number of attempts without a new checkpoint after which a job whose workers were lost fails.
pub const ATTEMPT_LIMIT: u32 = 3;

/// A transition of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Transition {
    /// A worker claims the job.
    Claim,
    /// The solve returned a result.
    Succeed,
    /// The solve failed; the same input would fail again.
    Fail,
    /// The job was cancelled: by the user while queued, by its worker while running.
    Cancel,
    /// The worker releases the job at a graceful shutdown.
    Release,
    /// The worker cannot make the attempt at present, by no fault of the job.
    Decline,
    /// The worker was lost.
    WorkerLost,
    /// The deadline has passed.
    Expire,
    /// The user requests another try.
    Retry,
}

/// Attempts at a job, and their limit. Those that left a new checkpoint do not count: a job that makes progress survives any
/// number of lost workers, and one that loses them at the same place does not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attempts {
    /// Claims since the last new checkpoint, without the released and declined ones.
    pub fruitless: u32,
    /// Largest number of them.
    pub limit: u32,
}

/// Returns the status after a transition, or `None` if the transition is not allowed.
pub fn next_status(
    status: Status,
    transition: Transition,
    attempts: Attempts,
    cancel_requested: bool,
) -> Option<Status> {
    match (status, transition) {
        (Status::Queued, Transition::Claim) => Some(Status::Running),
        (Status::Queued | Status::Running, Transition::Cancel) => Some(Status::Cancelled),
        (Status::Running, Transition::Succeed) => Some(Status::Succeeded),
        (Status::Running, Transition::Release | Transition::Decline | Transition::WorkerLost)
            if cancel_requested =>
        {
            Some(Status::Cancelled)
        }
        (Status::Running, Transition::Release | Transition::Decline)
        | (Status::Failed | Status::Cancelled, Transition::Retry) => Some(Status::Queued),
        (Status::Running, Transition::WorkerLost) if attempts.fruitless < attempts.limit => {
            Some(Status::Queued)
        }
        (Status::Running, Transition::WorkerLost | Transition::Fail)
        | (Status::Queued | Status::Running, Transition::Expire) => Some(Status::Failed),
        (
            Status::Queued,
            Transition::Succeed
            | Transition::Fail
            | Transition::Release
            | Transition::Decline
            | Transition::WorkerLost,
        )
        | (Status::Queued | Status::Running, Transition::Retry)
        | (Status::Running, Transition::Claim)
        | (Status::Succeeded | Status::Failed | Status::Cancelled, _) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRANSITIONS: [Transition; 9] = [
        Transition::Claim,
        Transition::Succeed,
        Transition::Fail,
        Transition::Cancel,
        Transition::Release,
        Transition::Decline,
        Transition::WorkerLost,
        Transition::Expire,
        Transition::Retry,
    ];

    /// Every status, transition, number of attempts around the limit and cancel request against the module's table.
    #[test]
    fn every_transition_from_every_status_matches_the_table() {
        for status in Status::ALL {
            for transition in TRANSITIONS {
                for fruitless in 0..=ATTEMPT_LIMIT + 1 {
                    for cancel_requested in [false, true] {
                        let expected = match (status.as_str(), transition) {
                            ("queued", Transition::Claim) => Some("running"),
                            ("queued" | "running", Transition::Cancel) => Some("cancelled"),
                            ("running", Transition::Succeed) => Some("succeeded"),
                            ("queued" | "running", Transition::Expire)
                            | ("running", Transition::Fail) => Some("failed"),
                            (
                                "running",
                                Transition::Release | Transition::Decline | Transition::WorkerLost,
                            ) if cancel_requested => Some("cancelled"),
                            ("running", Transition::WorkerLost) if fruitless >= ATTEMPT_LIMIT => {
                                Some("failed")
                            }
                            ("failed" | "cancelled", Transition::Retry)
                            | (
                                "running",
                                Transition::Release | Transition::Decline | Transition::WorkerLost,
                            ) => Some("queued"),
                            _ => None,
                        };
                        let attempts = Attempts {
                            fruitless,
                            limit: ATTEMPT_LIMIT,
                        };
                        let found = next_status(status, transition, attempts, cancel_requested)
                            .map(Status::as_str);
                        assert_eq!(
                            found, expected,
                            "{status:?} {transition:?} {fruitless} {cancel_requested}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn only_another_try_follows_a_terminal_status() {
        let attempts = Attempts {
            fruitless: 1,
            limit: 3,
        };
        for status in Status::ALL
            .into_iter()
            .filter(|status| status.is_terminal())
        {
            assert!(
                TRANSITIONS
                    .into_iter()
                    .filter(|transition| *transition != Transition::Retry)
                    .all(|transition| next_status(status, transition, attempts, false).is_none())
            );
        }
    }
}
