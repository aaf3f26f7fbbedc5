//! The model of a job.

use api::job::Status;
use server::queue::{Attempts, Transition, next_status};
use uuid::Uuid;

/// Limit of attempts at a job.
pub(crate) const ATTEMPT_LIMIT: u32 = 3;

/// A job of the model.
#[derive(Debug, Clone)]
pub(crate) struct ModelJob {
    pub(crate) id: Uuid,
    pub(crate) status: Status,
    pub(crate) sort_key: i64,
    pub(crate) queued_at: i64,
    pub(crate) deadline_at: Option<i64>,
    pub(crate) attempts: u32,
    /// Attempts since the last new checkpoint.
    pub(crate) fruitless: u32,
    pub(crate) lease: i64,
    pub(crate) expires_at: i64,
    pub(crate) cancel_requested: bool,
    pub(crate) events: i64,
    /// Last cycle with a row, counted from 1, and the cycle of the checkpoint.
    pub(crate) rows: u64,
    pub(crate) checkpoint: u64,
    pub(crate) deleted: bool,
}

impl ModelJob {
    /// Applies a transition; `false` if it is not allowed.
    pub(crate) fn apply(&mut self, transition: Transition) -> bool {
        let attempts = Attempts {
            fruitless: self.fruitless,
            limit: ATTEMPT_LIMIT,
        };
        let Some(status) = next_status(self.status, transition, attempts, self.cancel_requested)
        else {
            return false;
        };
        self.status = status;
        if status.is_terminal() || transition == Transition::Retry {
            self.events += 1;
        }
        if status == Status::Succeeded {
            self.checkpoint = 0;
        }
        true
    }
}
