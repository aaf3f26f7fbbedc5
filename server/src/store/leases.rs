//! Leases: jobs held by workers, their writes and their ends.

use std::cmp::Reverse;
use std::time::Duration;

use api::job::{Outcome, Progress};
use api::results::{Snapshot, Summary};
use serde::{Deserialize, Serialize};
use solver::record::CycleReport;
use uuid::Uuid;

use crate::queue::{Capacity, Transition};
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::NewFile;
use crate::store::block::EncodedBlock;

/// Request of a worker for jobs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClaimRequest {
    /// Process and number of the request, from 1: one that is repeated, because its answer was lost, gets the same jobs again.
    pub request: RequestNumber,
    /// True if the worker is another process, which continues when the service ends.
    pub is_remote: bool,
    /// Free slots and memory of the worker.
    pub capacity: Capacity,
    /// Length of the leases.
    pub lease: Duration,
    /// Token that authenticates the request and owns the leases; not part of the worker's document.
    #[serde(skip)]
    pub token: Option<Uuid>,
}

/// The number of a worker's request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct RequestNumber {
    /// The process of the worker.
    pub worker: Uuid,
    /// The number, from 1.
    pub number: i64,
}

/// A lease of a job: the fence of every write under it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Lease {
    /// The job.
    pub job: Uuid,
    /// Number of the lease.
    pub number: i64,
}

impl From<&Claim> for Lease {
    fn from(claim: &Claim) -> Self {
        Self {
            job: claim.id,
            number: claim.lease,
        }
    }
}

/// Smallest step by which the number of a job's lease is raised.
const SMALLEST_STEP: i64 = 1 << 32;

impl Lease {
    /// By how much the number of a job's lease is raised: at random, up to twice the smallest step, so that a database that has lost a lease
    /// (a failover, a restored backup) does not give its number to another worker while its own still writes.
    pub(in crate::store) fn step() -> i64 {
        // The last 32 bits of a UUID of version 7 are random (RFC 9562, section 5.7).
        let random = Uuid::now_v7().as_u128() & u128::from(u32::MAX);
        SMALLEST_STEP + i64::try_from(random).unwrap_or_default()
    }
}

/// A job under a lease.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
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
    /// Time after the claim at which the job fails unless it has ended, ms.
    pub deadline_in_ms: Option<i64>,
    /// Estimated peak memory, MB.
    pub memory_mb: i64,
    /// Estimated processor time, ms; 0 where it is not known.
    pub cpu_ms: i64,
    /// Checkpoint to resume from.
    pub checkpoint: Option<ClaimedCheckpoint>,
}

impl Claim {
    /// Checks whether the job had no lease before.
    pub fn is_first(&self) -> bool {
        self.lease < 2 * SMALLEST_STEP
    }
}

/// The checkpoint of a claimed job.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ClaimedCheckpoint {
    /// Included in the claim.
    Given(EncodedCheckpoint),
    /// In the store of objects, to be fetched by another request.
    Stored {
        /// Cycle.
        cycle: u64,
    },
}

impl ClaimedCheckpoint {
    /// Cycle.
    pub fn cycle(&self) -> u64 {
        match self {
            Self::Given(checkpoint) => checkpoint.cycle,
            Self::Stored { cycle } => *cycle,
        }
    }
}

/// Progress and results that a worker writes in one transaction.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JobUpdate {
    /// Number of the write under its lease, from 1 without gaps: one that is repeated, because its answer was lost, has no further effect, and
    /// one after a gap has none, because the database has lost the writes before it.
    pub number: i64,
    /// Progress of the job.
    pub progress: Progress,
    /// New rows of the wear history; they replace rows of the same cycle.
    pub rows: Vec<CycleReport>,
    /// New snapshots; they replace snapshots of the same cycle.
    pub snapshots: Vec<Snapshot>,
    /// New files of the manifest; they replace files of the same name.
    pub files: Vec<NewFile>,
    /// The small results of a job that ends, as a block.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block: Option<EncodedBlock>,
    /// The newest checkpoint; all rows, snapshots and files up to its cycle are in this update or an earlier one.
    pub checkpoint: Option<EncodedCheckpoint>,
    /// Key of the object that has the state of the checkpoint; the database has it otherwise.
    #[serde(skip)]
    pub checkpoint_object: Option<String>,
    /// New events: name and JSON document.
    pub events: Vec<(EventName, String)>,
}

/// A write of a worker under its lease.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Write {
    /// The lease.
    pub lease: Lease,
    /// The update; its files were sent before.
    pub update: JobUpdate,
    /// Renewal or end, in the same transaction.
    pub kind: WriteKind,
}

/// Effect of a write on the lease, besides its update.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WriteKind {
    /// The lease is renewed for a length.
    Renew(Duration),
    /// The job ends, or returns to the queue.
    End(Box<End>),
}

/// Largest block of a small update, bytes; bounds how long others that are written with it wait. Arbitrary.
const SMALL_BLOCK: usize = 64 * 1024;

/// Most rows of one, for the same reason. Arbitrary.
const FEW_ROWS: usize = 64;

impl JobUpdate {
    /// Files, the largest first: one that the store of objects does not take keeps the others from being sent again and again.
    pub(crate) fn largest_files_first(&mut self) -> Vec<&mut NewFile> {
        let mut files: Vec<_> = self.files.iter_mut().collect();
        files.sort_by_key(|file| Reverse(file.file.bytes));
        files
    }

    /// Returns `true` if it is written together with others: it has a few rows and events, and no more than a small block of results.
    pub(crate) fn is_small(&self) -> bool {
        let block = self.block.as_ref();
        let bytes = block.map_or(0, |block| block.entries.len() + block.content.len());
        let has_checkpoint = self.checkpoint.is_some() && self.checkpoint_object.is_none();
        let is_rest_small = self.snapshots.is_empty() && self.files.is_empty() && !has_checkpoint;
        is_rest_small && bytes <= SMALL_BLOCK && self.rows.len() <= FEW_ROWS
    }
}

/// The events that a worker writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EventName {
    /// Progress of the job.
    Progress,
    /// A row of the wear history.
    Cycle,
}

impl EventName {
    /// Name in the stream.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Progress => "progress",
            Self::Cycle => "cycle",
        }
    }
}

/// State of a worker's lease.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeaseState {
    /// The worker holds the job.
    Held {
        /// The user has requested the end of the job.
        cancel_requested: bool,
    },
    /// The lease was lost; the write was discarded.
    Lost,
}

impl LeaseState {
    /// State of a held job, by whether its end was requested; lost without one.
    pub(in crate::store) fn of(cancel_requested: Option<bool>) -> Self {
        cancel_requested.map_or(Self::Lost, |cancel_requested| Self::Held {
            cancel_requested,
        })
    }
}

/// How a worker ends a job or returns it to the queue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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

/// End of the leases of a database that was restored, whose workers may have written more than it knows: before all times, so that they
/// have ended.
pub(in crate::store) const ENDED_BY_RESTORE: i64 = -1;

/// How a job is reclaimed whose lease has ended at a time: by a restore of the database, which costs no attempt, or because its worker was lost.
pub(in crate::store) fn reclaim(ended_at: i64, lost: &str) -> End {
    if ended_at == ENDED_BY_RESTORE {
        End::without_result(
            Transition::Release,
            "the database was restored while it ran",
        )
    } else {
        End::without_result(Transition::WorkerLost, lost)
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
