//! How workers work: leases, checkpoints, memory.

use std::path::{Path, PathBuf};
use std::time::Duration;

use nix::sys::statvfs::statvfs;
use nix::sys::sysinfo::sysinfo;

use crate::queue::WAITING_FOR_DISK;

/// A solving process may take this many times what its plan expects: the estimate sizes the queue, the limit only keeps
/// one job from taking the machine down.
const MEMORY_MARGIN: i64 = 4;
/// And never less than this, MB.
const LEAST_MEMORY_MB: i64 = 1_024;
/// Part of the machine's memory that solving processes may expect to need together, per cent.
const MEMORY_SHARE_PERCENT: u64 = 80;

/// How workers work.
#[derive(Debug, Clone)]
pub struct Rules {
    /// The binary that has the hidden subcommand `solve-child`.
    pub program: PathBuf,
    /// How long a lease holds unless it is renewed, which happens three times within.
    pub lease: Duration,
    /// How often a solving process tells a checkpoint.
    pub checkpoint_every: Duration,
    /// How long a solving process has for its last checkpoint before it is killed.
    pub grace: Duration,
    /// What running jobs may be expected to need together, MB.
    pub memory_mb: i64,
    /// What a solving process may take; from its plan unless named, MB.
    pub job_memory_mb: Option<i64>,
    /// No job is taken while the disk has less than this left, MB.
    pub least_free_disk_mb: u64,
    /// Where results are kept.
    pub folder: PathBuf,
}

impl Rules {
    /// The rules for a program that keeps its results in a folder.
    pub fn new(program: PathBuf, folder: PathBuf) -> Self {
        Self {
            program,
            folder,
            lease: Duration::from_secs(10),
            checkpoint_every: Duration::from_secs(5),
            grace: Duration::from_secs(5),
            memory_mb: machine_memory_mb(),
            job_memory_mb: None,
            least_free_disk_mb: 256,
        }
    }

    /// What a solving process may take whose plan expects this, MB.
    pub(super) fn memory_limit_mb(&self, expected_mb: i64) -> i64 {
        self.job_memory_mb.unwrap_or_else(|| {
            expected_mb
                .saturating_mul(MEMORY_MARGIN)
                .max(LEAST_MEMORY_MB)
        })
    }

    /// Why no job may be taken for want of disk space, if so.
    pub(super) fn disk_shortage(&self) -> Option<String> {
        let free_mb = free_disk_mb(&self.folder)?;
        (free_mb < self.least_free_disk_mb).then(|| {
            format!(
                "{WAITING_FOR_DISK}{free_mb} MB are free, {} MB are needed",
                self.least_free_disk_mb
            )
        })
    }
}

/// Disk space that is free for results; nothing where the system does not tell.
fn free_disk_mb(folder: &Path) -> Option<u64> {
    let found = statvfs(folder).ok()?;
    Some(
        found
            .blocks_available()
            .saturating_mul(found.fragment_size())
            >> 20,
    )
}

/// The machine's share for solving processes.
fn machine_memory_mb() -> i64 {
    let total = sysinfo().map_or(0, |info| info.ram_total() >> 20);
    let share = total.saturating_mul(MEMORY_SHARE_PERCENT) / 100;
    i64::try_from(share)
        .unwrap_or(i64::MAX)
        .max(LEAST_MEMORY_MB)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules() -> Rules {
        Rules::new(PathBuf::from("fretwear"), std::env::temp_dir())
    }

    #[test]
    fn a_solving_process_may_take_more_than_its_plan_expects() {
        let rules = rules();
        assert_eq!(rules.memory_limit_mb(100), LEAST_MEMORY_MB);
        assert_eq!(rules.memory_limit_mb(1_000), 4_000);
        let named = Rules {
            job_memory_mb: Some(64),
            ..rules
        };
        assert_eq!(named.memory_limit_mb(1_000), 64);
    }

    #[test]
    fn a_disk_with_less_than_needed_is_a_reason_to_wait() {
        let rules = Rules {
            least_free_disk_mb: u64::MAX,
            ..rules()
        };
        let reason = rules.disk_shortage().expect("a reason");
        assert!(reason.starts_with("waiting for disk space: "), "{reason}");
        let rules = Rules {
            least_free_disk_mb: 0,
            ..rules
        };
        assert_eq!(rules.disk_shortage(), None);
    }
}
