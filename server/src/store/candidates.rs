//! The first jobs of the queue, among which a claim finds those that its worker can take.

use std::time::Duration;

use uuid::Uuid;

use crate::clock::Now;
use crate::queue::WaitingJob;
use crate::store::StoreError;
use crate::store::rows::StoredRow;

/// Number of waiting jobs among which those that fit are searched, beside one for each slot.
pub(in crate::store) const CANDIDATES: usize = 64;

/// How long a job that its worker has lost or declined is left to others, where there are any. Arbitrary: longer than an idle worker takes to
/// find it.
const LEFT_FOR: Duration = Duration::from_secs(30);

/// Until when a job is left to other workers than its last one, ms.
pub(in crate::store) fn left_until(now: Now) -> i64 {
    now.end_of(LEFT_FOR)
}

/// A waiting job.
#[derive(Debug)]
pub(in crate::store) struct Candidate {
    pub(in crate::store) id: Uuid,
    pub(in crate::store) job: WaitingJob,
    /// A worker that others are preferred to, and until when, ms.
    avoided: Option<(Uuid, i64)>,
}

impl Candidate {
    /// Reads it from its row.
    pub(in crate::store) fn read(row: &impl StoredRow) -> Result<Self, StoreError> {
        let worker = row.optional_id("avoided_worker")?;
        let until = row.value("avoided_until")?;
        Ok(Self {
            id: row.id("id")?,
            job: WaitingJob {
                memory_mb: row.value("memory_mb")?,
                since: row.value("queued_at")?,
                cpu_ms: row.value("cpu_ms")?,
            },
            avoided: worker.zip(until),
        })
    }

    /// The worker that others are preferred to at present.
    pub(in crate::store) fn avoided(&self, now: Now) -> Option<Uuid> {
        let (worker, until) = self.avoided?;
        // A time farther ahead is that of another clock, before a step.
        let is_at_present = (now.monotonic_ms..=left_until(now)).contains(&until);
        is_at_present.then_some(worker)
    }

    /// Checks whether the job is left to one of the workers that are there instead of this one.
    pub(in crate::store) fn is_left(&self, worker: Uuid, there: &[Uuid], now: Now) -> bool {
        self.avoided(now) == Some(worker) && there.iter().any(|other| *other != worker)
    }
}
