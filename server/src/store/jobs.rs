//! Jobs as they are submitted, listed, cancelled and deleted.

use api::job::{Job, JobOverview, Status};
use api::plan::Plan;
use api::spec::Spec;
use uuid::Uuid;

use crate::store::list_order::{ListPlace, Order};

/// A job to be queued.
#[derive(Debug, Clone, PartialEq)]
pub struct NewJob {
    /// The specification as it was sent, JSON.
    pub sent: String,
    /// The resolved specification.
    pub spec: Spec,
    /// Plan.
    pub plan: Plan,
    /// Priority and deadline.
    pub options: SubmitOptions,
}

/// Options of a submission besides the specification.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SubmitOptions {
    /// Priority: minutes added to the job's age in the queue.
    pub priority: i32,
    /// Time after the submission at which the job fails unless it has ended, s.
    pub deadline_s: Option<u32>,
}

/// A stored job.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredJob {
    /// The document.
    pub document: Job,
    /// Version of the stored document, raised by every change.
    pub version: i64,
    /// True if its status reason is not the stored one, because it waits for disk space.
    pub waits_for_disk: bool,
    /// Number of its newest event.
    pub last_event: i64,
}

/// State of a job after a change.
#[derive(Debug, Clone, PartialEq)]
pub enum Changed {
    /// A job as it is now.
    Job(Box<JobOverview>),
    /// A job that is no longer there.
    Deleted(Uuid),
}

/// Which jobs a list contains.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Filter {
    /// Any of these statuses; all if empty.
    pub statuses: Vec<Status>,
    /// This kind of system.
    pub system: Option<String>,
    /// All of these labels.
    pub labels: Vec<(String, String)>,
    /// Submitted at this time or later, ms since 1970.
    pub created_from: Option<i64>,
    /// Submitted before this time, ms since 1970.
    pub created_before: Option<i64>,
    /// Jobs of this parameter sweep.
    pub sweep: Option<Uuid>,
    /// With this text in the name, a label's value or the id, whatever the case of ASCII letters.
    pub text: Option<String>,
    /// Order of the jobs.
    pub order: Order,
    /// Jobs behind this place.
    pub after: Option<ListPlace>,
    /// Time until which durations are counted, ms since 1970: pages of a list have the same.
    pub as_of_ms: i64,
    /// Largest number of jobs.
    pub limit: u32,
}

impl Filter {
    /// Where the page after this one begins, in the order by creation, if one of so many jobs is full.
    pub(in crate::store) fn next_page(&self, ids: &[Uuid]) -> Option<ListPlace> {
        let is_full = ids.len() >= usize::try_from(self.limit).unwrap_or(usize::MAX);
        let last = ids.last().copied().filter(|_| is_full);
        last.map(|id| ListPlace { id, value: None })
    }
}

/// Effect of a cancel request.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cancelled {
    /// The job was queued and is cancelled.
    AtOnce,
    /// The job is running; its worker ends it.
    Requested,
    /// The job had ended already.
    Already,
}

/// Effect of a request for another try.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Retried {
    /// The job is queued again.
    Queued,
    /// The job is queued or running already.
    Already,
    /// The job has succeeded.
    Succeeded,
}

/// Effect of a delete request.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deleted {
    /// The job and its results are deleted.
    Done,
    /// The job has not ended.
    Active,
    /// There is no such job.
    Missing,
}

/// Idempotency key of a submission, and digests of what it asks for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RequestKey {
    /// The key.
    pub key: String,
    /// SHA-256 of the meaning of the request.
    pub meaning_sha256: [u8; 32],
    /// SHA-256 of the body, which earlier versions stored.
    pub body_sha256: [u8; 32],
}

impl RequestKey {
    /// Returns the answer to a repeated request, from the digest and the id of the first one.
    pub(in crate::store) fn repeated(&self, sha256: &[u8], id: Uuid) -> Submitted {
        if sha256 == self.meaning_sha256 || sha256 == self.body_sha256 {
            Submitted::Job(id)
        } else {
            Submitted::KeyTaken
        }
    }
}

/// Effect of a submission.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Submitted {
    /// A job, queued now or by an earlier request with the same key and meaning.
    Job(Uuid),
    /// The key was used for another request.
    KeyTaken,
}
