//! Cycles that a run must hit exactly, and conditions that end it.

use serde::{Deserialize, Serialize};

use crate::number::cycles_at_least;
use crate::scene::{Criterion, Scene};
use crate::sides::{Side, Sides};

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
    /// Largest worn depth of each side, mm.
    pub(crate) deepest: Sides<f64>,
    /// Cycles in which a body would be worn through somewhere at the present rates.
    pub(crate) cycles_left: f64,
    /// Largest wear of a point of each side per physical cycle, as equivalent depth, mm.
    pub(crate) fastest_rate: Sides<f64>,
    /// Whether a body is nearly consumed somewhere.
    pub(crate) worn_through: bool,
}

/// The next cycle that must be hit exactly, or beyond which a stop condition or a body's height would be passed at
/// the present rate.
pub(crate) fn next(scene: &Scene, now: Progress) -> u64 {
    let snapshots = &scene.output.snapshots_at_cycles;
    let snapshot = snapshots.iter().copied().find(|&at| at > now.cycle);
    let wear = scene.surface_wear();
    let cycles = |side: Side, limit: f64| {
        let equivalent = |depth| wear.of(side).map_or(depth, |wear| wear.equivalent(depth));
        let left = equivalent(limit) - equivalent(*now.deepest.of(side));
        left / now.fastest_rate.of(side).max(f64::MIN_POSITIVE)
    };
    // How far a part of a scar is from a layer is not foreseen.
    let limits = scene.stop.iter().map(|criterion| match *criterion {
        Criterion::WornDepth { side, depth_mm } => {
            let of = |side| cycles(side, depth_mm);
            side.map_or_else(|| of(Side::Slider).min(of(Side::Receptacle)), of)
        }
        Criterion::ExposedFraction { .. } => f64::INFINITY,
    });
    let cycles = limits.fold(now.cycles_left, f64::min);
    snapshot
        .unwrap_or(scene.cycles)
        .min(scene.cycles)
        .min(now.cycle.saturating_add(cycles_at_least(cycles.floor())))
}

/// How the run ends here, if it does; `exposed` is the part of a side's scar that is worn through a layer.
pub(crate) fn end(
    scene: &Scene,
    now: Progress,
    exposed: impl Fn(Side, usize) -> f64,
) -> Option<Outcome> {
    let reached = |criterion: &Criterion| match *criterion {
        Criterion::WornDepth { side, depth_mm } => {
            let of = |side| *now.deepest.of(side) >= depth_mm;
            side.map_or_else(|| of(Side::Slider) || of(Side::Receptacle), of)
        }
        Criterion::ExposedFraction {
            side,
            layer,
            fraction,
        } => exposed(side, layer) >= fraction,
    };
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
    use crate::scene::{Layer, WearLaw};

    const fn of_receptacle(receptacle: f64) -> Sides<f64> {
        Sides {
            slider: 0.0,
            receptacle,
        }
    }

    fn depth(depth_mm: f64) -> Criterion {
        Criterion::WornDepth {
            side: None,
            depth_mm,
        }
    }

    fn unexposed(_: Side, _: usize) -> f64 {
        0.0
    }

    const UNWORN: Progress = Progress {
        cycle: 0,
        deepest: of_receptacle(0.0),
        cycles_left: f64::INFINITY,
        fastest_rate: of_receptacle(0.0),
        worn_through: false,
    };

    #[test]
    fn snapshots_limits_and_heights_are_not_passed() {
        let mut scene = fuzz_button();
        scene.output.snapshots_at_cycles = vec![100, 400];
        scene.stop = vec![depth(0.25)];
        assert_eq!(next(&scene, UNWORN), 100);
        let wearing = Progress {
            cycle: 100,
            deepest: of_receptacle(0.125),
            fastest_rate: of_receptacle(1.0 / 1_024.0),
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
        scene.stop = vec![depth(0.25)];
        assert_eq!(end(&scene, UNWORN, unexposed), None);
        let deep = Progress {
            deepest: of_receptacle(0.25),
            worn_through: true,
            ..UNWORN
        };
        assert_eq!(end(&scene, deep, unexposed), Some(Outcome::StopCondition));
        scene.stop.clear();
        assert_eq!(end(&scene, deep, unexposed), Some(Outcome::WornThrough));
        let last = Progress {
            cycle: scene.cycles,
            ..UNWORN
        };
        assert_eq!(end(&scene, last, unexposed), Some(Outcome::Completed));
    }

    #[test]
    fn a_side_and_an_exposed_part_end_a_run() {
        let mut scene = fuzz_button();
        let deep = Progress {
            deepest: of_receptacle(0.25),
            ..UNWORN
        };
        scene.stop = vec![Criterion::WornDepth {
            side: Some(Side::Slider),
            depth_mm: 0.25,
        }];
        assert_eq!(end(&scene, deep, unexposed), None);
        scene.stop = vec![Criterion::ExposedFraction {
            side: Side::Receptacle,
            layer: 1,
            fraction: 0.5,
        }];
        assert_eq!(end(&scene, deep, unexposed), None);
        let half = |side, layer| {
            if side == Side::Receptacle && layer == 1 {
                0.5
            } else {
                0.0
            }
        };
        assert_eq!(end(&scene, deep, half), Some(Outcome::StopCondition));
    }

    #[test]
    fn a_limit_below_a_layer_is_approached_by_the_dose() {
        let mut scene = fuzz_button();
        scene.receptacle.plating = vec![Layer {
            thickness_mm: 0.125,
            rate_per_mpa: 1e-8,
        }];
        scene.receptacle.wear = Some(WearLaw::Archard {
            k_over_h_per_mpa: 4e-8,
        });
        scene.stop = vec![depth(0.25)];
        let wearing = Progress {
            fastest_rate: of_receptacle(1.0 / 1_024.0),
            ..UNWORN
        };
        // 128 cycles through the layer, and 32 more as deep below it.
        assert_eq!(next(&scene, wearing), 160);
    }
}
