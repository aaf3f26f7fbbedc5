//! The model of a job.

use api::job::Status;
use server::queue::{Transition, Tries, after};
use uuid::Uuid;

/// How often a job is tried.
pub(crate) const ATTEMPTS: u32 = 3;

/// A job as the model has it.
#[derive(Debug, Clone)]
pub(crate) struct Modelled {
    pub(crate) id: Uuid,
    pub(crate) status: Status,
    pub(crate) place: i64,
    pub(crate) deadline_at: Option<i64>,
    pub(crate) attempts: u32,
    pub(crate) lease: i64,
    pub(crate) expires_at: i64,
    pub(crate) unwanted: bool,
    pub(crate) events: i64,
    /// Cycles whose rows are there, counted from 1, and the one that the checkpoint is at.
    pub(crate) rows: u64,
    pub(crate) checkpoint: u64,
    pub(crate) deleted: bool,
}

impl Modelled {
    pub(crate) fn moves(&mut self, step: Transition) -> bool {
        let tries = Tries {
            made: self.attempts,
            limit: ATTEMPTS,
        };
        let Some(status) = after(self.status, step, tries, self.unwanted) else {
            return false;
        };
        self.status = status;
        if status.is_terminal() {
            self.events += 1;
            self.checkpoint = 0;
        }
        true
    }
}
