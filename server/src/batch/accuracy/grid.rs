//! The grid: three levels, a factor of two apart, of contact element, increments per cycle and cycle jump; of a contact along a line
//! also of the sections, but those only where the other settings are at the finest or all at the same level.

use std::cmp::Reverse;

use serde::{Deserialize, Serialize};
use solver::scene::LineShape;

use crate::batch::accuracy::settings::Settings;
use crate::estimate::Estimate;
use crate::number::real;
use crate::spec;
use crate::spec::Resolved;

/// Settings that are varied: element, increments, jump, sections.
pub(crate) const SETTINGS: usize = 4;
/// Levels of each setting: three are needed for an observed order.
pub(crate) const LEVELS: usize = 3;
/// Smallest number of increments per cycle at the coarsest level.
const FEWEST_INCREMENTS: u32 = 8;
/// Fewest intervals between sections at the finest level of a ring, and of a line, whose contact under a crown needs some eight sections.
const FEWEST_INTERVALS: [u32; 2] = [16, 32];
/// Largest distance of the finest level from the setting that the tolerance chooses, halvings to either side.
const MOST_HALVINGS: i32 = 2;

/// Expected settings and cost of the specification at its own tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Baseline {
    settings: Settings,
    cycles: f64,
    /// Seconds per increment.
    increment_s: f64,
    /// Continuous motion, which has one increment per cycle.
    continuous: bool,
    /// Fewest intervals between sections at the finest level.
    fewest_intervals: u32,
}

impl Baseline {
    /// Baseline of a scene with an expected time in seconds.
    pub(crate) fn of(scene: &Resolved, estimate: &Estimate, expected_s: f64) -> Self {
        let cycles = real(spec::cycles(&scene.spec));
        let workload = &estimate.workload;
        Self {
            settings: Settings {
                contact_element_mm: estimate.footprint.contact_element_mm,
                increments_per_cycle: workload.most_increments,
                cycle_jump: cycles / workload.computed_cycles.max(1.0),
                stations: stations(scene, workload.stations),
            },
            cycles,
            increment_s: expected_s / workload.increments().max(1.0),
            continuous: spec::is_continuous(&scene.spec),
            fewest_intervals: FEWEST_INTERVALS[usize::from(is_straight(scene))],
        }
    }

    /// Expected seconds: increments times the time per increment, which grows with the square of the elements and with the sections.
    pub(crate) fn cost_s(&self, settings: Settings) -> f64 {
        let finer = self.settings.contact_element_mm / settings.contact_element_mm;
        let computed = self.cycles / settings.cycle_jump;
        let sections = settings.sections() / self.settings.sections();
        let increments = computed * f64::from(settings.increments_per_cycle);
        self.increment_s * increments * finer.powi(2) * sections
    }

    /// Settings one level coarser than the baseline's.
    pub(crate) fn pilot(&self) -> Settings {
        Grid::at(self, [-1; SETTINGS]).finest()
    }
}

/// Sections of a contact along a line, which bodies of a width and points have not.
fn stations(scene: &Resolved, stations: usize) -> Option<u32> {
    scene.scene.dimension.line()?;
    u32::try_from(stations).ok()
}

fn is_straight(scene: &Resolved) -> bool {
    let line = scene.scene.dimension.line();
    line.is_some_and(|line| matches!(line.shape, LineShape::Straight { .. }))
}

/// Three levels of each setting, the finest first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    finest: Settings,
    /// Largest jump: a tenth of the cycles.
    longest: f64,
    continuous: bool,
}

impl Grid {
    /// The grid whose finest level is so many halvings finer than the baseline: of element, increment, jump, interval of sections.
    fn at(baseline: &Baseline, halvings: [i32; SETTINGS]) -> Self {
        let factor = |setting: usize| 2.0_f64.powi(halvings[setting]);
        let target = f64::from(baseline.settings.increments_per_cycle) * factor(1);
        // The coarsest level is a multiple of four, so that all three are.
        let mut coarsest = FEWEST_INCREMENTS;
        while f64::from(4 * (coarsest + 2)) < target {
            coarsest += 4;
        }
        let finest = Settings {
            contact_element_mm: baseline.settings.contact_element_mm / factor(0),
            increments_per_cycle: if baseline.continuous {
                baseline.settings.increments_per_cycle.max(4)
            } else {
                4 * coarsest
            },
            cycle_jump: (baseline.settings.cycle_jump / factor(2)).round().max(1.0),
            stations: (baseline.settings.stations)
                .map(|stations| finest_stations(baseline, stations, factor(3))),
        };
        Self {
            finest,
            longest: (0.1 * baseline.cycles).floor().max(1.0),
            continuous: baseline.continuous,
        }
    }

    /// The finest grid that fits: settings are refined in turn as long as all runs together stay within the budget and
    /// the finest run, which the others are compared with, is accepted.
    pub(crate) fn within(
        baseline: &Baseline,
        factor: f64,
        budget_s: f64,
        accepted: &dyn Fn(Settings) -> bool,
    ) -> Self {
        let cost = |halvings| {
            let runs = Self::at(baseline, halvings).coarsest_first();
            runs.into_iter()
                .map(|settings| factor * baseline.cost_s(settings))
                .sum::<f64>()
        };
        let mut halvings = [-MOST_HALVINGS; SETTINGS];
        for step in 0..2 * MOST_HALVINGS {
            for setting in [1, 2, 0, 3] {
                let mut finer = halvings;
                finer[setting] = step + 1 - MOST_HALVINGS;
                if finer[setting] == halvings[setting] + 1
                    && cost(finer) <= budget_s
                    && accepted(Self::at(baseline, finer).finest())
                {
                    halvings = finer;
                }
            }
        }
        Self::at(baseline, halvings)
    }

    /// The finest settings.
    pub(crate) fn finest(&self) -> Settings {
        self.levels([0; SETTINGS])
    }

    /// Settings at a level of element, increments, jump and sections each, 0 the finest.
    pub(crate) fn levels(&self, levels: [usize; SETTINGS]) -> Settings {
        let [element, increments, jump, sections] = levels;
        let factor = |level: usize| 2_u32.pow(u32::try_from(level).unwrap_or(0));
        let finest = self.finest;
        Settings {
            contact_element_mm: finest.contact_element_mm * f64::from(factor(element)),
            increments_per_cycle: if self.continuous {
                finest.increments_per_cycle
            } else {
                finest.increments_per_cycle / factor(increments)
            },
            cycle_jump: (finest.cycle_jump * f64::from(factor(jump))).min(self.longest),
            stations: (finest.stations).map(|stations| (stations - 1) / factor(sections) + 1),
        }
    }

    /// All distinct settings, the cheapest first.
    pub(crate) fn coarsest_first(&self) -> Vec<Settings> {
        let digit = |index: usize, place| index / LEVELS.pow(place) % LEVELS;
        let at_finest_sections = |index| [digit(index, 2), digit(index, 1), digit(index, 0), 0];
        let mut all: Vec<[usize; SETTINGS]> = (0..LEVELS.pow(3)).map(at_finest_sections).collect();
        for level in (1..LEVELS).filter(|_| self.finest.stations.is_some()) {
            all.extend([[0, 0, 0, level], [level; SETTINGS]]);
        }
        all.sort_by_key(|levels| Reverse(levels.iter().sum::<usize>()));
        let mut runs = Vec::new();
        for settings in all.into_iter().map(|levels| self.levels(levels)) {
            if !runs.contains(&settings) {
                runs.push(settings);
            }
        }
        runs
    }
}

/// Sections at the finest level: their intervals can be halved in number twice.
fn finest_stations(baseline: &Baseline, stations: u32, factor: f64) -> u32 {
    let target = f64::from(stations - 1) * factor;
    let mut intervals = baseline.fewest_intervals;
    while f64::from(intervals) < target {
        intervals += 4;
    }
    intervals + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn baseline() -> Baseline {
        Baseline {
            settings: Settings {
                contact_element_mm: 0.01,
                increments_per_cycle: 40,
                cycle_jump: 100.0,
                stations: None,
            },
            cycles: 18_000.0,
            increment_s: 1e-4,
            continuous: false,
            fewest_intervals: FEWEST_INTERVALS[0],
        }
    }

    #[test]
    fn a_grid_has_three_levels_of_three_settings_a_factor_of_two_apart() {
        let grid = Grid::at(&baseline(), [0; SETTINGS]);
        let runs = grid.coarsest_first();
        assert_eq!(runs.len(), 27);
        assert_eq!(
            runs[0],
            Settings {
                contact_element_mm: 0.04,
                increments_per_cycle: 8,
                cycle_jump: 400.0,
                stations: None,
            }
        );
        assert_eq!(runs[26], grid.finest());
        assert_eq!(runs[26].increments_per_cycle, 32);
    }

    #[test]
    fn sections_are_varied_alone_and_with_all_other_settings() {
        let mut line = baseline();
        line.settings.stations = Some(17);
        let runs = Grid::at(&line, [0; SETTINGS]).coarsest_first();
        assert_eq!(runs.len(), 27 + 4);
        let finest = runs[30];
        assert_eq!(finest.stations, Some(17));
        let with = |stations| move |run: &&Settings| run.stations == Some(stations);
        let coarse: Vec<&Settings> = runs.iter().filter(with(5)).collect();
        assert_eq!(coarse.len(), 2);
        assert_eq!(coarse[0], &runs[0]);
        assert_eq!(coarse[1].jump(), finest.jump());
        assert_eq!(runs.iter().filter(with(9)).count(), 2);
        // As many as can be halved twice, for few and for many sections.
        let finest = |halvings| Grid::at(&line, [0, 0, 0, halvings]).finest().stations;
        assert_eq!([-2, -1, 1].map(finest), [Some(17), Some(17), Some(33)]);
    }

    #[test]
    fn a_larger_budget_makes_a_finer_grid() {
        let cost = |budget_s| {
            let runs = Grid::within(&baseline(), 1.0, budget_s, &|_| true).coarsest_first();
            runs.into_iter()
                .map(|settings| baseline().cost_s(settings))
                .sum::<f64>()
        };
        assert!(cost(10.0) <= 10.0);
        assert!(cost(100.0) <= 100.0 && cost(100.0) > cost(10.0));
    }

    #[test]
    fn a_jump_of_one_is_not_refined_and_runs_are_not_repeated() {
        let mut few = baseline();
        few.settings.cycle_jump = 1.0;
        few.cycles = 10.0;
        let runs = Grid::at(&few, [0; SETTINGS]).coarsest_first();
        assert_eq!(runs.len(), 9);
    }
}
