//! Results of writes under a lease.

use std::sync::Arc;

use api::job::Status;

use crate::groups::{Groups, Pending};
use crate::store::Write;

/// Small writes that wait for a transaction; none of one that is to be written alone.
pub(super) type Writes = Groups<Arc<Write>, Option<Written>>;

/// A waiting write.
pub(super) type Waiting = Pending<Arc<Write>, Option<Written>>;

/// Effect of a write, or of an earlier one of the same number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Written {
    pub(super) effect: LeaseEffect,
    /// True if it was not this write but an earlier one of the same number.
    pub(super) is_repeated: bool,
}

/// State of the job or of the lease after a write.
#[derive(Debug, Clone, Copy)]
pub(super) enum LeaseEffect {
    /// The job is held.
    Held {
        /// True if its end was requested.
        cancel_requested: bool,
    },
    /// The job has ended, or waits again; `None` if its transition is not allowed.
    Ended(Option<Status>),
    /// The lease was lost; the write was discarded.
    Lost,
}

impl Written {
    /// A write without effect.
    pub(super) const LOST: Self = Self::repeated(LeaseEffect::Lost);

    pub(super) const fn repeated(effect: LeaseEffect) -> Self {
        Self {
            effect,
            is_repeated: true,
        }
    }
}
