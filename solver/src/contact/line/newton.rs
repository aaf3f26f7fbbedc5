//! Semi-smooth Newton on the active nodes: Signorini, Coulomb and implicit Archard wear in one system.
//!
//! Unknowns are p of every closed node, q of every sticking node and the rigid height v. With e = p |sigma| the
//! equations are, for each closed node, the vanishing gap
//!   g_i = g0_i + v + N_i . (G F)_i + kappa_r e_i + (wear of the slider carried by the mortar)_i = 0,
//! for each sticking node sigma_i = 0, for each slipping one q = mu p sign(sigma), and the vertical balance
//! sum d_i (p_i - q_i s_i) = P + k_spring (v - v_0). All terms are linear but e, which is linearised in p and sigma.
//! Choosing the status from the signs of the last iterate is the primal-dual form of the semi-smooth Newton method
//! (Alart and Curnier 1991; Hueeber and Wohlmuth 2005); it needs no parameter.

use std::ops::Range;

use super::active_set;
use super::band::Band;
use super::problem::{GAP_TOLERANCE, Iterate, Problem};
use super::response::Response;
use super::status::Status;
use super::wear_coupling::WearCoupling;
use crate::linear::{DenseLu, SquareMatrix};

/// End of the Newton iteration.
pub(super) enum Convergence {
    /// Statuses and gaps have converged.
    Converged,
    /// The linear system had no finite solution.
    Singular { active: usize },
    /// Too many iterations.
    NotConverged { residual: f64, changes: usize },
}

/// An unknown: a traction at a coupled node.
#[derive(Debug, Clone, Copy)]
enum Unknown {
    Pressure(usize),
    Shear(usize),
}

/// Buffers of the iteration.
#[derive(Default)]
pub(super) struct Newton {
    unknowns: Vec<Unknown>,
    /// Row of the normal and of the tangential equation of each coupled node.
    rows: Vec<[usize; 2]>,
    jacobian: SquareMatrix,
    rhs: Vec<f64>,
    /// Gaps and slips of the coupled nodes per unit of an unknown.
    gap: Vec<f64>,
    slip: Vec<f64>,
    /// Paths of the closed nodes.
    path: Vec<f64>,
    /// Gap opened by wear, per slip.
    opening: Band,
    lu: DenseLu,
}

/// A residual within so many tolerances that another iteration did not halve, without a change of status, is the
/// round-off of an ill-conditioned system.
const STALLED_WITHIN: f64 = 10.0;

/// Round-off of a gap over the largest length in its sum: some units in the last place.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

const NO_ROW: usize = usize::MAX;

impl Newton {
    /// Iterates from the statuses and pressures of `it` until they converge.
    pub(super) fn solve(
        &mut self,
        problem: &Problem<'_>,
        response: &mut Response,
        wear: &mut WearCoupling,
        it: &mut Iterate,
        most_iterations: usize,
    ) -> Convergence {
        let (mut residual, mut changes) = (f64::INFINITY, usize::MAX);
        for iteration in 0..most_iterations {
            let last = (residual / it.tolerance, changes);
            self.assign_dofs(it);
            for a in (0..it.status.len()).filter(|a| it.status[*a] != Status::Open) {
                response.compute(problem, a);
            }
            self.assemble(problem, response, wear, it);
            if !self.lu.solve(&mut self.jacobian, &mut self.rhs) {
                return Convergence::Singular {
                    active: self.unknowns.len(),
                };
            }
            self.scatter(problem, it);
            residual = self.evaluate(problem, response, wear, it);
            changes = active_set::update(problem, it, iteration);
            let stalled = has_stalled(last, residual / it.tolerance);
            if changes == 0 && (residual <= it.tolerance || stalled) {
                return Convergence::Converged;
            }
            // Without a contact only a spring that has lost its force is in equilibrium.
            if problem.spring <= 0.0 && it.status.iter().all(|s| *s == Status::Open) {
                return Convergence::Singular { active: 0 };
            }
        }
        Convergence::NotConverged { residual, changes }
    }

    fn assign_dofs(&mut self, it: &Iterate) {
        self.unknowns.clear();
        self.rows.clear();
        for (i, status) in it.status.iter().enumerate() {
            let mut rows = [NO_ROW; 2];
            if *status != Status::Open {
                rows[0] = self.unknowns.len();
                self.unknowns.push(Unknown::Pressure(i));
            }
            if *status == Status::Stick {
                rows[1] = self.unknowns.len();
                self.unknowns.push(Unknown::Shear(i));
            }
            self.rows.push(rows);
        }
    }

    fn assemble(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        wear: &mut WearCoupling,
        it: &Iterate,
    ) {
        let order = self.unknowns.len() + 1;
        let span = closed_span(&it.status);
        self.jacobian.reshape(order);
        self.gap.resize(it.status.len(), 0.0);
        self.slip.resize(it.status.len(), 0.0);
        if problem.wears {
            let per_slip = |l: usize| it.status[l].direction() * it.pressure[l];
            wear.linearise(
                problem.pair.interface.slave,
                (0..it.status.len()).map(|l| it.local_state(l)),
            );
            wear.per_slip()
                .combine(per_slip, |_| 0.0, &mut self.opening);
        }
        for u in 0..order - 1 {
            let unknown = self.unknowns[u];
            self.unit_response(problem, response, it, &span, unknown);
            if problem.wears {
                self.opening.add_product(&span, &self.slip, &mut self.gap);
                if let Unknown::Pressure(a) = unknown {
                    let slip = it.local_state(a).slip;
                    wear.per_pressure()
                        .add_column(&span, a, slip, &mut self.gap);
                }
            }
            self.write_column(u);
            *self.jacobian.at(order - 1, u) = match unknown {
                Unknown::Pressure(a) => {
                    let lean = it.status[a].direction() * problem.friction * problem.slope[a];
                    problem.width[a] * (1.0 - lean)
                }
                Unknown::Shear(a) => -problem.width[a] * problem.slope[a],
            };
        }
        for i in span.clone() {
            self.gap[i] = 1.0 + problem.sag[i];
            self.slip[i] = problem.slope[i];
        }
        if problem.wears {
            self.opening.add_product(&span, &self.slip, &mut self.gap);
        }
        self.write_column(order - 1);
        *self.jacobian.at(order - 1, order - 1) = -problem.spring;
        self.assemble_rhs(problem, wear, it, &span);
    }

    /// Gaps and slips of a span of nodes per unit of one unknown.
    fn unit_response(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        it: &Iterate,
        span: &Range<usize>,
        unknown: Unknown,
    ) {
        let (node, normal, tangential) = match unknown {
            Unknown::Pressure(a) => {
                let d = problem.width[a];
                (a, d, -it.status[a].direction() * problem.friction * d)
            }
            Unknown::Shear(a) => (a, 0.0, -problem.width[a]),
        };
        let (along_n, along_t) = (response.along_normal(node), response.along_tangent(node));
        let combine = |target: &mut [f64], n: &[f64], t: &[f64]| {
            for (sum, (n, t)) in target.iter_mut().zip(n.iter().zip(t)) {
                *sum = normal * n + tangential * t;
            }
        };
        let of = |values| part(values, span);
        combine(&mut self.gap[span.clone()], of(along_n.0), of(along_t.0));
        combine(&mut self.slip[span.clone()], of(along_n.1), of(along_t.1));
    }

    fn write_column(&mut self, u: usize) {
        let target = self.jacobian.column_mut(u);
        for (row, unknown) in target.iter_mut().zip(&self.unknowns) {
            *row = match unknown {
                Unknown::Pressure(i) => self.gap[*i],
                Unknown::Shear(i) => self.slip[*i],
            };
        }
    }

    fn assemble_rhs(
        &mut self,
        problem: &Problem<'_>,
        wear: &WearCoupling,
        it: &Iterate,
        span: &Range<usize>,
    ) {
        for i in span.clone() {
            self.gap[i] = problem.gap[i];
            self.slip[i] = problem.fixed_slip[i] - it.slip[i];
        }
        if problem.wears {
            self.opening.add_product(span, &self.slip, &mut self.gap);
            self.add_curvature(wear, it, span);
        }
        self.rhs.clear();
        for unknown in &self.unknowns {
            self.rhs.push(match unknown {
                Unknown::Pressure(i) => -self.gap[*i],
                Unknown::Shear(i) => -problem.fixed_slip[*i],
            });
        }
        self.rhs.push(problem.load);
    }

    /// Adds the part of the opening that its linearisation in p leaves over where rates vary, W e - W_p e.
    fn add_curvature(&mut self, wear: &WearCoupling, it: &Iterate, span: &Range<usize>) {
        if !wear.varies() {
            return;
        }
        let path = |l: usize| it.pressure[l] * it.local_state(l).slip;
        self.path.clear();
        self.path.extend((0..it.status.len()).map(path));
        wear.opening().add_product(span, &self.path, &mut self.gap);
        wear.per_pressure()
            .subtract_product(span, &self.path, &mut self.gap);
    }

    fn scatter(&self, problem: &Problem<'_>, it: &mut Iterate) {
        for (i, rows) in self.rows.iter().enumerate() {
            let p = if rows[0] == NO_ROW {
                0.0
            } else {
                self.rhs[rows[0]]
            };
            it.pressure[i] = p;
            it.shear[i] = if rows[1] == NO_ROW {
                it.status[i].direction() * problem.friction * p
            } else {
                self.rhs[rows[1]]
            };
        }
        it.height = self.rhs[self.unknowns.len()];
    }

    /// Slips, paths and gaps of the iterate; returns the largest gap of a closed node over the indentation.
    fn evaluate(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        wear: &mut WearCoupling,
        it: &mut Iterate,
    ) -> f64 {
        let n = it.status.len();
        for values in [&mut self.gap, &mut self.slip, &mut it.gap] {
            values.clear();
            values.resize(n, 0.0);
        }
        for a in (0..n).filter(|a| it.status[*a] != Status::Open) {
            let normal = problem.width[a] * it.pressure[a];
            let tangential = -problem.width[a] * it.shear[a];
            let (along_n, along_t) = (response.along_normal(a), response.along_tangent(a));
            add(&mut self.gap, normal, along_n.0, tangential, along_t.0);
            add(&mut self.slip, normal, along_n.1, tangential, along_t.1);
        }
        let mut indentation = 0.0_f64;
        for (i, jump) in self.slip.iter().enumerate() {
            it.slip[i] = problem.fixed_slip[i] + problem.slope[i] * it.height + jump;
            let slips = it.status[i].direction() * it.slip[i];
            it.path[i] = (it.pressure[i] * slips).max(0.0);
            if it.status[i] != Status::Open {
                indentation = indentation.max(self.gap[i].abs());
            }
        }
        // The wear alone first: it is part of the scale of gaps.
        if problem.wears {
            wear.linearise(
                problem.pair.interface.slave,
                (0..n).map(|l| it.local_state(l)),
            );
            wear.opening().add_product(&(0..n), &it.path, &mut it.gap);
        }
        let (mut residual, mut largest) = (0.0_f64, 0.0_f64);
        for (i, jump) in self.gap.iter().enumerate() {
            let raised = (1.0 + problem.sag[i]) * it.height;
            let worn = it.gap[i];
            it.gap[i] = problem.gap[i] + raised + jump + worn;
            if it.status[i] != Status::Open {
                indentation = indentation.max(worn);
                residual = residual.max(it.gap[i].abs());
                // A closed gap is the difference of the undeformed gap and the height, each at most this large unless
                // the system was nearly singular.
                largest = largest.max(2.0 * problem.gap[i].abs());
            }
        }
        it.indentation = indentation;
        let scale = indentation.max(f64::MIN_POSITIVE);
        it.tolerance = GAP_TOLERANCE.max(ROUND_OFF * largest / scale);
        residual / scale
    }
}

/// Whether the iteration has stalled at round-off: no change of status, and a residual, over its tolerance, that was
/// not halved.
fn has_stalled((last, changes): (f64, usize), residual: f64) -> bool {
    changes == 0 && residual <= STALLED_WITHIN && 2.0 * residual > last
}

fn part<'a>(values: &'a [f64], span: &Range<usize>) -> &'a [f64] {
    &values[span.clone()]
}

/// sum += a x + b y.
fn add(sum: &mut [f64], a: f64, x: &[f64], b: f64, y: &[f64]) {
    for (sum, (x, y)) in sum.iter_mut().zip(x.iter().zip(y)) {
        *sum += a * x + b * y;
    }
}

/// From the first node in contact to the last.
fn closed_span(status: &[Status]) -> Range<usize> {
    let closed = |s: &Status| *s != Status::Open;
    let first = status.iter().position(closed).unwrap_or(0);
    let last = status.iter().rposition(closed).map_or(first, |i| i + 1);
    first..last
}
