//! Time that a solve still takes, from its speed so far.
//!
//! The work of a run is not even over its cycles: jumps grow, and a run to the base metal ends far before its last cycle. The share of it
//! that is done at a cycle is that of the forecast; of a finer run that of the run before it, which is measured.

use crate::estimate::expected_time::{COMPANIONS, ExpectedTime, MOST_OF_RUN, RESTART, WIDEST};
use crate::estimate::foreseen::Foreseen;

/// Stage of a solve, with the seconds since its start at which it began.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Running {
    First {
        since_s: f64,
    },
    Companions {
        since_s: f64,
    },
    /// Of the same scene again, mostly on finer settings.
    Again {
        since_s: f64,
    },
}

impl Default for Running {
    fn default() -> Self {
        Self::First { since_s: 0.0 }
    }
}

/// Clock of a solve: cycles of its runs, and the seconds since its start at which they were computed.
#[derive(Debug, Default)]
pub(super) struct RemainingTime {
    foreseen: Foreseen,
    from_cycle: u64,
    running: Running,
    /// Cycles of the first run in their order; none of a solve that is resumed behind it.
    first: Vec<Computed>,
    now: Option<Computed>,
}

/// A computed cycle, and when it was.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Computed {
    cycle: u64,
    at_s: f64,
}

impl RemainingTime {
    /// The clock of a solve that starts after a cycle.
    pub(super) fn new(foreseen: Foreseen, from_cycle: u64) -> Self {
        Self {
            foreseen,
            from_cycle,
            ..Self::default()
        }
    }

    /// Begins again at cycle 0: on finer settings, or from a checkpoint that cannot be used.
    pub(super) fn again(&mut self, since_s: f64) {
        self.from_cycle = 0;
        self.now = None;
        self.running = if self.first.is_empty() {
            Running::First { since_s }
        } else {
            Running::Again { since_s }
        };
    }

    /// Notes a computed cycle.
    pub(super) fn computed(&mut self, cycle: u64, at_s: f64) {
        let computed = Computed { cycle, at_s };
        if let (Running::First { .. }, 0) = (self.running, self.from_cycle) {
            self.first.push(computed);
        }
        self.now = Some(computed);
    }

    /// Notes that the companions are solved, or are waited for.
    pub(super) fn companions(&mut self, since_s: f64) {
        if let Running::First { .. } = self.running {
            self.running = Running::Companions { since_s };
        }
    }

    /// The time that is left at some seconds after the start; none before anything is known of it.
    pub(super) fn remaining(&self, at_s: f64) -> Option<ExpectedTime> {
        let ExpectedTime { likely_s, most_s } = match self.running {
            Running::First { since_s } => self.of_first(at_s - since_s)?,
            Running::Companions { since_s } => self.of_companions(at_s, since_s)?,
            Running::Again { since_s } => self.of_run_again(at_s - since_s)?,
        };
        Some(ExpectedTime {
            likely_s: likely_s.max(most_s / WIDEST),
            most_s,
        })
    }

    fn of_first(&self, taken_s: f64) -> Option<ExpectedTime> {
        let run = self.foreseen_run(taken_s)?;
        let companions = self.of_all_companions(run.whole_s);
        Some(ExpectedTime {
            likely_s: run.left_s + companions,
            most_s: MOST_OF_RUN * (run.left_s + companions) + self.of_restart(run.whole_s),
        })
    }

    fn of_companions(&self, at_s: f64, since_s: f64) -> Option<ExpectedTime> {
        let first_s = self.first.last()?.at_s;
        let left = (self.of_all_companions(first_s) - (at_s - since_s)).max(0.0);
        Some(ExpectedTime {
            likely_s: left,
            most_s: MOST_OF_RUN * left + self.of_restart(first_s),
        })
    }

    fn of_run_again(&self, taken_s: f64) -> Option<ExpectedTime> {
        let run = match self.share_of_first(self.now?.cycle) {
            Some(done) => Run::of(taken_s, done, 1.0 - done)?,
            None => self.foreseen_run(taken_s)?,
        };
        Some(ExpectedTime {
            likely_s: run.left_s,
            most_s: MOST_OF_RUN * run.left_s,
        })
    }

    /// A run that has taken so many seconds, by its foreseen course.
    fn foreseen_run(&self, taken_s: f64) -> Option<Run> {
        let cycle = self.now?.cycle;
        let done = self.foreseen.share(cycle) - self.foreseen.share(self.from_cycle);
        Run::of(taken_s, done, self.foreseen.left(cycle))
    }

    /// Expected seconds of the companions of a first run of so many.
    fn of_all_companions(&self, first_s: f64) -> f64 {
        if self.foreseen.estimates_errors {
            COMPANIONS * first_s
        } else {
            0.0
        }
    }

    /// Seconds that a finer run takes at most after a first run of so many.
    fn of_restart(&self, first_s: f64) -> f64 {
        if self.foreseen.may_restart {
            RESTART * first_s
        } else {
            0.0
        }
    }

    /// The share of the time of the first run that it had taken at a cycle.
    fn share_of_first(&self, cycle: u64) -> Option<f64> {
        let last = self.first.last()?;
        let behind = self
            .first
            .partition_point(|computed| computed.cycle <= cycle);
        let at = self.first.get(behind.checked_sub(1)?)?;
        Some(at.at_s / last.at_s.max(f64::MIN_POSITIVE))
    }
}

/// Time of a run, s.
struct Run {
    whole_s: f64,
    left_s: f64,
}

impl Run {
    /// A run that has taken so many seconds for a share of its work, and has another one left.
    fn of(taken_s: f64, done: f64, left: f64) -> Option<Self> {
        let whole_s = taken_s / done;
        (done > 0.0).then_some(Self {
            whole_s,
            left_s: left * whole_s,
        })
    }
}

#[cfg(test)]
mod tests;
