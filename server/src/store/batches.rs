//! Batches in the store: jobs that were queued together.
//!
//! A batch is accepted as a whole or not at all, and deleted only after all its jobs have ended. A batch may have an
//! evaluation plan, and an expansion: jobs that are queued only when others have been solved. Plan and request are opaque JSON texts that
//! the store does not read.

use std::collections::BTreeMap;
use std::ops::Range;

use api::job::{Outcome, Status};
use api::results::Summary;
use api::sweep::{Changes, RefusedChanges};
use uuid::Uuid;

use crate::store::NewJob;

/// Largest number of jobs that a transaction cancels or deletes; bounds how long other writes wait.
pub(in crate::store) const JOBS_AT_ONCE: i64 = 100;
/// Refused combinations that are stored with their reasons: the first ones.
pub(in crate::store) const STORED_REFUSALS: u64 = 100;

/// End of all jobs of a batch, a limited number at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BatchEnding {
    /// The jobs are cancelled.
    Cancel,
    /// The jobs are deleted, and the batch with the last of them.
    Delete,
}

impl BatchEnding {
    /// Name in the database.
    pub(in crate::store) fn as_str(self) -> &'static str {
        match self {
            Self::Cancel => "cancel",
            Self::Delete => "delete",
        }
    }

    /// The ending of this name.
    pub(in crate::store) fn from_name(name: &str) -> Option<Self> {
        let all = [Self::Cancel, Self::Delete];
        all.into_iter().find(|ending| ending.as_str() == name)
    }
}

/// A batch to be queued.
#[derive(Debug, Clone, PartialEq)]
pub struct NewBatch {
    /// Name for people.
    pub name: Option<String>,
    /// The base specification as it was sent, JSON.
    pub base: String,
    /// Jobs in order, or the first of them.
    pub jobs: Vec<NewBatchJob>,
    /// Evaluation plan, JSON.
    pub plan: Option<String>,
    /// The jobs after these.
    pub expansion: Option<NewExpansion>,
}

/// A job of a batch to be queued.
#[derive(Debug, Clone, PartialEq)]
pub struct NewBatchJob {
    /// Number in the batch, from 0.
    pub position: u64,
    /// The job.
    pub job: NewJob,
    /// Changes against the base specification.
    pub overrides: Changes,
}

/// The jobs of a batch that are queued only when others have been solved.
#[derive(Debug, Clone, PartialEq)]
pub struct NewExpansion {
    /// Request that the jobs are generated from, JSON.
    pub request: String,
    /// Position of the first of them.
    pub next: u64,
    /// Number of jobs in all.
    pub jobs: u64,
    /// Estimated processor time of a job, s.
    pub cpu_s: Option<f64>,
}

/// A batch with jobs that are to be queued.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Expansion {
    /// The batch.
    pub batch: Uuid,
    /// Position of the next job.
    pub next: u64,
    /// Number of jobs in all.
    pub jobs: u64,
    /// Number of its jobs that wait in the queue.
    pub waiting: u64,
}

/// The next jobs of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct Portion {
    /// The batch.
    pub batch: Uuid,
    /// Positions that were tried.
    pub positions: Range<u64>,
    /// The jobs.
    pub jobs: Vec<NewBatchJob>,
    /// Positions that make no job.
    pub refused: Vec<RefusedChanges>,
}

impl Portion {
    /// The refused ones that are stored, if so many are refused with them.
    pub(in crate::store) fn stored_refusals(&self, refused: i64) -> &[RefusedChanges] {
        let all = u64::try_from(refused).unwrap_or_default();
        let own = u64::try_from(self.refused.len()).unwrap_or(u64::MAX);
        let left = STORED_REFUSALS.saturating_sub(all.saturating_sub(own));
        let stored = usize::try_from(left.min(own)).unwrap_or_default();
        &self.refused[..stored]
    }
}

/// A batch without its jobs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BatchOverview {
    /// Id.
    pub id: Uuid,
    /// Name for people.
    pub name: Option<String>,
    /// Time of its submission (RFC 3339).
    pub created_at: String,
    /// Number of its jobs in the queue and after it by status, including statuses that no job has.
    pub counts: BTreeMap<String, u64>,
    /// Number of jobs that were asked for, of which some may have been deleted; `None` if it has no expansion.
    pub asked: Option<u64>,
    /// Number of jobs that are still to be queued.
    pub to_come: u64,
    /// Number of jobs that were to be queued when the batch was cancelled.
    pub never_queued: u64,
    /// Number of combinations that made no valid job.
    pub refused: u64,
}

/// A batch with its jobs.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredBatch {
    /// The batch itself.
    pub overview: BatchOverview,
    /// Evaluation plan, JSON.
    pub plan: Option<String>,
    /// Request that the jobs of the expansion are generated from, JSON.
    pub request: Option<String>,
    /// The jobs that were asked for, in order, without those that were deleted.
    pub jobs: Vec<BatchJob>,
    /// The first combinations that made no valid job.
    pub refused: Vec<RefusedChanges>,
}

/// A job of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct BatchJob {
    /// The job's id.
    pub id: Uuid,
    /// Number in the batch, from 0.
    pub position: u64,
    /// Changes against the base specification.
    pub overrides: Changes,
    /// Status.
    pub status: Status,
    /// Reason for the status.
    pub status_reason: Option<String>,
    /// How its solve ended.
    pub outcome: Option<Outcome>,
    /// Summary; absent below [`BatchDetail::Summaries`].
    pub summary: Option<Summary>,
    /// Last profile, JSON; absent below [`BatchDetail::Profiles`], and where there is no summary.
    pub profile: Option<String>,
}

/// Jobs of a batch, in the order of their positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BatchPart {
    /// Position of the first.
    pub from: u64,
    /// Largest number of them.
    pub limit: u32,
}

impl BatchPart {
    /// All jobs.
    pub const WHOLE: Self = Self {
        from: 0,
        limit: u32::MAX,
    };
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
