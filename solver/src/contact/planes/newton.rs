//! Semi-smooth Newton iteration over the closed nodes of all planes and the common height.
//!
//! Statuses follow from the signs of the last iterate, as in the primal-dual active set of `contact::line`: a closed node under tension opens, an
//! open node that penetrates closes. Only the path p |sigma| is not linear, weakly, so that the factors of the first iteration with these
//! statuses serve the next ones, mostly one more.

use super::problem::{Problem, Zones};
use super::response::Response;
use crate::contact::line::GAP_TOLERANCE;
use crate::linear::DenseLu;
use crate::linear::vector::{add_scaled, vectorized};

/// Most iterations, besides one for each node of a first load.
const MOST_ITERATIONS: usize = 60;
/// From this iteration on only the node that violates its status most changes it, as in Murty's pivoting: all at once can cycle.
const SINGLE_CHANGE_FROM: usize = 20;
/// Factors are renewed where an iteration leaves more than this part of the residual.
const SLOW: f64 = 0.1;
/// A residual within so many tolerances that another iteration did not halve is round-off.
const STALLED_WITHIN: f64 = 10.0;
/// Largest imbalance of the vertical forces over the load.
const BALANCE_TOLERANCE: f64 = 1e-9;
/// Round-off of a gap over the largest length in its sum.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// Tractions and height.
#[derive(Debug, Default)]
pub(super) struct Iterate {
    pub(super) is_closed: Vec<bool>,
    pub(super) pressure: Vec<f64>,
    /// Magnitude of the slip, mm, and p |sigma|, MPa mm.
    pub(super) slip: Vec<f64>,
    pub(super) path: Vec<f64>,
    pub(super) gap: Vec<f64>,
    pub(super) height: f64,
    /// Largest indentation, mm: the scale of gaps; and the residual over it at which the iteration has converged.
    pub(super) indentation: f64,
    pub(super) tolerance: f64,
}

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
#[derive(Debug, Default)]
pub(super) struct Newton {
    lu: DenseLu,
    closed: Vec<usize>,
    rhs: Vec<f64>,
    /// Gaps by deformation, and a column of the system.
    deformed: Vec<f64>,
    column: Vec<f64>,
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
        it: &mut Iterate,
        is_first_load: bool,
    ) -> Convergence {
        let most = MOST_ITERATIONS + if is_first_load { it.is_closed.len() } else { 0 };
        let (mut residual, mut changes, mut renew) = (f64::INFINITY, usize::MAX, true);
        for iteration in 0..most {
            self.iterations += 1;
            let changed = changes;
            if renew {
                self.factor(problem, zones, response, it);
                residual = self.evaluate(problem, response, it);
            }
            if !self.correct(problem, it) {
                return Convergence::Singular {
                    active: self.closed.len(),
                };
            }
            let before = residual;
            residual = self.evaluate(problem, response, it);
            changes = update_statuses(it, iteration >= SINGLE_CHANGE_FROM);
            let stalled = residual <= STALLED_WITHIN * it.tolerance && 2.0 * residual > before;
            let unbalanced = BALANCE_TOLERANCE * problem.load;
            if changes == 0
                && (residual <= it.tolerance || (stalled && changed == 0))
                && balance(problem, it).abs() <= unbalanced
            {
                return Convergence::Converged;
            }
            if it.is_closed.iter().all(|closed| !closed) {
                return Convergence::Singular { active: 0 };
            }
            renew = changes > 0 || residual > SLOW * before;
        }
        Convergence::NotConverged { residual, changes }
    }

    /// Factors the derivatives of the gaps of closed nodes and of the vertical balance.
    fn factor(
        &mut self,
        problem: &Problem,
        zones: Zones<'_>,
        response: &mut Response,
        it: &mut Iterate,
    ) {
        self.closed.clear();
        let closed = it
            .is_closed
            .iter()
            .enumerate()
            .filter(|(_, closed)| **closed);
        self.closed.extend(closed.map(|(node, _)| node));
        for &node in &self.closed {
            response.compute(problem, zones, node);
        }
        slide(problem, it);
        let (n, m) = (problem.nodes(), self.closed.len());
        let matrix = self.lu.matrix(m + 1);
        for (j, &node) in self.closed.iter().enumerate() {
            self.column.clear();
            self.column.extend_from_slice(response.column(node));
            if problem.wears {
                let plane = node / n;
                let own = &mut self.column[plane * n..(plane + 1) * n];
                let wear = &problem.wear;
                wear.open_by_pressure(&(0..n), node % n, it.slip[node], own);
            }
            let target = matrix.column_mut(j).iter_mut();
            for (entry, row) in target.zip(&self.closed) {
                *entry = self.column[*row];
            }
            *matrix.at(m, j) = problem.shares[node / n] * problem.force[node][1] / problem.modulus;
        }
        self.column.clear();
        self.column.resize(problem.len(), 1.0);
        if problem.wears {
            for &node in self.closed.iter().filter(|node| it.slip[**node] > 0.0) {
                let plane = node / n;
                let own = &mut self.column[plane * n..(plane + 1) * n];
                let per_height = problem.direction * problem.slope[node] * it.pressure[node];
                problem
                    .wear
                    .open_by_pressure(&(0..n), node % n, per_height, own);
            }
        }
        let target = matrix.column_mut(m).iter_mut();
        for (entry, row) in target.zip(&self.closed) {
            *entry = self.column[*row];
        }
        *matrix.at(m, m) = 0.0;
        self.lu.factor();
    }

    /// Corrects pressures and height by the residuals; `false` if the system has no finite solution.
    fn correct(&mut self, problem: &Problem, it: &mut Iterate) -> bool {
        self.rhs.clear();
        self.rhs
            .extend(self.closed.iter().map(|node| -it.gap[*node]));
        self.rhs.push(balance(problem, it) / problem.modulus);
        if !self.lu.solve(&mut self.rhs) {
            return false;
        }
        for (node, change) in self.closed.iter().zip(&self.rhs) {
            it.pressure[*node] += change;
        }
        it.height += self.rhs[self.closed.len()];
        true
    }

    /// Slips, paths and gaps of an iterate; returns the largest gap of a closed node over the indentation.
    fn evaluate(&mut self, problem: &Problem, response: &Response, it: &mut Iterate) -> f64 {
        slide(problem, it);
        self.deformed.clear();
        self.deformed.resize(problem.len(), 0.0);
        let (deformed, pressure) = (&mut self.deformed, &it.pressure);
        vectorized(
            #[inline(always)]
            || {
                for &node in &self.closed {
                    add_scaled(deformed, pressure[node], response.column(node));
                }
            },
        );
        it.gap.clear();
        it.gap.resize(problem.len(), 0.0);
        let n = problem.nodes();
        if problem.wears {
            for (opened, path) in it.gap.chunks_exact_mut(n).zip(it.path.chunks_exact(n)) {
                problem.wear.opening().add_product(&(0..n), path, opened);
            }
        }
        let (mut indentation, mut residual, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (node, jump) in self.deformed.iter().enumerate() {
            let worn = it.gap[node];
            it.gap[node] = problem.gap[node] + it.height + jump + worn;
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

/// The load less the vertical forces, N/mm.
fn balance(problem: &Problem, it: &Iterate) -> f64 {
    let n = problem.nodes();
    let forces = it.pressure.iter().zip(&problem.force).enumerate();
    forces.fold(problem.load, |balance, (node, (p, force))| {
        balance - problem.shares[node / n] * force[1] * p
    })
}

/// Slips and paths of all nodes; no pressures at open ones.
fn slide(problem: &Problem, it: &mut Iterate) {
    it.slip.clear();
    it.path.clear();
    for (node, fixed) in problem.fixed_slip.iter().enumerate() {
        if !it.is_closed[node] {
            it.pressure[node] = 0.0;
        }
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
