//! Remote workers in the store: those in contact with a service, and those that are drained.

use std::time::Duration;

use uuid::Uuid;

/// Time without contact after which a process is taken for ended: several claims, each of which waits for up to 20 s.
pub(in crate::store) const PRESENT: Duration = Duration::from_mins(1);

/// Time without contact after which one is forgotten: if it is back before, it is listed again at once, and one that was drained still takes
/// no jobs.
const REMEMBERED: Duration = Duration::from_hours(24);

/// A contact of a service with a remote process.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WorkerContact {
    /// The process.
    pub id: Uuid,
    /// Offer of the process at its last claim; `None` if it has made none at this service.
    pub offer: Option<WorkerOffer>,
    /// Reason why it starts no solves at present, from its last heartbeat.
    pub failing: Option<String>,
    /// Time since the contact.
    pub ago: Duration,
}

/// Machine and capacity of a remote process.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WorkerOffer {
    /// Name of its machine.
    pub host: String,
    /// Number of jobs that it solves at once.
    pub slots: i64,
    /// Memory for its solves, MB.
    pub memory_mb: i64,
    /// Part of it that no solve uses, MB.
    pub free_memory_mb: i64,
}

/// Time of a contact on a clock, ms.
pub(in crate::store) fn contact_at(now: i64, ago: Duration) -> i64 {
    now.saturating_sub(i64::try_from(ago.as_millis()).unwrap_or(i64::MAX))
}

/// Contacts before this time on a clock, ms, are those of processes that are forgotten.
pub(in crate::store) fn remembered_from(now: i64) -> i64 {
    contact_at(now, REMEMBERED)
}

/// Contacts before this time on a clock, ms, are those of processes that have ended.
pub(in crate::store) fn present_from(now: i64) -> i64 {
    contact_at(now, PRESENT)
}
