//! Admission: the first waiting job in order that fits into the free memory is claimed next.
//!
//! Smaller jobs may overtake a large one that does not fit, for a limited time; then no job overtakes it, so that
//! enough memory becomes free. A job that would run alone is always admitted, whatever its estimate.

/// Time during which other jobs may overtake one that does not fit, ms.
const OVERTAKING_LIMIT_MS: i64 = 600_000;

/// A waiting job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WaitingJob {
    /// Estimated peak memory, MB.
    pub memory_mb: i64,
    /// When it was submitted, ms.
    pub since: i64,
}

/// Memory of solving processes, and what the running ones use of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryBudget {
    /// Memory of all solving processes together, MB.
    pub memory_mb: i64,
    /// Estimated peak memory of the running ones, MB.
    pub used_mb: i64,
    /// Number of running jobs.
    pub running: i64,
}

impl MemoryBudget {
    /// Free memory, MB.
    pub fn free_mb(&self) -> i64 {
        self.memory_mb.saturating_sub(self.used_mb).max(0)
    }

    fn admits(&self, job: &WaitingJob) -> bool {
        self.running == 0 || job.memory_mb <= self.free_mb()
    }
}

/// Which job is admitted, and which ones before it wait for memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Admission {
    /// Index of the admitted job.
    pub admitted: Option<usize>,
    /// Indices of the jobs that do not fit.
    pub too_large: Vec<usize>,
}

/// Chooses among jobs in the order of the queue.
pub fn admit(waiting: &[WaitingJob], budget: &MemoryBudget, now: i64) -> Admission {
    let mut too_large = Vec::new();
    for (index, job) in waiting.iter().enumerate() {
        if budget.admits(job) {
            return Admission {
                admitted: Some(index),
                too_large,
            };
        }
        too_large.push(index);
        if now.saturating_sub(job.since) > OVERTAKING_LIMIT_MS {
            break;
        }
    }
    Admission {
        admitted: None,
        too_large,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(memory_mb: i64, since: i64) -> WaitingJob {
        WaitingJob { memory_mb, since }
    }

    fn budget(used_mb: i64, running: i64) -> MemoryBudget {
        MemoryBudget {
            memory_mb: 1_000,
            used_mb,
            running,
        }
    }

    #[test]
    fn the_first_job_that_fits_is_admitted() {
        let waiting = [job(900, 0), job(100, 0), job(50, 0)];
        let admission = admit(&waiting, &budget(500, 1), 1);
        assert_eq!(
            (admission.admitted, admission.too_large),
            (Some(1), vec![0])
        );
        assert_eq!(admit(&waiting, &budget(100, 1), 1).admitted, Some(0));
        assert_eq!(admit(&[], &budget(0, 0), 1).admitted, None);
    }

    #[test]
    fn a_large_job_is_not_overtaken_after_the_time_limit() {
        let waiting = [job(900, 0), job(100, 0)];
        assert_eq!(
            admit(&waiting, &budget(500, 1), OVERTAKING_LIMIT_MS).admitted,
            Some(1)
        );
        assert_eq!(
            admit(&waiting, &budget(500, 1), OVERTAKING_LIMIT_MS + 1).admitted,
            None
        );
    }

    #[test]
    fn a_job_larger_than_all_memory_runs_alone() {
        let waiting = [job(5_000, 0)];
        assert_eq!(admit(&waiting, &budget(0, 0), 0).admitted, Some(0));
        assert_eq!(admit(&waiting, &budget(10, 1), 0).admitted, None);
    }
}
