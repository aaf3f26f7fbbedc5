//! Placement: how many remote workers a service has work for, and the engines that start them. A worker ends by itself when nothing waits
//! or runs, so only starts are decided here. Knows neither jobs nor the store.

pub mod slurm;
pub mod submissions;

use std::time::Duration;

use api::service::Demand;

/// Processor seconds that a worker should have to do before another one is started: starting one takes seconds. Arbitrary.
const WORTH_STARTING_S: u64 = 60;

/// Longest wait before workers are started again that have ended without a job. Arbitrary.
const LONGEST_WAIT: Duration = Duration::from_mins(10);

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

/// When workers may be started again: those that fail, as without a readable token or on nodes that cannot reach the service, are started
/// less and less often.
#[derive(Debug)]
pub struct Backoff {
    /// Time between two looks.
    every: Duration,
    /// Workers of the last start, and those that have failed since.
    started: u64,
    failed: u64,
    /// Starts, one after the other, of which at least half of the workers have failed.
    fruitless: u32,
    /// Time until the next start.
    left: Duration,
}

impl Backoff {
    /// Of a pilot that looks at intervals.
    pub fn new(every: Duration) -> Self {
        Self {
            every,
            started: 0,
            failed: 0,
            fruitless: 0,
            left: Duration::ZERO,
        }
    }

    /// Notes the workers that have failed since the last look; returns how long no others are started.
    pub fn observe(&mut self, failed: u64) -> Duration {
        self.left = self.left.saturating_sub(self.every);
        let had_failed = self.has_failed();
        self.failed += failed;
        if self.has_failed() && !had_failed {
            self.fruitless += 1;
            let pause = self.every.saturating_mul(1 << self.fruitless.min(16));
            self.left = pause.min(LONGEST_WAIT);
        }
        self.left
    }

    /// Notes a start of so many workers.
    pub fn started(&mut self, workers: u64) {
        if !self.has_failed() {
            self.fruitless = 0;
        }
        (self.started, self.failed) = (workers, 0);
    }

    /// Number of starts, one after the other, whose workers have failed.
    pub fn fruitless(&self) -> u32 {
        self.fruitless
    }

    fn has_failed(&self) -> bool {
        self.started > 0 && 2 * self.failed >= self.started
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The looks at which workers are started, of which so many fail by the next look.
    fn starts(workers: u64, failing: u64) -> Vec<u64> {
        let mut backoff = Backoff::new(Duration::from_secs(15));
        let (mut starts, mut failed) = (Vec::new(), 0);
        for look in 0..400 {
            if backoff.observe(std::mem::take(&mut failed)).is_zero() {
                backoff.started(workers);
                starts.push(look);
                failed = failing;
            }
        }
        starts
    }

    #[test]
    fn workers_that_fail_are_started_less_and_less_often() {
        for failing in [25, 49, 50] {
            let starts = starts(50, failing);
            assert_eq!(starts[..6], [0, 3, 8, 17, 34, 67]);
            // After ten minutes in the end.
            let last = starts.windows(2).last().expect("some");
            assert_eq!(last[1] - last[0], 41);
        }
        // A node that fails now and then holds nothing up.
        assert_eq!(starts(50, 10).len(), 400);
    }

    #[test]
    fn a_start_that_did_not_fail_ends_the_pauses() {
        let mut backoff = Backoff::new(Duration::from_secs(15));
        for _ in 0..3 {
            backoff.started(4);
            backoff.observe(4);
        }
        assert_eq!(backoff.fruitless(), 3);
        backoff.started(4);
        backoff.observe(1);
        backoff.started(4);
        assert_eq!(backoff.fruitless(), 0);
        assert_eq!(backoff.observe(4), Duration::from_secs(30));
    }

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
