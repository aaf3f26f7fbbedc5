//! The grid: three levels, a factor of two apart, of contact element, increments per cycle and cycle jump.

use std::cmp::Reverse;
use std::fmt;

use api::results::AccuracyReached;
use api::spec::{CycleJump, Overrides};
use serde::{Deserialize, Serialize};

use crate::estimate::Estimate;
use crate::number::real;
use crate::spec;
use crate::spec::Resolved;

/// Levels of each setting: three are needed for an observed order.
pub(crate) const LEVELS: usize = 3;
/// Smallest number of increments per cycle at the coarsest level.
const FEWEST_INCREMENTS: u32 = 8;
/// Largest distance of the finest level from the setting that the tolerance chooses, halvings to either side.
const MOST_HALVINGS: i32 = 2;

/// The three settings of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Surface element size under the contact, mm.
    pub contact_element_mm: f64,
    /// Increments per computed cycle.
    pub increments_per_cycle: u32,
    /// Physical cycles per computed cycle.
    pub cycle_jump: f64,
}

impl Settings {
    /// The settings that a tolerance led to, in a run of so many cycles.
    pub(crate) fn used(cycles: u64, used: &AccuracyReached) -> Self {
        Self {
            contact_element_mm: used.contact_element_mm,
            increments_per_cycle: used.increments_per_cycle,
            cycle_jump: real(cycles) / real(used.computed_cycles.max(1)),
        }
    }

    /// Settings that a specification fixes; `None` if it leaves one open.
    pub(crate) fn of(overrides: &Overrides) -> Option<Self> {
        let Some(CycleJump::Fixed(jump)) = overrides.cycle_jump else {
            return None;
        };
        Some(Self {
            contact_element_mm: overrides.contact_element_mm?,
            increments_per_cycle: overrides.increments_per_cycle?,
            cycle_jump: real(jump),
        })
    }

    /// The jump as an integer.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "jumps are integers from 1 to 1e8"
    )]
    pub fn jump(self) -> u64 {
        self.cycle_jump as u64
    }
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "elements of {:.3e} mm, {} increments, jump {}",
            self.contact_element_mm, self.increments_per_cycle, self.cycle_jump
        )
    }
}

/// Expected settings and cost of the specification at its own tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Baseline {
    settings: Settings,
    cycles: f64,
    /// Seconds per increment.
    increment_s: f64,
    /// Continuous motion, which has one increment per cycle.
    continuous: bool,
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
            },
            cycles,
            increment_s: expected_s / workload.increments().max(1.0),
            continuous: spec::is_continuous(&scene.spec),
        }
    }

    /// Expected seconds: increments times the time per increment, which grows with the square of the elements.
    pub(crate) fn cost_s(&self, settings: Settings) -> f64 {
        let finer = self.settings.contact_element_mm / settings.contact_element_mm;
        let computed = self.cycles / settings.cycle_jump;
        self.increment_s * computed * f64::from(settings.increments_per_cycle) * finer.powi(2)
    }

    /// Settings one level coarser than the baseline's.
    pub(crate) fn pilot(&self) -> Settings {
        Grid::at(self, [-1; 3]).finest()
    }
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
    /// The grid whose finest level is so many halvings finer than the baseline: of element, increment, jump.
    fn at(baseline: &Baseline, halvings: [i32; 3]) -> Self {
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
        let mut halvings = [-MOST_HALVINGS; 3];
        for step in 0..2 * MOST_HALVINGS {
            for setting in [1, 2, 0] {
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
        self.levels([0; 3])
    }

    /// Settings at a level of element, increments and jump each, 0 the finest.
    pub(crate) fn levels(&self, [element, increments, jump]: [usize; 3]) -> Settings {
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
        }
    }

    /// All distinct settings, the cheapest first.
    pub(crate) fn coarsest_first(&self) -> Vec<Settings> {
        let levels = |index| [2, 1, 0].map(|place| index / LEVELS.pow(place) % LEVELS);
        let mut all: Vec<[usize; 3]> = (0..LEVELS.pow(3)).map(levels).collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    fn baseline() -> Baseline {
        Baseline {
            settings: Settings {
                contact_element_mm: 0.01,
                increments_per_cycle: 40,
                cycle_jump: 100.0,
            },
            cycles: 18_000.0,
            increment_s: 1e-4,
            continuous: false,
        }
    }

    #[test]
    fn a_grid_has_three_levels_of_three_settings_a_factor_of_two_apart() {
        let grid = Grid::at(&baseline(), [0; 3]);
        let runs = grid.coarsest_first();
        assert_eq!(runs.len(), 27);
        assert_eq!(
            runs[0],
            Settings {
                contact_element_mm: 0.04,
                increments_per_cycle: 8,
                cycle_jump: 400.0
            }
        );
        assert_eq!(runs[26], grid.finest());
        assert_eq!(runs[26].increments_per_cycle, 32);
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
        let runs = Grid::at(&few, [0; 3]).coarsest_first();
        assert_eq!(runs.len(), 9);
    }
}
