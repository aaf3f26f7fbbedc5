//! Semi-smooth Newton on the active nodes: Signorini, Coulomb and implicit Archard wear in one system.
//!
//! Unknowns are p of every closed node, q of every sticking node and the rigid height v. With e = p |sigma| the
//! equations are, for each closed node, the vanishing gap
//!   g_i = g0_i + v + N_i . (G F)_i + kappa_r e_i + (wear of the slider carried by the mortar)_i = 0,
//! for each sticking node sigma_i = 0, for each slipping one q = mu p sign(sigma), and the vertical balance
//! sum d_i (p_i - q_i s_i) = P + k_spring (v - v_0). All terms are linear but e, which is linearised in p and sigma.
//! Choosing the status from the signs of the last iterate is the primal-dual form of the semi-smooth Newton method
//! (Alart and Curnier 1991; Hueeber and Wohlmuth 2005); it needs no parameter.
//!
//! The Jacobian is factored once for most increments. Statuses change at the edges of the contact and of its stick zones; the
//! system is condensed onto the nodes there, so that they may open, close, slip and stick without another factorisation. Later
//! iterations are chord steps (Kelley 1995, section 5.4.1): the residual is exact, and the factors are renewed where it
//! converges slowly.

mod correction;
mod evaluation;
mod hierarchical;
mod jacobian;
mod partition;
mod secant;
mod system;

use super::active_set;
use super::deformation::WIDE;
use super::problem::{Iterate, Problem};
use super::response::Response;
use super::status::Status;
use super::unknown::Unknown;
use super::wear_coupling::WearCoupling;
use super::work::Work;
use crate::number::count;
use correction::{Correction, settle};
use evaluation::Evaluation;
use jacobian::Jacobian;
use partition::Partition;
use system::System;

/// End of the Newton iteration.
pub(super) enum Convergence {
    /// Statuses and gaps have converged.
    Converged,
    /// The linear system had no finite solution.
    Singular { active: usize },
    /// Too many iterations.
    NotConverged { residual: f64, changes: usize },
}

/// Buffers of the iteration.
#[derive(Default)]
pub(super) struct Newton {
    partition: Partition,
    jacobian: Jacobian,
    system: System,
    correction: Correction,
    evaluation: Evaluation,
    /// Factorizations, and unknowns of their systems, since the last reset.
    pub(super) work: Work,
    /// Change of the pressure of each node per height, MPa/mm, and of the vertical force, N/mm per mm.
    pressure_per_height: Vec<f64>,
    force_per_height: f64,
}

/// Change of the contact with a given height.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeightResponse<'a> {
    /// Response of the pressures of the coupled nodes, MPa/mm.
    pub(super) pressure: &'a [f64],
    /// Response of the vertical force, N/mm per mm.
    pub(super) force: f64,
}

/// A residual within so many tolerances that another iteration did not halve, without a change of status, is the
/// round-off of an ill-conditioned system.
const STALLED_WITHIN: f64 = 10.0;

/// Largest imbalance of the vertical forces over the load on the unworn contact. The balance is linear: a correction leaves
/// some 1e-15 of it, unless it starts from the height of 1e20 mm that a singular system gave.
const BALANCE_TOLERANCE: f64 = 1e-9;

/// Factors are renewed where an iteration without a change of status leaves more than this part of the residual. Arbitrary:
/// 0.03 and 0.3 take as long, to 2 %.
const SLOW: f64 = 0.1;

/// Fewest unknowns of a core whose off-diagonal blocks are approximated. Arbitrary: with 150 and 300 contacts of 160 to 640 nodes take as
/// long, to 20 % (`cargo bench -p solver -- partial_slip`).
const LEAST_CORE: usize = 250;

/// From this iteration on factors are renewed in each, for systems that chord steps do not solve. Arbitrary: 6 and 20 take as
/// long, to 1 %.
const EXACT_FROM: usize = 12;

impl Newton {
    /// Iterates from the statuses and pressures of `it` until they converge, at most so many times; with the factors of the last
    /// solution if this problem is a repeated one.
    pub(super) fn solve(
        &mut self,
        problem: &Problem<'_>,
        response: &mut Response,
        wear: &mut WearCoupling,
        it: &mut Iterate,
        most_iterations: usize,
        repeated: bool,
    ) -> Convergence {
        let (mut residual, mut changes) = (f64::INFINITY, usize::MAX);
        let (mut renew, mut exact_from) = (true, EXACT_FROM);
        if repeated {
            settle(problem, it);
            if self.partition.admits(it) {
                residual = self.evaluate(problem, response, wear, it);
                renew = false;
            }
        }
        for iteration in 0..most_iterations {
            let renewed = renew || !self.partition.admits(it);
            if renewed {
                residual = self.linearise(problem, response, wear, it, iteration < exact_from);
            }
            let last = (residual, changes);
            let partition = &self.partition;
            let (system, altered) = (&mut self.system, renewed || last.1 > 0);
            if !self
                .correction
                .apply(problem, partition, system, altered, it)
            {
                if self.system.is_hierarchical() {
                    // A cluster of its core may be singular although the core is not.
                    (renew, exact_from) = (true, iteration);
                    continue;
                }
                return Convergence::Singular {
                    active: self.partition.unknowns.len(),
                };
            }
            let tolerance = it.tolerance;
            residual = self.evaluate(problem, response, wear, it);
            changes = active_set::update(problem, it, iteration);
            let stalled = has_stalled(last.0 / tolerance, last.1, residual / it.tolerance);
            let unbalanced = BALANCE_TOLERANCE * problem.pair.interface.load;
            let is_balanced = || self.partition.balance(problem, it).abs() <= unbalanced;
            if changes == 0 && (residual <= it.tolerance || stalled) && is_balanced() {
                return Convergence::Converged;
            }
            // Without a contact only a spring that has lost its force is in equilibrium.
            if problem.spring <= 0.0 && it.status.iter().all(|s| *s == Status::Open) {
                return Convergence::Singular { active: 0 };
            }
            let slow = changes == 0 && last.1 == 0 && residual > SLOW * last.0;
            renew = slow || iteration + 1 >= exact_from;
        }
        Convergence::NotConverged { residual, changes }
    }

    /// Determines the change of a converged contact with the height that it is given, by the last linearisation: to a thousandth where
    /// its core is approximated.
    pub(super) fn respond_to_height(&mut self, problem: &Problem<'_>, it: &Iterate) {
        let pressures = &mut self.pressure_per_height;
        pressures.clear();
        pressures.resize(it.status.len(), 0.0);
        self.force_per_height = 0.0;
        let partition = &self.partition;
        let system = &mut self.system;
        let changes = self.correction.per_height(problem, partition, system, it);
        for (unknown, change) in partition.unknowns.iter().zip(changes) {
            if let Unknown::Pressure(node, _) = *unknown {
                pressures[node] = *change;
            }
            self.force_per_height += change * unknown.force(problem)[1];
        }
    }

    /// The change that was last determined; of no increment whose height was not given.
    pub(super) fn response_to_height(&self) -> HeightResponse<'_> {
        HeightResponse {
            pressure: &self.pressure_per_height,
            force: self.force_per_height,
        }
    }

    /// Chooses the unknowns for the statuses of an iterate and linearises about it; returns its residual.
    fn linearise(
        &mut self,
        problem: &Problem<'_>,
        response: &mut Response,
        wear: &mut WearCoupling,
        it: &mut Iterate,
        lumped: bool,
    ) -> f64 {
        settle(problem, it);
        self.partition.choose(it);
        let partition = &self.partition;
        let (unknowns, core) = (&partition.unknowns, partition.core);
        // Later linearisations are exact.
        let is_hierarchical = lumped && it.status.len() >= WIDE && core >= LEAST_CORE;
        let responding = if is_hierarchical { core } else { 0 };
        for unknown in &unknowns[responding..] {
            response.compute(problem, *unknown);
        }
        let residual = self
            .evaluation
            .evaluate(problem, unknowns, response, wear, it);
        let (system, jacobian) = (&mut self.system, &mut self.jacobian);
        jacobian.linearise_wear(problem, partition, wear, it, lumped);
        if is_hierarchical {
            let blocks = system.hierarchical(core, unknowns.len() + 1 - core);
            jacobian.assemble_hierarchical(problem, partition, response, wear, it, blocks);
            self.work.response_entries += std::mem::take(&mut jacobian.hierarchical.entries);
        } else {
            let matrix = system.dense(unknowns.len() + 1);
            jacobian.assemble(problem, partition, response, wear, it, matrix);
        }
        system.condense(core);
        self.work.factorizations += 1;
        self.work.unknowns += count(unknowns.len() + 1);
        residual
    }

    fn evaluate(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        wear: &mut WearCoupling,
        it: &mut Iterate,
    ) -> f64 {
        let unknowns = &self.partition.unknowns;
        self.evaluation
            .evaluate(problem, unknowns, response, wear, it)
    }
}

/// Returns `true` if the iteration has stalled at round-off: no change of status, and a residual, over its tolerance, that was
/// not halved.
fn has_stalled(last: f64, changes: usize, residual: f64) -> bool {
    changes == 0 && residual <= STALLED_WITHIN && 2.0 * residual > last
}
