//! Foreseen course of a solve: how its work is spread over its cycles, and what may follow the first run.

use solver::error_control::may_restart;
use solver::forecast::Course;

use crate::estimate::workload;
use crate::spec;

/// Least share of a run that is left before it stops by itself: that cycle is foreseen with an error.
const LEAST_LEFT: f64 = 0.2;

/// Foreseen course of a solve.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Foreseen {
    course: Course,
    /// Whether the run is expected to stop before its last cycle.
    pub(crate) stops: bool,
    /// Whether companions follow.
    pub(crate) estimates_errors: bool,
    /// Whether a finer run may follow.
    pub(crate) may_restart: bool,
}

impl Foreseen {
    /// That of a resolved specification; of one that cannot be read nothing is foreseen.
    pub(crate) fn of(specification: &str) -> Self {
        let Ok(resolved) = spec::read(specification.as_bytes()) else {
            return Self::default();
        };
        let (course, scene) = (workload::course(&resolved), &resolved.scene);
        Self {
            stops: course.end() < scene.cycles,
            course,
            estimates_errors: scene.accuracy.estimate_errors,
            may_restart: may_restart(scene),
        }
    }

    /// Physical cycles at the end of the run.
    #[cfg(test)]
    pub(crate) fn end(&self) -> u64 {
        self.course.end()
    }

    /// The share of a run that is done at a cycle.
    pub(crate) fn share(&self, cycle: u64) -> f64 {
        self.course.share(cycle)
    }

    /// The share of a run that is left at a cycle.
    pub(crate) fn left(&self, cycle: u64) -> f64 {
        let least = if self.stops { LEAST_LEFT } else { 0.0 };
        (1.0 - self.share(cycle)).max(least)
    }
}
