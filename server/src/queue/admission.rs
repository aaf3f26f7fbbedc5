//! Which waiting job is taken next: the first in order that fits into the memory that is left.
//!
//! A large job that does not fit lets smaller ones pass, but only for a while: then nothing overtakes it, so that enough
//! memory becomes free. Alone, every job is admitted: an estimate is not worth a job that never runs.

/// How long a job lets others pass because it does not fit, ms.
const PATIENCE_MS: i64 = 600_000;

/// A job that waits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Waiting {
    /// What it is expected to need, MB.
    pub memory_mb: i64,
    /// Since when, ms.
    pub since: i64,
}

/// What running jobs leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Room {
    /// Memory for all solving processes together, MB.
    pub memory_mb: i64,
    /// What the running ones are expected to need, MB.
    pub used_mb: i64,
    /// How many run.
    pub running: i64,
}

impl Room {
    /// Memory that is left, MB.
    pub fn left_mb(&self) -> i64 {
        self.memory_mb.saturating_sub(self.used_mb).max(0)
    }

    fn admits(&self, job: &Waiting) -> bool {
        self.running == 0 || job.memory_mb <= self.left_mb()
    }
}

/// Which job is taken, and which ones in front of it wait for memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choice {
    /// Its index.
    pub taken: Option<usize>,
    /// Indices of those that do not fit.
    pub too_large: Vec<usize>,
}

/// Chooses among jobs in the order of the queue.
pub fn choose(waiting: &[Waiting], room: &Room, now: i64) -> Choice {
    let mut too_large = Vec::new();
    for (index, job) in waiting.iter().enumerate() {
        if room.admits(job) {
            return Choice {
                taken: Some(index),
                too_large,
            };
        }
        too_large.push(index);
        if now.saturating_sub(job.since) > PATIENCE_MS {
            break;
        }
    }
    Choice {
        taken: None,
        too_large,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(memory_mb: i64, since: i64) -> Waiting {
        Waiting { memory_mb, since }
    }

    fn room(used_mb: i64, running: i64) -> Room {
        Room {
            memory_mb: 1_000,
            used_mb,
            running,
        }
    }

    #[test]
    fn the_first_that_fits_is_taken() {
        let waiting = [job(900, 0), job(100, 0), job(50, 0)];
        let choice = choose(&waiting, &room(500, 1), 1);
        assert_eq!((choice.taken, choice.too_large), (Some(1), vec![0]));
        assert_eq!(choose(&waiting, &room(100, 1), 1).taken, Some(0));
        assert_eq!(choose(&[], &room(0, 0), 1).taken, None);
    }

    #[test]
    fn a_large_job_that_has_waited_is_not_overtaken_any_more() {
        let waiting = [job(900, 0), job(100, 0)];
        assert_eq!(choose(&waiting, &room(500, 1), PATIENCE_MS).taken, Some(1));
        assert_eq!(choose(&waiting, &room(500, 1), PATIENCE_MS + 1).taken, None);
    }

    #[test]
    fn a_job_beyond_all_memory_runs_alone() {
        let waiting = [job(5_000, 0)];
        assert_eq!(choose(&waiting, &room(0, 0), 0).taken, Some(0));
        assert_eq!(choose(&waiting, &room(10, 1), 0).taken, None);
    }
}
