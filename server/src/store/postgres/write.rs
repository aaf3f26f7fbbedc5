//! Results of writes under a lease.

use std::sync::Arc;

use api::job::Status;

use crate::groups::{Groups, Pending};
use crate::store::Write;

/// Small writes that wait for a transaction; none of one that is to be written alone.
pub(super) type Writes = Groups<Arc<Write>, Option<Written>>;

/// One of them.
pub(super) type Waiting = Pending<Arc<Write>, Option<Written>>;

/// What a write has led to, itself or an earlier one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Written {
    pub(super) effect: Effect,
    /// True if it was not this write but an earlier one of the same number.
    pub(super) is_repeated: bool,
}

/// What a write has led to.
#[derive(Debug, Clone, Copy)]
pub(super) enum Effect {
    /// The job is held.
    Held {
        /// True if its end was requested.
        cancel_requested: bool,
    },
    /// The job has ended, or waits again; `None` if its transition is not allowed.
    Ended(Option<Status>),
    /// None: the lease was lost.
    Lost,
}

impl Written {
    /// Without effect.
    pub(super) const LOST: Self = Self::repeated(Effect::Lost);

    pub(super) const fn repeated(effect: Effect) -> Self {
        Self {
            effect,
            is_repeated: true,
        }
    }
}
