//! Leases: jobs held by workers, their writes and their ends.

use api::job::{Outcome, Progress};
use api::results::{Snapshot, Summary};
use solver::record::CycleReport;
use uuid::Uuid;

use crate::queue::Transition;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::NewFile;
use crate::store::block::EncodedBlock;

/// A job under a lease.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The job.
    pub id: Uuid,
    /// Number of the lease; the fence of every write.
    pub lease: i64,
    /// The resolved specification, JSON.
    pub spec: String,
    /// Number of the attempt, from 1.
    pub attempt: u32,
    /// Time since the submission, ms.
    pub waited_ms: i64,
    /// Time at which the job fails unless it has ended, ms.
    pub deadline_at: Option<i64>,
    /// Estimated peak memory, MB.
    pub memory_mb: i64,
    /// Checkpoint to resume from.
    pub checkpoint: Option<EncodedCheckpoint>,
}

/// What a worker writes in one transaction.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct JobUpdate {
    /// Progress of the job.
    pub progress: Progress,
    /// New rows of the wear history; they replace rows of the same cycle.
    pub rows: Vec<CycleReport>,
    /// New snapshots; they replace snapshots of the same cycle.
    pub snapshots: Vec<Snapshot>,
    /// New files of the manifest; they replace files of the same name.
    pub files: Vec<NewFile>,
    /// The small results of a job that ends, as a block.
    pub block: Option<EncodedBlock>,
    /// The newest checkpoint; all rows, snapshots and files up to its cycle are in this update or an earlier one.
    pub checkpoint: Option<EncodedCheckpoint>,
    /// New events: name and JSON document.
    pub events: Vec<(&'static str, String)>,
}

/// State of a worker's lease.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeaseState {
    /// The worker holds the job.
    Held {
        /// The user has requested the end of the job.
        cancel_requested: bool,
    },
    /// The lease was lost; the write was discarded.
    Lost,
}

/// How a worker ends a job or returns it to the queue.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// The transition: any but a claim.
    pub transition: Transition,
    /// The cause, in words.
    pub reason: Option<String>,
    /// Outcome of the solve.
    pub outcome: Option<Outcome>,
    /// Summary of the result.
    pub summary: Option<Summary>,
}

impl End {
    /// An end without a result.
    pub(crate) fn without_result(transition: Transition, reason: impl Into<String>) -> Self {
        Self {
            transition,
            reason: Some(reason.into()),
            outcome: None,
            summary: None,
        }
    }
}

/// Jobs reclaimed from lost workers.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Reclaimed {
    /// Number of jobs that are queued again.
    pub queued: usize,
    /// Jobs without another attempt, under new leases, so that the results of the lost attempt become documents before
    /// the job ends.
    pub ending: Vec<Claim>,
    /// Why they were reclaimed.
    pub reason: &'static str,
}
