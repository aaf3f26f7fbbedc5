//! Cycles that a run must hit exactly, and conditions that end it.

use serde::{Deserialize, Serialize};

use crate::change::Change;
use crate::law::surface::SurfaceWear;
use crate::number::{cycles_at_least, real_cycles};
use crate::scene::{Criterion, Electrical, Scene};
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
    /// A groove along a line was as deep as the slider's radius: no graph describes walls that overhang.
    DeeperThanRadius,
    /// The observer asked to stop.
    Stopped,
}

/// Quantities that stops depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StopQuantities {
    /// Physical cycles done.
    pub(crate) cycle: u64,
    /// Cycles in which a body would be worn through somewhere at the present rates.
    pub(crate) cycles_left: f64,
    /// Largest wear of a point of each side per physical cycle, as equivalent depth, mm.
    pub(crate) fastest_rate: Sides<f64>,
    /// True if a body is nearly consumed somewhere.
    pub(crate) worn_through: bool,
    /// True if the resistance of the contact has reached a limit that ends the run.
    pub(crate) exceeds_resistance: bool,
}

/// Least step toward a criterion of a life over the cycles done: the life is interpolated within it. With a rate that falls as
/// the inverse of the cycles at worst, by an eighth of the square of this part.
const LIFE_STEP: f64 = 0.01;

/// The next cycle that must be hit exactly, at a snapshot or a point of the friction's table, or beyond which a criterion or a body's
/// height would be passed at the present rate; a criterion of a life may be passed by a small step. `depth` is that of a part of a side's scar, mm.
pub(crate) fn next(scene: &Scene, now: StopQuantities, depth: impl Fn(Side, f64) -> f64) -> u64 {
    next_at(scene, now, depth, |side, _| *now.fastest_rate.of(side))
}

/// The same for a contact whose deepest place of a side comes to an equivalent depth in mm as fast as `rate` says, mm per cycle.
pub(crate) fn next_at(
    scene: &Scene,
    now: StopQuantities,
    depth: impl Fn(Side, f64) -> f64,
    rate: impl Fn(Side, f64) -> f64,
) -> u64 {
    if now.exceeds_resistance {
        return now.cycle + 1;
    }
    let snapshots = &scene.output.snapshots_at_cycles;
    let snapshot = snapshots.iter().copied().find(|&at| at > now.cycle);
    let wear = scene.surface_wear();
    let cycles = |criterion: &Criterion| {
        let Criterion { side, depth_mm, .. } = *criterion;
        let depth = depth(side, criterion.part);
        let equivalent = |depth| wear.of(side).map_or(depth, |wear| wear.equivalent(depth));
        let deepest = wear.of(side).map_or(0.0, SurfaceWear::deepest);
        if depth >= depth_mm || depth_mm > deepest {
            f64::INFINITY
        } else {
            let limit = equivalent(depth_mm);
            let fastest = if criterion.part > 0.0 {
                *now.fastest_rate.of(side)
            } else {
                rate(side, limit)
            };
            (limit - equivalent(depth)) / fastest.max(f64::MIN_POSITIVE)
        }
    };
    let least = LIFE_STEP * real_cycles(now.cycle);
    let lives = scene.life.iter().map(|life| cycles(life).max(least));
    let cycles = scene.stop.iter().map(cycles).chain(lives);
    let cycles = cycles.fold(now.cycles_left, f64::min);
    snapshot
        .unwrap_or(scene.cycles)
        .min(next_point_of_friction(scene, now.cycle))
        .min(scene.cycles)
        .min(now.cycle.saturating_add(cycles_at_least(cycles.floor())))
}

/// The cycle to go to instead where the resistance of the contact has passed a limit in a step between cycles that is too long: a limit that ends the
/// run is met to one cycle, that of a life to a small step. The resistance jumps where a layer is through, so that no rate before foresees
/// it; the step is cut to where a linear resistance would meet the limit, at most to half.
pub(crate) fn resistance_passed(
    electrical: &Electrical,
    from: u64,
    to: u64,
    resistance_mohm: Change<f64>,
) -> Option<u64> {
    let Change { before, after } = resistance_mohm;
    let done = to - from;
    let least = cycles_at_least(LIFE_STEP * real_cycles(from));
    let stops = electrical.stop_mohm.iter().map(|limit| (*limit, 1));
    let lives = electrical.life_mohm.iter().map(|limit| (*limit, least));
    let passed = stops
        .chain(lives)
        .filter(|(limit, allowed)| before < *limit && *limit <= after && done > *allowed);
    let steps = passed.map(|(limit, allowed)| {
        let linear = real_cycles(done) * (limit - before) / (after - before);
        cycles_at_least(linear).min(done / 2).max(allowed)
    });
    steps.min().map(|step| from + step)
}

/// The next cycle at which the coefficient of friction begins to change at another rate.
pub(crate) fn next_point_of_friction(scene: &Scene, cycle: u64) -> u64 {
    let table = scene.friction.by_cycle();
    let next = table.and_then(|table| table.next_point(real_cycles(cycle)));
    next.map_or(u64::MAX, cycles_at_least)
}

/// How the run ends here, if it does; `depth` is that of a part of a side's scar, mm.
pub(crate) fn end(
    scene: &Scene,
    now: StopQuantities,
    depth: impl Fn(Side, f64) -> f64,
) -> Option<Outcome> {
    let reached =
        |criterion: &Criterion| depth(criterion.side, criterion.part) >= criterion.depth_mm;
    if scene.stop.iter().any(reached) || now.exceeds_resistance {
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
    use crate::law::resistance::Deformation;
    use crate::model::tests::fuzz_button;
    use crate::scene::{Layer, Metal, Spots, WearLaw};

    const fn of_receptacle(receptacle: f64) -> Sides<f64> {
        Sides {
            slider: 0.0,
            receptacle,
        }
    }

    fn deepest(depth_mm: f64) -> Criterion {
        Criterion::deepest(Side::Receptacle, depth_mm)
    }

    /// A triangular scar of the receptacle.
    fn worn(depth_mm: f64) -> impl Fn(Side, f64) -> f64 {
        move |side, part| *of_receptacle((1.0 - part) * depth_mm).of(side)
    }

    const UNWORN: StopQuantities = StopQuantities {
        cycle: 0,
        cycles_left: f64::INFINITY,
        fastest_rate: of_receptacle(0.0),
        worn_through: false,
        exceeds_resistance: false,
    };

    const WEARING: StopQuantities = StopQuantities {
        fastest_rate: of_receptacle(1.0 / 1_024.0),
        ..UNWORN
    };

    #[test]
    fn snapshots_limits_and_heights_are_not_passed() {
        let mut scene = fuzz_button();
        scene.output.snapshots_at_cycles = vec![100, 400];
        scene.stop = vec![deepest(0.25)];
        assert_eq!(next(&scene, UNWORN, worn(0.0)), 100);
        let wearing = StopQuantities {
            cycle: 100,
            ..WEARING
        };
        assert_eq!(next(&scene, wearing, worn(0.125)), 228);
        scene.stop.clear();
        assert_eq!(next(&scene, wearing, worn(0.125)), 400);
        let exceeding = StopQuantities {
            exceeds_resistance: true,
            ..wearing
        };
        assert_eq!(next(&scene, exceeding, worn(0.125)), 101);
        let thin = StopQuantities {
            cycles_left: 16.5,
            ..wearing
        };
        assert_eq!(next(&scene, thin, worn(0.125)), 116);
    }

    #[test]
    fn a_criterion_of_a_life_is_passed_by_a_small_step() {
        let mut scene = fuzz_button();
        scene.cycles = 100_000;
        scene.stop.clear();
        scene.output.snapshots_at_cycles.clear();
        scene.life = vec![deepest(0.25)];
        let next = |cycle, depth| next(&scene, StopQuantities { cycle, ..WEARING }, worn(depth));
        assert_eq!(next(10_000, 0.125), 10_128);
        assert_eq!(next(10_000, 0.249), 10_100);
        // Passed.
        assert_eq!(next(10_000, 0.25), 100_000);
    }

    #[test]
    fn a_run_ends_by_the_first_of_its_conditions() {
        let mut scene = fuzz_button();
        scene.stop = vec![deepest(0.25)];
        assert_eq!(end(&scene, UNWORN, worn(0.0)), None);
        let consumed = StopQuantities {
            worn_through: true,
            ..UNWORN
        };
        assert_eq!(
            end(&scene, consumed, worn(0.25)),
            Some(Outcome::StopCondition)
        );
        scene.stop.clear();
        assert_eq!(
            end(&scene, consumed, worn(0.25)),
            Some(Outcome::WornThrough)
        );
        let last = StopQuantities {
            cycle: scene.cycles,
            ..UNWORN
        };
        assert_eq!(end(&scene, last, worn(0.25)), Some(Outcome::Completed));
    }

    #[test]
    fn a_limit_of_the_resistance_is_met_to_a_cycle_and_that_of_a_life_to_a_small_step() {
        let metal = Metal {
            bottom_mm: f64::INFINITY,
            resistivity_ohm_m: 1e-8,
            hardness_mpa: 1e3,
            film: None,
        };
        let of = |stop_mohm: &[f64], life_mohm: &[f64]| Electrical {
            width_mm: 1.0,
            metals: Sides {
                slider: vec![metal],
                receptacle: vec![metal],
            },
            spots: Spots {
                count: 1,
                cluster_diameter_mm: 0.0,
                deformation: Deformation::Plastic,
            },
            frequency_hz: None,
            current_a: None,
            stop_mohm: stop_mohm.to_vec(),
            life_mohm: life_mohm.to_vec(),
        };
        let stop = of(&[10.0], &[]);
        let passed = |(from, to), (before, after)| {
            resistance_passed(&stop, from, to, Change { before, after })
        };
        assert_eq!(passed((1_000, 2_000), (2.0, 4.0)), None);
        assert_eq!(passed((1_000, 2_000), (2.0, 34.0)), Some(1_250));
        // At most to half, at least by a cycle.
        assert_eq!(passed((1_000, 2_000), (2.0, 11.0)), Some(1_500));
        assert_eq!(passed((1_000, 1_002), (2.0, 1e9)), Some(1_001));
        assert_eq!(passed((1_000, 1_001), (2.0, 1e9)), None);
        // A limit that was passed before does not count.
        assert_eq!(passed((1_000, 2_000), (12.0, 34.0)), None);
        let life = of(&[], &[10.0, 20.0]);
        let passed = |(from, to), (before, after)| {
            resistance_passed(&life, from, to, Change { before, after })
        };
        assert_eq!(passed((1_000, 2_000), (2.0, 34.0)), Some(1_250));
        assert_eq!(passed((1_000, 1_010), (2.0, 34.0)), None);
        assert_eq!(passed((1_000, 1_012), (2.0, 1e9)), Some(1_010));
    }

    #[test]
    fn the_other_side_or_a_smaller_part_does_not_end_a_run() {
        let mut scene = fuzz_button();
        scene.stop = vec![Criterion::deepest(Side::Slider, 0.25)];
        assert_eq!(end(&scene, UNWORN, worn(0.25)), None);
        scene.stop = vec![Criterion {
            part: 0.5,
            ..deepest(0.25)
        }];
        assert_eq!(end(&scene, UNWORN, worn(0.25)), None);
        assert_eq!(end(&scene, UNWORN, worn(0.5)), Some(Outcome::StopCondition));
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
        scene.stop = vec![deepest(0.25)];
        // 128 cycles through the layer, and 32 more as deep below it.
        assert_eq!(next(&scene, WEARING, worn(0.0)), 160);
        // A base that does not wear is never worn to a depth.
        scene.receptacle.wear = None;
        scene.cycles = 10_000;
        assert_eq!(next(&scene, WEARING, worn(0.0)), 10_000);
        scene.stop = vec![deepest(0.125)];
        assert_eq!(next(&scene, WEARING, worn(0.0)), 128);
    }
}
