//! Placement: how many remote workers a service has work for, and the engines that start them. A worker ends by itself when nothing waits
//! or runs, so only starts are decided here. Knows neither jobs nor the store.

pub mod slurm;

use api::service::Demand;

/// Processor seconds that a worker should have to do before another one is started: starting one takes seconds. Arbitrary.
const WORTH_STARTING_S: u64 = 60;

/// The workers that may be started.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fleet {
    /// Most workers at a time.
    pub most: u64,
    /// Jobs that each solves at once.
    pub slots: u64,
}

impl Fleet {
    /// Number of workers that a demand is enough for: those of the jobs that remote workers solve, and for what waits as many as have a minute of work for each
    /// slot, but no more than there are jobs.
    pub fn wanted(self, demand: &Demand) -> u64 {
        let slots = self.slots.max(1);
        let by_jobs = demand.queued.div_ceil(slots);
        let by_time = demand.queued_cpu_s.div_ceil(WORTH_STARTING_S * slots);
        let running = demand.running_remotely.div_ceil(slots);
        (running + by_jobs.min(by_time)).min(self.most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workers_are_wanted_for_a_minute_of_work_and_no_more_than_there_are_jobs() {
        let fleet = Fleet { most: 50, slots: 4 };
        for ((queued, running_remotely, queued_cpu_s), wanted) in [
            ((0, 0, 0), 0),
            // One short job.
            ((1, 0, 1), 1),
            // 100 jobs of a second: one worker has done them before another has started.
            ((100, 0, 100), 1),
            // 100 jobs of an hour, and as many as there may be.
            ((100, 0, 360_000), 25),
            ((1_000, 0, 3_600_000), 50),
            // Running jobs have their workers.
            ((0, 9, 0), 3),
            ((4, 8, 600), 3),
        ] {
            let demand = Demand {
                queued,
                // The service solves some itself.
                running: running_remotely + 8,
                running_remotely,
                queued_cpu_s,
            };
            assert_eq!(fleet.wanted(&demand), wanted, "{demand:?}");
        }
    }
}
