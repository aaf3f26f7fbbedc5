//! Placement: how many remote workers a service has work for, and the engines that start them. A worker ends by itself when nothing waits
//! or runs, so only starts are decided here. Knows neither jobs nor the store.

pub mod slurm;

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

/// When workers may be started again. Those that end at once, as without a readable token or on nodes that cannot reach the service, are
/// started less and less often.
#[derive(Debug)]
pub struct Pace {
    every: Duration,
    /// Starts, one after the other, that brought no job to its end and no worker that solves one.
    fruitless: u32,
    /// Jobs that waited at the last start.
    waiting: Option<u64>,
    /// Time since then.
    since: Duration,
}

impl Pace {
    /// Of a pilot that looks at the demand at intervals.
    pub fn new(every: Duration) -> Self {
        Self {
            every,
            fruitless: 0,
            waiting: None,
            since: Duration::ZERO,
        }
    }

    /// Notes the demand at the next look; returns how long no workers are started yet.
    pub fn wait(&mut self, demand: &Demand) -> Duration {
        self.since += self.every;
        let Some(waiting) = self.waiting else {
            return Duration::ZERO;
        };
        if demand.running_remotely > 0 || demand.queued < waiting {
            self.fruitless = 0;
            return Duration::ZERO;
        }
        let pause = self.every.saturating_mul(1 << self.fruitless.min(16));
        pause.min(LONGEST_WAIT).saturating_sub(self.since)
    }

    /// Notes a start, and whether there were no workers any more.
    pub fn started(&mut self, demand: &Demand, none_left: bool) {
        if none_left && self.waiting.is_some() {
            self.fruitless += 1;
        }
        (self.waiting, self.since) = (Some(demand.queued), Duration::ZERO);
    }

    /// Number of starts, one after the other, whose workers have solved nothing.
    pub fn fruitless(&self) -> u32 {
        self.fruitless
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn demand(queued: u64, running_remotely: u64) -> Demand {
        Demand {
            queued,
            running: running_remotely,
            running_remotely,
            queued_cpu_s: 60 * queued,
        }
    }

    #[test]
    fn workers_that_end_at_once_are_started_less_and_less_often() {
        let mut pace = Pace::new(Duration::from_secs(15));
        let mut starts = Vec::new();
        for look in 0..400_u64 {
            let demand = demand(10, 0);
            if pace.wait(&demand).is_zero() {
                pace.started(&demand, true);
                starts.push(look);
            }
        }
        assert_eq!(starts[..6], [0, 1, 3, 7, 15, 31]);
        // Every ten minutes in the end.
        let last = starts.windows(2).last().expect("some");
        assert_eq!(last[1] - last[0], 40);
    }

    #[test]
    fn workers_that_solve_are_followed_by_others_at_once() {
        let mut pace = Pace::new(Duration::from_secs(15));
        for _ in 0..5 {
            pace.started(&demand(10, 0), true);
        }
        assert!(!pace.wait(&demand(10, 0)).is_zero());
        assert!(pace.wait(&demand(10, 1)).is_zero());
        pace.started(&demand(9, 0), true);
        // A job has been taken.
        assert!(pace.wait(&demand(8, 0)).is_zero());
        assert_eq!(pace.fruitless(), 0);
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
