//! Documents of the event stream (`GET /v1/jobs/{id}/events`).
//!
//! Event names: `snapshot` (a [`crate::job::Job`], first on a fresh connection, without an id), `attempt` ([`Attempt`]:
//! a worker has started, or its run has restarted at cycle 0; earlier events about cycles after `from_cycle` are void),
//! `progress`
//! ([`crate::job::Progress`]), `cycle` (a row of the wear history: the scalars of one computed cycle by the names of
//! its columns) and `done` ([`Done`]).

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::string_enum;
use crate::job::{Outcome, Status};
use crate::results::Summary;

/// A worker has claimed the job. Earlier events about cycles after `from_cycle` belong to an attempt that ended before
/// its next checkpoint; these cycles are computed again, with the same bits.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Attempt {
    /// Number of the attempt, from 1.
    pub attempt: u32,
    /// Cycle of the checkpoint from which the attempt resumes; 0 if it starts from the unworn state.
    #[serde(default)]
    pub from_cycle: u64,
}

/// The last event of a stream.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Done {
    /// Final status of the job.
    pub status: Status,
    /// Reason for the status, in words.
    pub status_reason: Option<String>,
    /// Outcome of the solve.
    pub outcome: Option<Outcome>,
    /// Summary of the results.
    pub summary: Option<Summary>,
}

/// An event of the stream of all changes (`GET /v1/events`).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct FeedEvent {
    /// The revision of the change.
    pub id: String,
    /// Name.
    pub event: FeedEventName,
    /// Document, JSON: the short document of a job, the `id` of a deleted one, or nothing.
    #[schema(content_media_type = "application/json")]
    pub data: String,
}

string_enum! {
    /// Names of changes.
    FeedEventName {
        /// The stream begins after the change of this revision.
        Start = "start",
        /// A job has changed.
        Job = "job",
        /// A job was deleted.
        Deleted = "deleted",
        /// Changes were missed: what is shown must be loaded again.
        Reset = "reset",
    }
}

/// An event of the stream.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct StreamEvent {
    /// Number within the job, from 1 without gaps; `snapshot` has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// Name.
    pub event: EventName,
    /// Document, JSON: a job, an attempt, progress, a row of the wear history, or the final status.
    #[schema(content_media_type = "application/json")]
    pub data: String,
}

string_enum! {
    /// Names of events.
    EventName {
        /// The current job document.
        Snapshot = "snapshot",
        /// A worker has started.
        Attempt = "attempt",
        /// Progress of the solve.
        Progress = "progress",
        /// A computed cycle.
        Cycle = "cycle",
        /// The job has ended.
        Done = "done",
    }
}
