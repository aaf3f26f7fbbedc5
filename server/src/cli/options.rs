//! Options of `serve` for queue and workers; each can also be given as an environment variable.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use crate::queue::ATTEMPT_LIMIT;
use crate::service::JOBS_AHEAD;
use crate::store::Limits;
use crate::worker::WorkerConfig;
use crate::worker::protocol::LONGEST_WAIT;

/// Interval of the updates of a remote worker: a thousand of them are 500 requests a second.
const REMOTE_UPDATE_EVERY: Duration = Duration::from_secs(2);
/// Processor time of the short jobs that one is given at once.
const REMOTE_AHEAD: Duration = Duration::from_secs(5);

/// Options for queue and workers.
#[derive(Debug, Args)]
pub(super) struct WorkOptions {
    /// Number of jobs solved at once; one per processor unless given; 0 if only remote workers solve (`fretwear work`).
    #[arg(long, env = "FRETWEAR_WORKERS", value_parser = clap::value_parser!(u16).range(..=256))]
    workers: Option<u16>,
    /// Threads of a solve that runs alone; of several each has its part, one at least; one per processor unless given.
    #[arg(long, env = "FRETWEAR_THREADS", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// Largest number of attempts in a row without a new checkpoint at a job whose workers are lost.
    #[arg(long, env = "FRETWEAR_ATTEMPTS", default_value_t = ATTEMPT_LIMIT, value_parser = clap::value_parser!(u32).range(1..))]
    attempts: u32,
    /// Time after the last heartbeat of a worker at which its job is reclaimed.
    #[arg(long, env = "FRETWEAR_LEASE_S", default_value = "10", value_parser = seconds)]
    lease_s: Duration,
    /// Interval of the checkpoints of a solve; 0 for one after every computed cycle.
    #[arg(long, env = "FRETWEAR_CHECKPOINT_EVERY_S", default_value = "5", value_parser = seconds)]
    checkpoint_every_s: Duration,
    /// Time that a solve has for its last checkpoint when the service stops.
    #[arg(long, env = "FRETWEAR_GRACE_S", default_value = "5", value_parser = seconds)]
    grace_s: Duration,
    /// Limit of the estimated memory of all running jobs; four fifths of the machine's memory unless given.
    #[arg(long, env = "FRETWEAR_MEMORY_MB", value_parser = clap::value_parser!(i64).range(1..))]
    memory_mb: Option<i64>,
    /// Memory limit of one solve; four times the estimate of its plan, and at least 1024, unless given.
    #[arg(long, env = "FRETWEAR_JOB_MEMORY_MB", value_parser = clap::value_parser!(i64).range(1..))]
    job_memory_mb: Option<i64>,
    /// Free space on the database's disk below which no job is started.
    #[arg(long, env = "FRETWEAR_LEAST_FREE_DISK_MB", default_value_t = 256)]
    least_free_disk_mb: u64,
    /// Delete jobs so many days after their end; never unless given.
    #[arg(long, env = "FRETWEAR_KEEP_DAYS")]
    pub(super) keep_days: Option<u32>,
    /// Waiting jobs of a large sweep beyond which no more of it are queued; the others follow while these are solved.
    #[arg(long, env = "FRETWEAR_JOBS_AHEAD", default_value_t = JOBS_AHEAD, value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) jobs_ahead: u64,
}

/// Options of `work`.
#[derive(Debug, Args)]
pub(super) struct SolveOptions {
    /// Number of jobs solved at once; one per processor unless given.
    #[arg(long, env = "FRETWEAR_SLOTS", value_parser = clap::value_parser!(u16).range(1..=256))]
    slots: Option<u16>,
    /// Threads of a solve that runs alone; of several each has its part, one at least; one per processor unless given.
    #[arg(long, env = "FRETWEAR_THREADS", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// Limit of the estimated memory of all solves; four fifths of the machine's memory unless given.
    #[arg(long, env = "FRETWEAR_MEMORY_MB", value_parser = clap::value_parser!(i64).range(1..))]
    memory_mb: Option<i64>,
    /// Memory limit of one solve; four times the estimate of its plan, and at least 1024, unless given.
    #[arg(long, env = "FRETWEAR_JOB_MEMORY_MB", value_parser = clap::value_parser!(i64).range(1..))]
    job_memory_mb: Option<i64>,
    /// Time without contact to the service after which it gives the jobs of this worker to others.
    #[arg(long, env = "FRETWEAR_LEASE_S", default_value = "30", value_parser = seconds)]
    lease_s: Duration,
    /// Interval of the checkpoints of a solve.
    #[arg(long, env = "FRETWEAR_CHECKPOINT_EVERY_S", default_value = "30", value_parser = seconds)]
    checkpoint_every_s: Duration,
    /// Time that a solve has for its last checkpoint when the worker stops.
    #[arg(long, env = "FRETWEAR_GRACE_S", default_value = "30", value_parser = seconds)]
    grace_s: Duration,
    /// End when no job waits or runs at the service.
    #[arg(long, env = "FRETWEAR_UNTIL_IDLE")]
    until_idle: bool,
}

impl SolveOptions {
    /// Number of jobs solved at once.
    pub(super) fn slots(&self) -> usize {
        crate::cli::runtime::or_processors(self.slots)
    }

    /// How long a request waits for a job: not long where the worker is to end without one.
    pub(super) fn wait(&self) -> Duration {
        if self.until_idle {
            Duration::from_millis(500)
        } else {
            LONGEST_WAIT
        }
    }

    /// Configuration of the workers for a program.
    pub(super) fn config(&self, program: PathBuf) -> WorkerConfig {
        let config = WorkerConfig::new(program);
        WorkerConfig {
            lease: self.lease_s.max(Duration::from_secs(1)),
            update_every: REMOTE_UPDATE_EVERY,
            ahead: REMOTE_AHEAD,
            until_idle: self.until_idle,
            checkpoint_every: self.checkpoint_every_s,
            threads: crate::cli::runtime::or_processors(self.threads),
            grace: self.grace_s,
            memory_mb: self.memory_mb.unwrap_or(config.memory_mb),
            job_memory_mb: self.job_memory_mb,
            ..config
        }
    }
}

impl WorkOptions {
    /// Number of jobs solved at once.
    pub(super) fn workers(&self) -> usize {
        crate::cli::runtime::or_processors(self.workers)
    }

    /// Limits of the store.
    pub(super) fn limits(&self) -> Limits {
        Limits {
            attempts: self.attempts,
            least_free_disk_mb: self.least_free_disk_mb,
        }
    }

    /// Configuration of the workers for a program.
    pub(super) fn config(&self, program: PathBuf) -> WorkerConfig {
        let config = WorkerConfig::new(program);
        WorkerConfig {
            lease: self.lease_s.max(Duration::from_millis(100)),
            checkpoint_every: self.checkpoint_every_s,
            threads: crate::cli::runtime::or_processors(self.threads),
            grace: self.grace_s,
            memory_mb: self.memory_mb.unwrap_or(config.memory_mb),
            job_memory_mb: self.job_memory_mb,
            ..config
        }
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text
        .parse()
        .map_err(|_| format!("`{text}` is not a number of seconds"))?;
    Duration::try_from_secs_f64(seconds)
        .map_err(|_| format!("`{text}` is not a number of seconds from 0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_may_have_a_fraction_but_no_sign() {
        assert_eq!(seconds("0.25"), Ok(Duration::from_millis(250)));
        for text in ["-1", "soon", "NaN", "1e400"] {
            assert!(seconds(text).is_err(), "{text}");
        }
    }
}
