//! Foreseen course of a solve: how its work is spread over its cycles, and what may follow the first run.

use solver::error_control::may_restart;
use solver::forecast::{Course, forecast, line_forecast, point_forecast};
use solver::model::Layout;
use solver::scene::Scene;

use crate::spec::{self, Resolved};

/// Least share of a run that is left before it stops by itself: that cycle is foreseen with an error.
const LEAST_LEFT: f64 = 0.2;

/// Foreseen course of a solve.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Foreseen {
    course: Course,
    /// The run is expected to stop before the last cycle.
    pub(crate) stops: bool,
    /// Companions follow.
    pub(crate) estimates_errors: bool,
    /// A finer run may follow.
    pub(crate) may_restart: bool,
}

impl Foreseen {
    /// The course of a resolved specification; of one that cannot be read nothing is foreseen.
    pub(crate) fn of(specification: &str) -> Self {
        let Ok(Resolved { scene, layout, .. }) = spec::read(specification.as_bytes()) else {
            return Self::default();
        };
        let course = course(&scene, layout.as_ref());
        Self {
            stops: course.end() < scene.cycles,
            course,
            estimates_errors: scene.accuracy.estimate_errors,
            may_restart: may_restart(&scene),
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

/// The course of a run of a scene, which has meshes unless it is a point contact.
fn course(scene: &Scene, layout: Option<&Layout>) -> Course {
    let Some(layout) = layout else {
        return point_forecast(scene).unwrap_or_default().course;
    };
    match line_forecast(scene, layout) {
        Some(line) => line.course,
        None => forecast(scene, layout).course(),
    }
}
