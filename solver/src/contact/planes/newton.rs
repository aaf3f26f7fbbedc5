//! Semi-smooth Newton iteration over the closed nodes of all planes and the common height.
//!
//! Statuses follow from the signs of the last iterate, as in the primal-dual active set of `contact::line`: a closed node under tension opens, an
//! open node that penetrates closes. Only the path p |sigma| is not linear, weakly, so that one factorisation serves most increments:
//! the system is condensed onto the nodes at the edges of the contacts, which may open and close without another one.

mod correction;
mod partition;

use super::iterate::Iterate;
use super::problem::{Problem, Zones};
use super::response::Response;
use super::wear::PlanesWear;
use crate::contact::line::{GAP_TOLERANCE, Pair};
use crate::linear::vector::{add_scaled, vectorized};
use correction::Correction;
use partition::Partition;

/// Most iterations, besides one for each node of a first load.
const MOST_ITERATIONS: usize = 60;
/// From this iteration on only the node that violates its status most changes it, as in Murty's pivoting: all at once can cycle.
const SINGLE_CHANGE_FROM: usize = 20;
/// Factors are renewed where an iteration without a change of status leaves more than this part of the residual.
const SLOW: f64 = 0.1;
/// From this iteration on factors are renewed in each.
const EXACT_FROM: usize = 12;
/// A residual within so many tolerances that another iteration did not halve is round-off.
const STALLED_WITHIN: f64 = 10.0;
/// Largest imbalance of the vertical forces over the load.
const BALANCE_TOLERANCE: f64 = 1e-9;
/// Round-off of a gap over the largest length in its sum.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// How the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Convergence {
    /// Statuses and gaps have converged.
    Converged,
    /// No finite solution, or nothing touches.
    Singular { active: usize },
    /// Too many iterations.
    NotConverged { residual: f64, changes: usize },
}

/// Buffers of the iteration.
#[derive(Default)]
pub(super) struct Newton {
    partition: Partition,
    correction: Correction,
    /// Gaps by deformation.
    deformed: Vec<f64>,
    /// Iterations since the last reset.
    pub(super) iterations: usize,
}

impl Newton {
    /// Iterates from the statuses, pressures and height of `it`.
    pub(super) fn solve(
        &mut self,
        problem: &Problem,
        zones: Zones<'_>,
        response: &mut Response,
        wear: &mut PlanesWear,
        pair: &Pair<'_>,
        it: &mut Iterate,
    ) -> Convergence {
        let single_changes = if problem.first_load {
            it.is_closed.len()
        } else {
            0
        };
        let most = MOST_ITERATIONS + single_changes;
        let (mut residual, mut changes, mut renew) = (f64::INFINITY, usize::MAX, true);
        for iteration in 0..most {
            self.iterations += 1;
            let renewed = renew || !self.partition.admits(&it.is_closed);
            if renewed {
                residual = self.linearise(problem, zones, response, wear, pair, it);
            }
            let last = (residual, changes);
            let changed = renewed || changes > 0;
            if !self.correction.apply(problem, &self.partition, it, changed) {
                return Convergence::Singular {
                    active: self.partition.nodes.len(),
                };
            }
            residual = self.evaluate(problem, response, wear, pair, it);
            changes = update_statuses(it, iteration >= SINGLE_CHANGE_FROM);
            let is_even = changes == 0 && last.1 == 0;
            let stalled = residual <= STALLED_WITHIN * it.tolerance && 2.0 * residual > last.0;
            let unbalanced = BALANCE_TOLERANCE * problem.full_load;
            if changes == 0
                && (residual <= it.tolerance || (stalled && is_even))
                && it.balance(problem).abs() <= unbalanced
            {
                it.residual = residual;
                return Convergence::Converged;
            }
            // Without a contact only a spring that has lost its force is in equilibrium.
            if problem.spring <= 0.0 && it.is_closed.iter().all(|closed| !closed) {
                return Convergence::Singular { active: 0 };
            }
            renew = (is_even && residual > SLOW * last.0) || iteration + 1 >= EXACT_FROM;
        }
        Convergence::NotConverged { residual, changes }
    }

    /// Chooses the unknowns for the statuses of an iterate and linearises about it; returns its residual.
    fn linearise(
        &mut self,
        problem: &Problem,
        zones: Zones<'_>,
        response: &mut Response,
        wear: &mut PlanesWear,
        pair: &Pair<'_>,
        it: &mut Iterate,
    ) -> f64 {
        self.partition.choose(&it.is_closed, problem.nodes());
        for &node in &self.partition.nodes {
            response.compute(problem, zones, node);
        }
        for (pressure, closed) in it.pressure.iter_mut().zip(&it.is_closed) {
            if !closed {
                *pressure = 0.0;
            }
        }
        let residual = self.evaluate(problem, response, wear, pair, it);
        self.correction
            .assemble(problem, &self.partition, wear, response, it);
        residual
    }

    /// Slips, paths and gaps of an iterate; returns the largest gap of a closed node over the indentation.
    fn evaluate(
        &mut self,
        problem: &Problem,
        response: &Response,
        wear: &mut PlanesWear,
        pair: &Pair<'_>,
        it: &mut Iterate,
    ) -> f64 {
        slide(problem, it);
        self.deformed.clear();
        self.deformed.resize(problem.len(), 0.0);
        let (deformed, pressure) = (&mut self.deformed, &it.pressure);
        vectorized(
            #[inline(always)]
            || {
                for &node in &self.partition.nodes {
                    if pressure[node] != 0.0 {
                        add_scaled(deformed, pressure[node], response.column(node));
                    }
                }
            },
        );
        it.gap.clear();
        it.gap.resize(problem.len(), 0.0);
        let n = problem.nodes();
        if problem.wears {
            wear.linearise(&problem.coupling, pair, n, &it.pressure, &it.slip);
            let planes = it.gap.chunks_exact_mut(n).zip(it.path.chunks_exact(n));
            for (plane, (opened, path)) in planes.enumerate() {
                let own = wear.of(plane);
                own.opening().add_product(&(0..n), path, opened);
            }
        }
        let (mut indentation, mut residual, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (node, jump) in self.deformed.iter().enumerate() {
            let worn = it.gap[node];
            let lifted = problem.per_height[node] * it.height;
            it.gap[node] = problem.gap[node] + lifted + jump + worn;
            if it.is_closed[node] {
                indentation = indentation.max(jump.abs()).max(worn);
                residual = residual.max(it.gap[node].abs());
                largest = largest.max(2.0 * problem.gap[node].abs());
            }
        }
        it.indentation = indentation;
        let scale = indentation.max(f64::MIN_POSITIVE);
        it.tolerance = GAP_TOLERANCE.max(ROUND_OFF * largest / scale);
        residual / scale
    }
}

/// Slips and paths of all nodes.
fn slide(problem: &Problem, it: &mut Iterate) {
    it.slip.clear();
    it.path.clear();
    for (node, fixed) in problem.fixed_slip.iter().enumerate() {
        let slip = problem.direction * (fixed + problem.slope[node] * it.height);
        it.slip.push(slip.max(0.0));
        it.path.push((it.pressure[node] * slip).max(0.0));
    }
}

/// Updates the statuses from the signs of the iterate, of one node only if asked; returns the number of nodes that violate theirs.
fn update_statuses(it: &mut Iterate, single: bool) -> usize {
    let scale = it
        .pressure
        .iter()
        .fold(f64::MIN_POSITIVE, |m, p| m.max(p.abs()));
    let (mut changes, mut worst) = (0, (0.0, 0));
    for node in 0..it.is_closed.len() {
        let violation = if it.is_closed[node] {
            -it.pressure[node] / scale
        } else {
            let beyond = -it.gap[node] / it.indentation.max(f64::MIN_POSITIVE);
            if beyond > it.tolerance { beyond } else { 0.0 }
        };
        if violation > 0.0 {
            changes += 1;
            if violation > worst.0 {
                worst = (violation, node);
            }
            if !single {
                it.is_closed[node] = !it.is_closed[node];
            }
        }
    }
    if single && changes > 0 {
        it.is_closed[worst.1] = !it.is_closed[worst.1];
    }
    changes
}
