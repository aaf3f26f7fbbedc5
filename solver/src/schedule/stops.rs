//! Cycles that a run must hit exactly, and conditions that end it.

use serde::{Deserialize, Serialize};

use crate::number::cycles_at_least;
use crate::scene::{Scene, StopCondition};

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// All cycles were done.
    Completed,
    /// All cycles were done, but the estimated error of depth or area exceeds the tolerance.
    OutsideTolerance,
    /// A stop condition was met.
    StopCondition,
    /// A body was nearly consumed.
    WornThrough,
    /// The observer asked to stop.
    Stopped,
}

/// What stops depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Progress {
    /// Physical cycles done.
    pub(crate) cycle: u64,
    /// Largest worn depth of either side, mm.
    pub(crate) deepest: f64,
    /// Cycles in which a body would be worn through somewhere at the present rates.
    pub(crate) cycles_left: f64,
    /// Largest wear of a point per physical cycle, mm.
    pub(crate) fastest_rate: f64,
    /// Whether a body is nearly consumed somewhere.
    pub(crate) worn_through: bool,
}

/// The next cycle that must be hit exactly, or beyond which a stop condition or a body's height would be passed at
/// the present rate.
pub(crate) fn next(scene: &Scene, now: Progress) -> u64 {
    let snapshots = &scene.output.snapshots_at_cycles;
    let snapshot = snapshots.iter().copied().find(|&at| at > now.cycle);
    let limits = scene
        .stop
        .iter()
        .map(|StopCondition::WornDepth(limit)| limit - now.deepest);
    let left = limits.fold(f64::INFINITY, f64::min);
    let cycles = (left / now.fastest_rate.max(f64::MIN_POSITIVE)).min(now.cycles_left);
    snapshot
        .unwrap_or(scene.cycles)
        .min(scene.cycles)
        .min(now.cycle.saturating_add(cycles_at_least(cycles.floor())))
}

/// How the run ends here, if it does.
pub(crate) fn end(scene: &Scene, now: Progress) -> Option<Outcome> {
    let reached = |StopCondition::WornDepth(limit): &StopCondition| now.deepest >= *limit;
    if scene.stop.iter().any(reached) {
        Some(Outcome::StopCondition)
    } else if now.worn_through {
        Some(Outcome::WornThrough)
    } else {
        (now.cycle >= scene.cycles).then_some(Outcome::Completed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;

    const UNWORN: Progress = Progress {
        cycle: 0,
        deepest: 0.0,
        cycles_left: f64::INFINITY,
        fastest_rate: 0.0,
        worn_through: false,
    };

    #[test]
    fn snapshots_limits_and_heights_are_not_passed() {
        let mut scene = fuzz_button();
        scene.output.snapshots_at_cycles = vec![100, 400];
        scene.stop = vec![StopCondition::WornDepth(0.25)];
        assert_eq!(next(&scene, UNWORN), 100);
        let wearing = Progress {
            cycle: 100,
            deepest: 0.125,
            fastest_rate: 1.0 / 1_024.0,
            ..UNWORN
        };
        assert_eq!(next(&scene, wearing), 228);
        scene.stop.clear();
        assert_eq!(next(&scene, wearing), 400);
        let thin = Progress {
            cycles_left: 16.5,
            ..wearing
        };
        assert_eq!(next(&scene, thin), 116);
    }

    #[test]
    fn a_run_ends_by_the_first_of_its_conditions() {
        let mut scene = fuzz_button();
        scene.stop = vec![StopCondition::WornDepth(0.25)];
        assert_eq!(end(&scene, UNWORN), None);
        let deep = Progress {
            deepest: 0.25,
            worn_through: true,
            ..UNWORN
        };
        assert_eq!(end(&scene, deep), Some(Outcome::StopCondition));
        scene.stop.clear();
        assert_eq!(end(&scene, deep), Some(Outcome::WornThrough));
        let last = Progress {
            cycle: scene.cycles,
            ..UNWORN
        };
        assert_eq!(end(&scene, last), Some(Outcome::Completed));
    }
}
