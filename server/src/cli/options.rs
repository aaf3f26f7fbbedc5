//! Options of `serve` that say how jobs are worked on; each can be given in the environment too.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use crate::queue::ATTEMPT_LIMIT;
use crate::worker::Rules;

/// How jobs are worked on.
#[derive(Debug, Args)]
pub(super) struct WorkOptions {
    /// Jobs solved at once; one a processor unless named.
    #[arg(long, env = "FRETWEAR_WORKERS", value_parser = clap::value_parser!(u16).range(1..=256))]
    workers: Option<u16>,
    /// How often a job is tried whose workers are lost.
    #[arg(long, env = "FRETWEAR_ATTEMPTS", default_value_t = ATTEMPT_LIMIT, value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) attempts: u32,
    /// How long a worker that gives no sign keeps its job.
    #[arg(long, env = "FRETWEAR_LEASE_S", default_value = "10", value_parser = seconds)]
    lease_s: Duration,
    /// How often a solve stores from where it could go on; 0 for after every computed cycle.
    #[arg(long, env = "FRETWEAR_CHECKPOINT_EVERY_S", default_value = "5", value_parser = seconds)]
    checkpoint_every_s: Duration,
    /// How long a solve has for its last checkpoint when the service stops.
    #[arg(long, env = "FRETWEAR_GRACE_S", default_value = "5", value_parser = seconds)]
    grace_s: Duration,
    /// What running jobs may be expected to need together; four fifths of the machine's memory unless named.
    #[arg(long, env = "FRETWEAR_MEMORY_MB", value_parser = clap::value_parser!(i64).range(1..))]
    memory_mb: Option<i64>,
    /// What one solve may take; four times what its plan expects, and at least 1024, unless named.
    #[arg(long, env = "FRETWEAR_JOB_MEMORY_MB", value_parser = clap::value_parser!(i64).range(1..))]
    job_memory_mb: Option<i64>,
    /// No job is begun while the disk of the database has less than this left.
    #[arg(long, env = "FRETWEAR_LEAST_FREE_DISK_MB", default_value_t = 256)]
    least_free_disk_mb: u64,
    /// Delete jobs so many days after their end; kept for ever unless named.
    #[arg(long, env = "FRETWEAR_KEEP_DAYS")]
    pub(super) keep_days: Option<u32>,
}

impl WorkOptions {
    /// How many jobs are solved at once.
    pub(super) fn workers(&self) -> usize {
        super::workers(self.workers)
    }

    /// The rules for a program that keeps its database here.
    pub(super) fn rules(&self, program: PathBuf, database: &str) -> Rules {
        let rules = Rules::new(program, folder(database));
        Rules {
            lease: self.lease_s.max(Duration::from_millis(100)),
            checkpoint_every: self.checkpoint_every_s,
            grace: self.grace_s,
            memory_mb: self.memory_mb.unwrap_or(rules.memory_mb),
            job_memory_mb: self.job_memory_mb,
            least_free_disk_mb: self.least_free_disk_mb,
            ..rules
        }
    }
}

/// The folder of a database.
pub(super) fn folder(database: &str) -> PathBuf {
    let path = Path::new(
        database
            .trim_start_matches("sqlite:")
            .trim_start_matches("//"),
    );
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
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

    #[test]
    fn the_folder_of_a_database_is_found_in_its_address() {
        assert_eq!(folder("sqlite://fretwear.db"), Path::new("."));
        assert_eq!(folder("sqlite:///data/fretwear.db"), Path::new("/data"));
        assert_eq!(folder("sqlite:a/b.db"), Path::new("a"));
    }
}
