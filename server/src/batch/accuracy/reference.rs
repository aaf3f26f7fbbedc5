//! The converged solution by Richardson extrapolation: with q at steps h, 2h, 4h the observed order is
//! p = log2((q_4h - q_2h)/(q_2h - q_h)), and the limit q_h + (q_h - q_2h)/(2^p - 1) (L. F. Richardson 1911). The
//! corrections of all settings are added; their interactions are of higher order.

use api::results::SideProfile;
use api::study::{Errors, Orders, Reference};

use crate::batch::accuracy::error::StudyError;
use crate::batch::accuracy::errors::{Solution, depth_at};
use crate::batch::accuracy::grid::{Grid, LEVELS, SETTINGS};
use crate::batch::accuracy::run::Run;
use crate::batch::accuracy::run_accuracy::RunAccuracy;
use crate::batch::accuracy::settings::Settings;

/// Range that observed orders are clamped to for the extrapolation: a small order would blow up the correction, and the
/// elements are of second order.
const ORDERS: (f64, f64) = (0.7, 2.5);
/// Order assumed for the points of a profile where the largest depth has no observed order.
const ASSUMED_ORDER: f64 = 1.0;
/// Relative differences below this are noise of the solver's own tolerances.
const NOISE: f64 = 1e-7;

/// The converged solution and its derivation.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Converged {
    pub(crate) reference: Reference,
    solution: Solution,
}

/// A setting that is varied.
struct Varied {
    name: &'static str,
    value: fn(Settings) -> f64,
    /// Step h.
    step: fn(Settings) -> f64,
}

/// The settings in the order of their indices in [`Grid::levels`].
const VARIED: [Varied; SETTINGS] = [
    Varied {
        name: "contact_element_mm",
        value: |settings| settings.contact_element_mm,
        step: |settings| settings.contact_element_mm,
    },
    Varied {
        name: "increments_per_cycle",
        value: |settings| f64::from(settings.increments_per_cycle),
        step: |settings| 1.0 / f64::from(settings.increments_per_cycle),
    },
    Varied {
        name: "cycle_jump",
        value: |settings| settings.cycle_jump,
        step: |settings| settings.cycle_jump,
    },
    Varied {
        name: "stations",
        value: Settings::sections,
        step: |settings| 1.0 / (settings.sections() - 1.0),
    },
];

/// Runs along one setting, the others finest.
struct Line<'a> {
    setting: &'static str,
    levels: [f64; LEVELS],
    solutions: [&'a Solution; LEVELS],
}

impl Converged {
    /// Extrapolates the finest grid runs; takes the best tolerance run as long as those are missing.
    pub(crate) fn of(grid: &Grid, runs: &[Run]) -> Result<Self, StudyError> {
        let at = |settings: Settings| -> Option<&Solution> {
            let run = runs
                .iter()
                .find(|run| run.accuracy == RunAccuracy::Fixed(settings))?;
            run.found.as_ref().ok().map(|found| &found.solution)
        };
        let Some(finest) = at(grid.finest()) else {
            return Self::best_tolerance(runs);
        };
        let mut solution = finest.clone();
        let mut uncertainty = [0.0; 4];
        let mut orders = Vec::new();
        for line in lines(grid, &at) {
            orders.push(line.orders());
            line.correct(&mut solution, finest, &mut uncertainty);
        }
        let finest = grid.finest();
        let method = format!("Richardson extrapolation of the grid from {finest}");
        Ok(Self::new(solution, method, uncertainty, orders))
    }

    fn best_tolerance(runs: &[Run]) -> Result<Self, StudyError> {
        let solved = runs.iter().filter_map(|run| {
            let found = run.found.as_ref().ok()?;
            Some((run.accuracy.parts().0?, &found.solution))
        });
        let Some((tolerance, best)) = solved.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return Err(StudyError::NothingSolved("no tolerance".to_owned()));
        };
        let method =
            format!("the run at tolerance {tolerance}: there is no result of the finest grid run");
        Ok(Self::new(best.clone(), method, [tolerance; 4], Vec::new()))
    }

    /// `uncertainty` is in the order of [`Solution::figures`].
    fn new(solution: Solution, method: String, uncertainty: [f64; 4], orders: Vec<Orders>) -> Self {
        let figures = solution.figures;
        let reference = Reference {
            method,
            max_depth_mm: figures[0],
            scar_half_width_mm: figures[1],
            peak_pressure_mpa: figures[2],
            worn_area_mm2: figures[3],
            uncertainty: Errors {
                depth: uncertainty[0],
                width: uncertainty[1],
                peak_pressure: uncertainty[2],
                area: uncertainty[3],
            },
            orders,
        };
        Self {
            reference,
            solution,
        }
    }

    /// Errors of a solution relative to this one.
    pub(crate) fn errors(&self, solution: &Solution) -> Errors {
        self.solution.errors(solution)
    }
}

/// Returns the settings that were solved at three levels, each twice or half the one before.
fn lines<'a>(grid: &Grid, at: &impl Fn(Settings) -> Option<&'a Solution>) -> Vec<Line<'a>> {
    let line = |(index, varied): (usize, &Varied)| {
        let along = [0, 1, 2].map(|level| {
            let mut levels = [0; SETTINGS];
            levels[index] = level;
            grid.levels(levels)
        });
        let [Some(fine), Some(middle), Some(coarse)] = along.map(at) else {
            return None;
        };
        let steps = along.map(varied.step);
        let doubled = |from: f64, to: f64| (to / from - 2.0).abs() < 1e-9;
        (doubled(steps[0], steps[1]) && doubled(steps[1], steps[2])).then_some(Line {
            setting: varied.name,
            levels: along.map(varied.value),
            solutions: [fine, middle, coarse],
        })
    };
    VARIED.iter().enumerate().filter_map(line).collect()
}

impl Line<'_> {
    fn figures(&self, index: usize) -> [f64; LEVELS] {
        self.solutions.map(|solution| solution.figures[index])
    }

    fn orders(&self) -> Orders {
        let order = |index: usize| order(self.figures(index));
        Orders {
            setting: self.setting.to_owned(),
            levels: self.levels.into(),
            depth: order(0),
            width: order(1),
            peak_pressure: order(2),
            area: order(3),
        }
    }

    /// Share of the extrapolation to zero that leads from the finest level to the limit: the limit of a jump is 1, not
    /// 0.
    fn share(&self) -> f64 {
        if self.setting == "cycle_jump" {
            1.0 - 1.0 / self.levels[0]
        } else {
            1.0
        }
    }

    /// Adds this setting's corrections to the solution, and their sizes to the uncertainty.
    fn correct(&self, solution: &mut Solution, finest: &Solution, uncertainty: &mut [f64; 4]) {
        let mut sizes = [0.0; 4];
        for (index, size) in sizes.iter_mut().enumerate() {
            let figures = self.figures(index);
            let correction = self.share() * correction(figures);
            solution.figures[index] += correction;
            // Without an observed order the last difference is the only estimate.
            let last = match order(figures) {
                Some(_) => 0.0,
                None => self.share() * (figures[0] - figures[1]).abs(),
            };
            let of = finest.figures[index].abs().max(f64::MIN_POSITIVE);
            *size = correction.abs().max(last) / of;
        }
        let order = order(self.figures(0)).unwrap_or(ASSUMED_ORDER);
        let factor = self.share() / divisor(order);
        let mut largest = 0.0_f64;
        for side in 0..2 {
            let [fine, middle, _] = self.solutions.map(|solution| &solution.profiles[side]);
            let corrections = point_corrections(fine, middle, factor);
            let depths = solution.profiles[side].depth_mm.iter_mut();
            for (depth, correction) in depths.zip(corrections) {
                *depth += correction;
                largest = largest.max(correction.abs());
            }
        }
        // The depth is compared at every point of the profiles.
        sizes[0] = largest / finest.deepest().max(f64::MIN_POSITIVE);
        for (sum, size) in uncertainty.iter_mut().zip(sizes) {
            *sum += size;
        }
    }
}

/// Returns the corrections at the points of the fine profile.
fn point_corrections(fine: &SideProfile, middle: &SideProfile, factor: f64) -> Vec<f64> {
    let nodes = fine.x_mm.iter().zip(&fine.depth_mm);
    nodes
        .map(|(x, depth)| factor * (depth - depth_at(middle, *x)))
        .collect()
}

/// Returns the observed order of three levels, finest first; `None` if they do not converge monotonically.
fn order([fine, middle, coarse]: [f64; LEVELS]) -> Option<f64> {
    let (near, far) = (middle - fine, coarse - middle);
    let visible = near.abs() > NOISE * fine.abs();
    (visible && near * far > 0.0 && far.abs() > near.abs()).then(|| (far / near).log2())
}

/// Returns the correction from the finest level to the limit; 0 without an observed order.
fn correction(levels: [f64; LEVELS]) -> f64 {
    order(levels).map_or(0.0, |order| (levels[0] - levels[1]) / divisor(order))
}

/// Returns 2^p - 1.
fn divisor(order: f64) -> f64 {
    2.0_f64.powf(order.clamp(ORDERS.0, ORDERS.1)) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extrapolation_finds_the_limit_of_a_power_law() {
        for p in [1.0, 1.5, 2.0] {
            let at = |h: f64| 3.0 + 0.7 * h.powf(p);
            let levels = [at(0.1), at(0.2), at(0.4)];
            let found = order(levels).expect("an order");
            assert!((found - p).abs() < 1e-9, "{found}");
            assert!((levels[0] + correction(levels) - 3.0).abs() < 1e-12);
        }
    }

    #[test]
    fn levels_that_oscillate_have_no_order_and_no_correction() {
        assert_eq!(order([1.0, 1.1, 1.05]), None);
        assert!(correction([1.0, 1.1, 1.05]).abs() < 1e-15);
        assert_eq!(order([1.0, 1.0, 1.0]), None);
    }
}
