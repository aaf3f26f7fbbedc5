//! Admission: the first waiting job in order that fits into the free memory is claimed next.
//!
//! Smaller jobs may overtake a large one that does not fit, for a limited time; then no job overtakes it, so that
//! enough memory becomes free. The only worker admits a job that would run alone whatever its estimate. One of several workers leaves
//! a job that is larger than all its memory to others, and such a job does not keep it from the next ones.

use serde::{Deserialize, Serialize};

/// Time during which other jobs may overtake one that does not fit, ms.
const OVERTAKING_LIMIT_MS: i64 = 600_000;

/// A waiting job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WaitingJob {
    /// Estimated peak memory, MB.
    pub memory_mb: i64,
    /// When it was submitted, ms.
    pub since: i64,
    /// Estimated processor time, ms; 0 where it is not known.
    pub cpu_ms: i64,
}

/// Memory of solving processes, and the part of it that is in use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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

    /// Why a job waits that does not fit into it, for its user.
    pub fn reason_to_wait(&self, job: &WaitingJob) -> String {
        format!(
            "waiting for memory: it needs about {} MB, {} of {} MB are left",
            job.memory_mb,
            self.free_mb(),
            self.memory_mb
        )
    }

    fn admits(&self, job: &WaitingJob) -> bool {
        self.running == 0 || job.memory_mb <= self.free_mb()
    }
}

/// Free capacity of a worker.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capacity {
    /// Number of solves that can be started.
    pub slots: usize,
    /// Memory of the worker.
    pub memory: MemoryBudget,
    /// True if other workers may have more memory.
    pub is_one_of_several: bool,
    /// Processor time for each slot up to which jobs below that length are admitted ahead, ms; 0 for none.
    pub ahead_ms: i64,
}

/// Which jobs are admitted, and which ones before them wait for memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Admission {
    /// Indices of the admitted jobs.
    pub admitted: Vec<usize>,
    /// Indices of the jobs that do not fit.
    pub too_large: Vec<usize>,
}

/// Chooses among jobs in the order of the queue: one for each slot as far as memory is left, then short ones that follow, which are
/// solved after them, so that a worker far away asks less often.
pub fn admit(waiting: &[WaitingJob], capacity: &Capacity, now: i64) -> Admission {
    let (mut budget, mut claimed_ms) = (capacity.memory, 0_i64);
    let slots = i64::try_from(capacity.slots).unwrap_or(i64::MAX);
    let ahead_ms = capacity.ahead_ms.saturating_mul(slots);
    let mut admission = Admission::default();
    for (index, job) in waiting.iter().enumerate() {
        if admission.admitted.len() >= capacity.slots {
            let is_short = 0 < job.cpu_ms && job.cpu_ms < capacity.ahead_ms;
            let ends_in_time = claimed_ms.saturating_add(job.cpu_ms) <= ahead_ms;
            if !is_short || !ends_in_time || job.memory_mb > budget.memory_mb {
                break;
            }
        } else if capacity.is_one_of_several && job.memory_mb > budget.memory_mb {
            admission.too_large.push(index);
            continue;
        } else if !budget.admits(job) {
            admission.too_large.push(index);
            if now.saturating_sub(job.since) > OVERTAKING_LIMIT_MS {
                break;
            }
            continue;
        }
        // A job of unknown length is taken for a long one.
        let length_ms = if job.cpu_ms > 0 { job.cpu_ms } else { ahead_ms };
        claimed_ms = claimed_ms.saturating_add(length_ms);
        budget.used_mb = budget.used_mb.saturating_add(job.memory_mb);
        budget.running = budget.running.saturating_add(1);
        admission.admitted.push(index);
    }
    admission
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(memory_mb: i64, since: i64) -> WaitingJob {
        WaitingJob {
            memory_mb,
            since,
            cpu_ms: 0,
        }
    }

    fn one_slot(used_mb: i64, running: i64) -> Capacity {
        Capacity {
            slots: 1,
            memory: MemoryBudget {
                memory_mb: 1_000,
                used_mb,
                running,
            },
            is_one_of_several: false,
            ahead_ms: 0,
        }
    }

    #[test]
    fn the_first_job_that_fits_is_admitted() {
        let waiting = [job(900, 0), job(100, 0), job(50, 0)];
        let admission = admit(&waiting, &one_slot(500, 1), 1);
        assert_eq!(
            (admission.admitted, admission.too_large),
            (vec![1], vec![0])
        );
        assert_eq!(admit(&waiting, &one_slot(100, 1), 1).admitted, [0]);
        assert_eq!(admit(&[], &one_slot(0, 0), 1), Admission::default());
    }

    #[test]
    fn a_large_job_is_not_overtaken_after_the_time_limit() {
        let waiting = [job(900, 0), job(100, 0)];
        let admitted = |now| admit(&waiting, &one_slot(500, 1), now).admitted;
        assert_eq!(admitted(OVERTAKING_LIMIT_MS), [1]);
        assert!(admitted(OVERTAKING_LIMIT_MS + 1).is_empty());
    }

    #[test]
    fn a_job_larger_than_all_memory_runs_alone() {
        let waiting = [job(5_000, 0), job(1, 0)];
        assert_eq!(admit(&waiting, &one_slot(0, 0), 0).admitted, [0]);
        assert!(
            admit(&waiting[..1], &one_slot(10, 1), 0)
                .admitted
                .is_empty()
        );
        let two = Capacity {
            slots: 2,
            ..one_slot(0, 0)
        };
        assert_eq!(admit(&waiting, &two, 0).admitted, [0]);
    }

    #[test]
    fn one_of_several_workers_leaves_a_job_larger_than_its_memory_to_others() {
        let waiting = [job(1_001, 0), job(900, 0)];
        let one = Capacity {
            is_one_of_several: true,
            ..one_slot(0, 0)
        };
        let admission = admit(&waiting, &one, OVERTAKING_LIMIT_MS + 1);
        assert_eq!(
            (admission.admitted, admission.too_large),
            (vec![1], vec![0])
        );
    }

    #[test]
    fn every_slot_gets_a_job_as_far_as_memory_is_left() {
        let waiting = [job(400, 0), job(700, 0), job(400, 0), job(100, 0)];
        let four = Capacity {
            slots: 4,
            ..one_slot(0, 0)
        };
        let admission = admit(&waiting, &four, 0);
        assert_eq!(
            (admission.admitted, admission.too_large),
            (vec![0, 2, 3], vec![1])
        );
    }

    #[test]
    fn short_jobs_are_claimed_ahead_up_to_a_time_and_in_order() {
        let short = WaitingJob {
            cpu_ms: 900,
            ..job(100, 0)
        };
        let long = WaitingJob {
            cpu_ms: 60_000,
            ..short
        };
        let ahead = Capacity {
            ahead_ms: 5_000,
            ..one_slot(0, 0)
        };
        let count = |waiting: &[WaitingJob]| admit(waiting, &ahead, 0).admitted.len();
        assert_eq!(count(&[short; 20]), 5, "4.5 of 5 s");
        assert_eq!(count(&[short, short, long, short]), 2, "in order");
        assert_eq!(count(&[long, short]), 1);
        assert_eq!(count(&[job(1, 0), short]), 1, "of unknown length");
        let large = WaitingJob {
            memory_mb: 1_001,
            ..short
        };
        assert_eq!(count(&[short, large]), 1);
        assert_eq!(admit(&[short; 20], &one_slot(0, 0), 0).admitted.len(), 1);
    }
}
