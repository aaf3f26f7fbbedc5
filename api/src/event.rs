//! Documents of the event stream (`GET /v1/jobs/{id}/events`).
//!
//! Event names: `snapshot` (a [`crate::job::Job`], first on a fresh connection, without an id), `attempt` ([`Attempt`]:
//! a worker begins, and what was told of later cycles than `from_cycle` is void), `progress` ([`crate::job::Progress`]), `cycle` (a row of the
//! wear history: the scalars of one computed cycle by the names of its columns) and `done` ([`Done`]).

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
    /// Summary of the result.
    pub summary: Option<Summary>,
}

/// An event as it comes in the stream.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct StreamEvent {
    /// Its number within the job, from 1 without gaps; `snapshot` has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// Its name.
    pub event: EventName,
    /// Its document, JSON: a job, an attempt, progress, a row of the wear history, or the end.
    #[schema(content_media_type = "application/json")]
    pub data: String,
}

/// Names of events.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum EventName {
    /// The job as it stands.
    Snapshot,
    /// A worker begins.
    Attempt,
    /// How far it is.
    Progress,
    /// A computed cycle.
    Cycle,
    /// The end.
    Done,
}
