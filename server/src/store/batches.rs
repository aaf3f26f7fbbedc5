//! Batches in the store: jobs that were queued together.
//!
//! A batch is queued as a whole or not at all, and deleted only after all its jobs have ended. A batch may have an
//! evaluation plan: an opaque JSON text that the store does not read.

use std::collections::BTreeMap;

use api::job::{Outcome, Status};
use api::results::Summary;
use api::sweep::Changes;
use uuid::Uuid;

use crate::store::NewJob;

/// A batch to be queued.
#[derive(Debug, Clone, PartialEq)]
pub struct NewBatch {
    /// Name for people.
    pub name: Option<String>,
    /// Its jobs in order, each with its changes against the base specification.
    pub jobs: Vec<(NewJob, Changes)>,
    /// Evaluation plan, JSON.
    pub plan: Option<String>,
}

/// A batch without its jobs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BatchOverview {
    /// Its id.
    pub id: Uuid,
    /// Name for people.
    pub name: Option<String>,
    /// Time of its submission (RFC 3339).
    pub created_at: String,
    /// Number of its jobs by status, including statuses that no job has.
    pub counts: BTreeMap<String, u64>,
}

/// A batch with its jobs.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredBatch {
    /// The batch itself.
    pub overview: BatchOverview,
    /// Evaluation plan, JSON.
    pub plan: Option<String>,
    /// Its jobs in order, without those that were deleted.
    pub jobs: Vec<BatchJob>,
}

/// A job of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct BatchJob {
    /// The job's id.
    pub id: Uuid,
    /// Its changes against the base specification.
    pub overrides: Changes,
    /// Its status.
    pub status: Status,
    /// Reason for the status.
    pub status_reason: Option<String>,
    /// How its solve ended.
    pub outcome: Option<Outcome>,
    /// Its summary; absent below [`BatchDetail::Summaries`].
    pub summary: Option<Summary>,
    /// Its last profile, JSON; absent below [`BatchDetail::Profiles`], and where there is no summary.
    pub profile: Option<String>,
}

/// How much of a batch's results is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BatchDetail {
    /// Status and outcome of each job.
    Statuses,
    /// The summaries too.
    Summaries,
    /// The summaries and the last profiles too.
    Profiles,
}

/// Filter and page of a list of batches.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct BatchFilter {
    /// Only batches that have an evaluation plan.
    pub with_plan: bool,
    /// Only batches older than this one.
    pub before: Option<Uuid>,
    /// Largest number of batches.
    pub limit: u32,
}
