//! Documents of the event stream (`GET /v1/jobs/{id}/events`).
//!
//! Event names: `snapshot` (a [`crate::job::Job`], first on a fresh connection, without an id), `attempt` ([`Attempt`]:
//! a worker begins, and what was told of later cycles than `from_cycle` is void), `progress` ([`crate::job::Progress`]), `cycle` ([`crate::results::CycleRow`]) and `done` ([`Done`]).

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::job::{Outcome, Status};
use crate::results::Summary;

/// A worker has taken the job. What was told of later cycles than `from_cycle` belongs to an attempt that ended before
/// its next checkpoint; the same cycles come again, with the same bits.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Attempt {
    /// Which attempt it is, from 1.
    pub attempt: u32,
    /// The cycle of the checkpoint that it goes on from; 0 where it begins anew.
    #[serde(default)]
    pub from_cycle: u64,
}

/// The last event of a stream.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Done {
    /// How the job ended.
    pub status: Status,
    /// Why, in words.
    pub status_reason: Option<String>,
    /// How the solve ended.
    pub outcome: Option<Outcome>,
    /// The result in short.
    pub summary: Option<Summary>,
}
