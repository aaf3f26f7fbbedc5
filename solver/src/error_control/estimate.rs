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

/// Order p of mesh and increments. Of 100 random scenes (`tolerance_table`) nine of ten are within these estimates, which are
/// three to five times their errors in the median. Orders of single scenes are not determined from their companions: coarse
/// ones may differ by less than finer ones.
fn order(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::WornArea => 1.5,
        Quantity::WornDepth => 1.25,
        Quantity::ScarHalfWidth => 1.1,
        Quantity::PeakPressure => 1.0,
    }
}

/// That of jumps, which are Euler steps whose length grows with the cycles done: on `fuzz_button.json` the errors of area and depth
/// fall with orders of 0.6 from 10 to 2 % and 0.9 from 2 to 0.5 %.
const ORDER_OF_JUMPS: f64 = 0.75;

/// Least estimated error over the tolerance: runs that agree better do so by chance, the histories are compared between
/// reports. A peak pressure changes by more from increment to increment: a tenth of what is allowed. Of the 100 scenes, 88
/// peaks are within their estimates with 0.2, 92 with 0.3.
const LEAST: f64 = 0.01;
const LEAST_OF_PRESSURE: f64 = 0.3;

/// The parts of a quantity's error in the first companion, in proportion: the differences of successive companions, and
/// that of the next where one has no solution.
fn parts(companions: &[Option<Compared>], quantity: Quantity) -> [f64; 3] {
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
        parts[number - 1] = finer.difference(coarser, quantity);
    }
    parts
}

/// The estimated errors of a run of some refinement; `None` if its first companion has no solution. The companions follow the
/// plan of the run, so that they do not show what skipped effects change.
pub(super) fn errors(
    scene: &Scene,
    companions: &[Option<Compared>],
    run: &Compared,
    refinement: Refinement,
) -> Option<Errors> {
    let first = companions.first()?.as_ref()?;
    let Refinement {
        mesh,
        increments,
        cycles,
    } = refinement;
    Some(Errors::of(|quantity| {
        let parts = parts(companions, quantity);
        let whole: f64 = parts.iter().sum();
        let order = order(quantity);
        let settings = [(mesh, order), (increments, order), (cycles, ORDER_OF_JUMPS)];
        let mut left = settings.map(|(finer, order)| (COARSE / finer).powf(order));
        // Single cycles are exact.
        if scene.accuracy.cycle_jump == Some(1) {
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
        let of_first = SAFETY * run.difference(first, quantity) / removed;
        let [mesh, increments, jump] = [0, 1, 2].map(|k| of_first * share(k) * left[k]);
        let least = match quantity {
            Quantity::PeakPressure => LEAST_OF_PRESSURE,
            Quantity::WornDepth | Quantity::ScarHalfWidth | Quantity::WornArea => LEAST,
        };
        let effects = SAFETY * run.skipped_change;
        let numerical = (mesh + increments + jump).max(least * scene.accuracy.tolerance);
        ErrorParts {
            relative: numerical + effects,
            effects,
            mesh,
            increments,
            jump,
        }
    }))
}
