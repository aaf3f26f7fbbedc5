//! Configuration of workers: leases, checkpoints, memory.

use std::path::PathBuf;
use std::time::Duration;

use nix::sys::sysinfo::sysinfo;

use crate::backoff::Backoff;
use crate::control_group;

/// Memory limit of a solving process over its estimate: the estimate controls admission, the limit only protects the
/// machine from one job.
const MEMORY_MARGIN: i64 = 4;
/// Smallest memory limit, MB.
const MIN_MEMORY_MB: i64 = 1_024;
/// Part of the machine's memory for all solving processes together, per cent.
const MEMORY_SHARE_PERCENT: u64 = 80;

/// Memory in several threads over the estimate, which is that in one, per cent: 154 at most of ten scenes in 2 to 8 threads.
const MEMORY_OF_THREADS_PERCENT: i64 = 160;

/// Pauses before an operation of the job source is retried.
pub(super) const RETRY: Backoff = Backoff {
    first: Duration::from_secs(1),
    longest: Duration::from_secs(10),
};

/// Length of the leases of remote workers: an interruption of the network or a restart of the service is shorter.
pub const REMOTE_LEASE: Duration = Duration::from_secs(30);

/// Configuration of workers.
#[derive(Debug, Clone)]
pub struct WorkerConfig {
    /// The binary that has the command `solve-child`.
    pub program: PathBuf,
    /// Length of a lease; it is renewed three times within.
    pub lease: Duration,
    /// Interval at which updates are written and the cancel request is read.
    pub update_every: Duration,
    /// Processor time up to which a worker claims short jobs ahead; 0 for none.
    pub ahead: Duration,
    /// True if a worker ends when no job waits or runs.
    pub until_idle: bool,
    /// Time between two checkpoints of a solving process.
    pub checkpoint_every: Duration,
    /// Threads of a solving process that runs alone; of several each has its part when it starts, one at least.
    pub threads: usize,
    /// Time for the last checkpoint of a solving process before it is killed.
    pub grace: Duration,
    /// Largest estimated peak memory of all running jobs together, MB.
    pub memory_mb: i64,
    /// Memory limit of a solving process, MB; from its plan if not set.
    pub job_memory_mb: Option<i64>,
}

impl WorkerConfig {
    /// Default configuration for a program.
    pub fn new(program: PathBuf) -> Self {
        Self {
            program,
            lease: Duration::from_secs(10),
            update_every: Duration::from_millis(150),
            ahead: Duration::ZERO,
            until_idle: false,
            checkpoint_every: Duration::from_secs(5),
            threads: 1,
            grace: Duration::from_secs(5),
            memory_mb: machine_memory_mb(),
            job_memory_mb: None,
        }
    }

    /// Returns the threads of a solving process with this estimate that starts as one of so many, and the memory in MB that it takes with
    /// them: one thread and the estimate if there is not enough for more.
    pub(super) fn threads_and_memory(
        &self,
        estimated_mb: i64,
        free_mb: i64,
        running: usize,
    ) -> (usize, i64) {
        let threads = (self.threads / running.max(1)).max(1);
        let more_mb = estimated_mb.saturating_mul(MEMORY_OF_THREADS_PERCENT) / 100;
        let limit_mb = free_mb.min(self.memory_limit_mb(estimated_mb));
        if threads > 1 && more_mb <= limit_mb {
            (threads, more_mb)
        } else {
            (1, estimated_mb)
        }
    }

    /// Returns the memory limit of a solving process with this estimate, MB.
    pub(super) fn memory_limit_mb(&self, estimated_mb: i64) -> i64 {
        self.job_memory_mb.unwrap_or_else(|| {
            estimated_mb
                .saturating_mul(MEMORY_MARGIN)
                .max(MIN_MEMORY_MB)
        })
    }
}

/// Returns the default memory of all solving processes together: of this machine, or of the control group if it is limited.
fn machine_memory_mb() -> i64 {
    let total = sysinfo().map_or(0, |info| info.ram_total());
    let total = control_group::memory_limit().map_or(total, |limit| limit.min(total)) >> 20;
    let share = total.saturating_mul(MEMORY_SHARE_PERCENT) / 100;
    i64::try_from(share).unwrap_or(i64::MAX).max(MIN_MEMORY_MB)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn config() -> WorkerConfig {
        WorkerConfig::new(PathBuf::from("fretwear"))
    }

    #[test]
    fn a_process_takes_its_part_of_the_threads_and_one_at_least() {
        let config = WorkerConfig {
            threads: 8,
            ..config()
        };
        let taken = |free_mb, running| config.threads_and_memory(100, free_mb, running);
        let threads = [0, 1, 2, 3, 8, 20].map(|running| taken(1_000, running).0);
        assert_eq!(threads, [8, 8, 4, 2, 1, 1]);
        assert_eq!(taken(160, 1), (8, 160));
        assert_eq!(taken(1_000, 8), (1, 100));
        // There is no memory for more threads, or a limit below it.
        assert_eq!(taken(159, 1), (1, 100));
        let limited = WorkerConfig {
            job_memory_mb: Some(159),
            ..config
        };
        assert_eq!(limited.threads_and_memory(100, 1_000, 1), (1, 100));
    }

    #[test]
    fn the_memory_limit_is_larger_than_the_estimate() {
        let config = config();
        assert_eq!(config.memory_limit_mb(100), MIN_MEMORY_MB);
        assert_eq!(config.memory_limit_mb(1_000), 4_000);
        let explicit = WorkerConfig {
            job_memory_mb: Some(64),
            ..config
        };
        assert_eq!(explicit.memory_limit_mb(1_000), 64);
    }
}
