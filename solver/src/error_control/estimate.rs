//! Errors of a run from its difference from coarser companions (Roache 1994, the grid convergence index).
//!
//! A part of the error, that of mesh, increments or jumps, falls with the refinement f of its setting as f^-p. With the
//! shares w_k of the parts in the error E of the first companion, whose settings are c, and r_k = (c/f_k)^p, the run
//! differs from it by E sum w_k (1 - r_k), and its own error is E sum w_k r_k. The differences of successive companions
//! are in proportion to the shares.

use super::companions::{COARSE, COUNT};
use crate::record::{Compared, ErrorParts, Errors, Quantity};
use crate::scene::{Refinement, Scene};

/// Safety factor (Roache's for three grids).
const SAFETY: f64 = 1.25;

/// Constants of the error estimate of one quantity.
#[derive(Clone, Copy)]
struct ConvergenceConstants {
    /// Order p of mesh and increments.
    order: f64,
    /// Least estimated error over the tolerance: runs that agree better do so by chance, the histories are compared between
    /// reports.
    least: f64,
}

/// Orders: of 100 random scenes (`tolerance_table`) nine of ten are within these estimates, which are three to five times
/// their errors in the median. Orders of single scenes are not determined from their companions: coarse ones may differ by
/// less than finer ones. A peak pressure changes by more from increment to increment: at least a tenth of what is allowed.
/// Of the 100 scenes, 88 peaks are within their estimates with 0.2, 92 with 0.3.
fn constants(quantity: Quantity) -> ConvergenceConstants {
    let (order, least) = match quantity {
        Quantity::WornArea => (1.5, 0.01),
        Quantity::WornDepth => (1.25, 0.01),
        Quantity::ScarHalfWidth => (1.1, 0.01),
        Quantity::PeakPressure | Quantity::ContactResistance => (1.0, 0.3),
    };
    ConvergenceConstants { order, least }
}

/// A criterion is reached by a depth, or by a resistance that follows from the width of the contact.
const OF_LIFE: ConvergenceConstants = ConvergenceConstants {
    order: 1.0,
    least: 0.01,
};

/// Order of jumps, which are Euler steps whose length grows with the cycles done: on `fuzz_button.json` the errors of area and depth
/// fall with orders of 0.6 from 10 to 2 % and 0.9 from 2 to 0.5 %.
const ORDER_OF_JUMPS: f64 = 0.75;

/// The parts of a quantity's error in the first companion, in proportion: the differences of successive companions, and
/// that of the next where one has no solution. `None` where the quantity of one that is solved is unknown.
fn parts(
    companions: &[Option<Compared>],
    difference: impl Fn(&Compared, &Compared) -> Option<f64>,
) -> Option<[f64; 3]> {
    let mut parts = [0.0; 3];
    let solved: Vec<(usize, &Compared)> = companions
        .iter()
        .take(COUNT)
        .enumerate()
        .filter_map(|(number, companion)| Some((number, companion.as_ref()?)))
        .collect();
    for pair in solved.windows(2) {
        let [(_, finer), (number, coarser)] = pair else {
            continue;
        };
        parts[number - 1] = difference(finer, coarser)?;
    }
    Some(parts)
}

/// A run of some refinement beside its companions.
#[derive(Clone, Copy)]
pub(super) struct Estimate<'a> {
    pub(super) scene: &'a Scene,
    pub(super) companions: &'a [Option<Compared>],
    pub(super) run: &'a Compared,
    pub(super) refinement: Refinement,
}

impl Estimate<'_> {
    /// The estimated errors of the run; `None` if its first companion has no solution.
    pub(super) fn errors(self) -> Option<Errors> {
        self.companions.first()?.as_ref()?;
        let parts = |quantity| {
            let difference =
                |one: &Compared, other: &Compared| Some(one.difference(other, quantity));
            self.error(constants(quantity), difference)
                .unwrap_or_default()
        };
        Some(Errors::of(self.run.has_resistance(), parts))
    }

    /// The estimated errors of its lives; `None` for one that the run or a companion has not reached.
    pub(super) fn errors_of_lives(self) -> Vec<Option<f64>> {
        let error = |criterion| {
            let difference =
                |one: &Compared, other: &Compared| one.difference_of_life(other, criterion);
            self.error(OF_LIFE, difference).map(|parts| parts.relative)
        };
        (0..self.run.lives.len()).map(error).collect()
    }

    /// Lives with the wear coefficients of each scattered scene over those with the given ones, on the settings of the first companion;
    /// `None` for one that either has not reached.
    pub(super) fn scattered_lives(self) -> Vec<Vec<Option<f64>>> {
        let Some(Some(median)) = self.companions.first() else {
            return Vec::new();
        };
        let scattered = self.companions.get(COUNT..).unwrap_or_default();
        let scattered = scattered.iter().take(self.scene.scattered.len());
        let ratios = scattered.map(|run| {
            let lives = run
                .iter()
                .flat_map(|run| run.lives.iter().zip(&median.lives));
            lives
                .map(|(here, there)| Some((*here)? / (*there)?))
                .collect()
        });
        ratios.collect()
    }

    /// The error of a quantity by which two runs differ. The companions follow the plan of the run, so that they do not show
    /// what skipped effects change.
    fn error(
        self,
        ConvergenceConstants { order, least }: ConvergenceConstants,
        difference: impl Fn(&Compared, &Compared) -> Option<f64>,
    ) -> Option<ErrorParts> {
        let first = self.companions.first()?.as_ref()?;
        let Refinement {
            mesh,
            increments,
            cycles,
        } = self.refinement;
        let parts = parts(self.companions, &difference)?;
        let whole: f64 = parts.iter().sum();
        let settings = [(mesh, order), (increments, order), (cycles, ORDER_OF_JUMPS)];
        let mut left = settings.map(|(finer, order)| (COARSE / finer).powf(order));
        // Single cycles are exact.
        if self.scene.accuracy.cycle_jump == Some(1) {
            left[2] = 0.0;
        }
        let share = |k: usize| {
            if whole > 0.0 {
                parts[k] / whole
            } else {
                1.0 / 3.0
            }
        };
        let removed: f64 = (0..3).map(|k| share(k) * (1.0 - left[k])).sum();
        let of_first = SAFETY * difference(self.run, first)? / removed;
        let [mesh, increments, jump] = [0, 1, 2].map(|k| of_first * share(k) * left[k]);
        let effects = SAFETY * self.run.skipped_change;
        let numerical = (mesh + increments + jump).max(least * self.scene.accuracy.tolerance);
        Some(ErrorParts {
            relative: numerical + effects,
            effects,
            mesh,
            increments,
            jump,
        })
    }
}
