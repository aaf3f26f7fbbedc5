//! Limits that are chosen when a store is opened.

use crate::queue::ATTEMPT_LIMIT;

/// Default of [`Limits::least_free_disk_mb`].
const LEAST_FREE_DISK_MB: u64 = 256;
/// Longest time between two counts of the time that services have seen pass, ms, of what is counted: a service counts each minute, unless it
/// is slow.
pub(in crate::store) const LONGEST_COUNTED_MS: i64 = 300_000;

/// Limits of a store.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Largest number of attempts in a row without a new checkpoint at a job whose workers are lost.
    pub attempts: u32,
    /// Free space on its disk below which no job is started, MB.
    pub least_free_disk_mb: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            attempts: ATTEMPT_LIMIT,
            least_free_disk_mb: LEAST_FREE_DISK_MB,
        }
    }
}
