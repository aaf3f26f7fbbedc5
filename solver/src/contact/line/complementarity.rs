//! The increment as a linear complementarity problem, for increments on which Newton's active set cycles.
//!
//! With the wear linearised, an increment is a linear complementarity problem (Klarbring 1986; Stewart and Trinkle
//! 1996). Per coupled node with q = a - b:
//!
//! * gap >= 0 with p >= 0, its wear linearised about the last solution p', gamma': k (p' gamma + p gamma' - p' gamma')
//!   where the rate is uniform,
//! * gamma - sigma >= 0 with a >= 0, and gamma + sigma >= 0 with b >= 0, where gamma is the slip's magnitude,
//! * mu p - a - b >= 0 with gamma >= 0,
//! * and once: load - sum of vertical forces >= 0 with the height above a bound far below any solution.
//!
//! Where slip is imposed, gamma is that of the slider's displacement and the friction part of the pressure's column.
//!
//! With equal slopes on both sides its matrix is copositive and Lemke's method finds a solution for any friction and
//! slopes: the wear adds products of p and gamma, which are not negative. The wear is relinearised about that solution
//! (Josephy 1979), and the result is the warm start of Newton's method, with the right signs.

mod layout;

use super::newton::{Convergence, Newton};
use super::problem::{Iterate, Problem};
use super::response::Response;
use super::status::Status;
use super::unknown::Unknown;
use super::wear_coupling::WearCoupling;
use crate::law::wear::LocalState;
use crate::linear::{Lemke, SquareMatrix};
use crate::number::real;
use layout::Layout;
use std::ops::Range;

/// Slack of each friction cone, over the pressures: it breaks ties of the pivoting. Arbitrary: 1e-8 and 1e-12 solve the
/// same of the hard cases (`cargo test --release -p tests hard`).
const CONE_SLACK: f64 = 1e-10;

/// Most nodes: the work grows with their cube, and beyond it Newton's method alone decides. Arbitrary, like the bounds below.
const MOST_NODES: usize = 200;
/// Most linearisations of the wear.
const MOST_LINEARISATIONS: usize = 20;
/// Newton iterations after a linearisation that changed no status.
const ITERATIONS_AFTER: usize = 12;

/// Buffers of the complementarity problem.
#[derive(Debug, Default)]
pub(super) struct Complementarity {
    lemke: Lemke,
    matrix: SquareMatrix,
    constant: Vec<f64>,
    path: Vec<f64>,
    opened: Vec<f64>,
    /// Pressure, magnitude of slip and status of each node in the last solution.
    pressure: Vec<f64>,
    slip: Vec<f64>,
    status: Vec<Status>,
}

/// Result of one linearisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Linearised {
    /// Lemke's method found a solution.
    Solution {
        /// Number of nodes whose status differs from the previous solution.
        changes: usize,
    },
    /// Lemke's method ended on a ray.
    Ray,
}

impl Complementarity {
    /// Solves for the contact state by Lemke's method and Newton's method from its solution; returns `end` if there is
    /// none.
    pub(super) fn solve(
        &mut self,
        newton: &mut Newton,
        problem: &Problem<'_>,
        response: &mut Response,
        wear: &mut WearCoupling,
        it: &mut Iterate,
        mut end: Convergence,
    ) -> Convergence {
        if it.status.len() > MOST_NODES {
            return end;
        }
        self.reset(problem, it);
        for _ in 0..MOST_LINEARISATIONS {
            // Newton's method leaves the columns of slipping nodes, whose pressures bring their friction.
            for node in 0..it.status.len() {
                response.compute(problem, Unknown::pressure(problem, node));
                if problem.tracks_slip {
                    response.compute(problem, Unknown::Shear(node));
                }
            }
            let Linearised::Solution { changes } = self.relinearise(problem, response, wear, it)
            else {
                return end;
            };
            if changes > 0 {
                continue;
            }
            self.warm_start(it);
            end = newton.solve(problem, response, wear, it, ITERATIONS_AFTER, false);
            if matches!(end, Convergence::Converged) {
                return end;
            }
        }
        end
    }

    /// Resets to no pressure, all nodes slipping by the imposed slip.
    fn reset(&mut self, problem: &Problem<'_>, it: &Iterate) {
        let n = it.status.len();
        self.pressure.clear();
        self.pressure.resize(n, 0.0);
        self.slip.clear();
        self.slip.extend((0..n).map(|i| problem.imposed_slip(i)));
        self.status.clear();
        self.status.resize(n, Status::Open);
    }

    /// Solves the increment with the wear linearised about the last solution.
    fn relinearise(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        wear: &mut WearCoupling,
        it: &Iterate,
    ) -> Linearised {
        let layout = Layout::of(problem, response, it);
        let solution = self.pressure.iter().zip(&self.slip);
        wear.linearise(
            problem.coupling,
            problem.pair,
            &solution.map(|(&pressure, &slip)| LocalState {
                pressure,
                slip,
                ..LocalState::default()
            }),
        );
        self.assemble(problem, response, wear, layout);
        let Some(z) = self.lemke.solve(&self.matrix, &self.constant) else {
            return Linearised::Ray;
        };
        let mut changes = 0;
        for (i, p) in z[..layout.n].iter().enumerate() {
            self.pressure[i] = p * layout.pressure;
            let [a, b, gamma] = if layout.sheared {
                layout.shear(i).map(|row| z[row])
            } else {
                [1.0, 0.0, 0.0]
            };
            self.slip[i] = if layout.sheared {
                gamma * layout.length
            } else {
                problem.imposed_slip(i)
            };
            // Both shears are in the basis only where both slips are zero.
            let stuck = layout.sheared && (gamma <= 0.0 || (a > 0.0 && b > 0.0));
            let status = if *p <= 0.0 {
                Status::Open
            } else if stuck {
                Status::Stick
            } else if layout.sheared {
                Status::slip(a - b)
            } else {
                Status::slip(problem.step)
            };
            changes += usize::from(self.status[i] != status);
            self.status[i] = status;
        }
        Linearised::Solution { changes }
    }

    /// Writes the last solution to the iterate of Newton's method.
    fn warm_start(&self, it: &mut Iterate) {
        it.status.copy_from_slice(&self.status);
        it.pressure.copy_from_slice(&self.pressure);
        for (slip, (size, status)) in it.slip.iter_mut().zip(self.slip.iter().zip(&self.status)) {
            *slip = size * status.direction();
        }
    }

    fn assemble(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        wear: &WearCoupling,
        layout: Layout,
    ) {
        self.matrix.reset(layout.order());
        self.constant.clear();
        self.constant.resize(layout.order(), 0.0);
        for a in 0..layout.n {
            self.pressure_column(problem, response, wear, layout, a);
            if layout.sheared {
                self.shear_columns(problem, response, wear, layout, a);
            }
        }
        self.height_column(problem, layout);
        self.assemble_constant(problem, wear, layout);
    }

    fn pressure_column(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        wear: &WearCoupling,
        layout: Layout,
        a: usize,
    ) {
        let span = self.reset_opened();
        wear.open_by_pressure(&span, a, self.slip[a], &mut self.opened);
        let scale = layout.pressure / layout.length;
        let pressure = Unknown::pressure(problem, a);
        let (gaps, jumps) = response.column(pressure);
        for (i, gap) in gaps.iter().enumerate() {
            *self.matrix.at(i, a) = (gap + self.opened[i]) * scale;
        }
        if layout.sheared {
            for (i, jump) in jumps.iter().enumerate() {
                let [right, left, _] = layout.shear(i);
                *self.matrix.at(right, a) = -jump * scale;
                *self.matrix.at(left, a) = jump * scale;
            }
            *self.matrix.at(layout.shear(a)[2], a) = problem.friction.at(a);
        }
        let [_, force] = pressure.force(problem);
        *self.matrix.at(layout.height(), a) = -problem.force_weight() * force / mean_width(problem);
    }

    fn shear_columns(
        &mut self,
        problem: &Problem<'_>,
        response: &Response,
        wear: &WearCoupling,
        layout: Layout,
        k: usize,
    ) {
        let scale = layout.pressure / layout.length;
        let shear = Unknown::Shear(k);
        let (gaps, jumps) = response.column(shear);
        let [a, b, gamma] = layout.shear(k);
        let [_, force] = shear.force(problem);
        let lean = -problem.force_weight() * force / mean_width(problem);
        for (sign, place) in [(1.0, a), (-1.0, b)] {
            for (i, (gap, jump)) in gaps.iter().zip(jumps).enumerate() {
                let [right, left, _] = layout.shear(i);
                *self.matrix.at(i, place) = sign * gap * scale;
                *self.matrix.at(right, place) = -sign * jump * scale;
                *self.matrix.at(left, place) = sign * jump * scale;
            }
            *self.matrix.at(gamma, place) = -1.0;
            *self.matrix.at(place, gamma) = 1.0;
            *self.matrix.at(layout.height(), place) = sign * lean;
        }
        if self.pressure[k] > 0.0 {
            let span = self.reset_opened();
            wear.open_by_slip(&span, k, self.pressure[k], &mut self.opened);
            for (i, opened) in self.opened.iter().enumerate() {
                *self.matrix.at(i, gamma) = *opened;
            }
        }
    }

    /// Resets the opened gaps to zero; returns the range of their nodes.
    fn reset_opened(&mut self) -> Range<usize> {
        let n = self.pressure.len();
        self.opened.clear();
        self.opened.resize(n, 0.0);
        0..n
    }

    /// Gaps that the linearised wear subtracts at the last solution: (W_p + W_s - W) e.
    fn open_path(&mut self, wear: &WearCoupling) {
        let span = self.reset_opened();
        wear.per_pressure()
            .add_product(&span, &self.path, &mut self.opened);
        if wear.varies() {
            wear.per_slip()
                .add_product(&span, &self.path, &mut self.opened);
            wear.opening()
                .subtract_product(&span, &self.path, &mut self.opened);
        }
    }

    /// The same of the wear that is no product with the path; where slip is imposed, it does not change.
    fn open_other(&mut self, wear: &WearCoupling, sheared: bool) {
        let Some(other) = wear.other_opening() else {
            return;
        };
        let span = 0..self.pressure.len();
        other
            .per_pressure
            .add_product(&span, &self.pressure, &mut self.opened);
        if sheared {
            other
                .per_slip
                .add_product(&span, &self.slip, &mut self.opened);
        }
        for (sum, opened) in self.opened.iter_mut().zip(&other.opened) {
            *sum -= opened;
        }
    }

    fn height_column(&mut self, problem: &Problem<'_>, layout: Layout) {
        let v = layout.height();
        for i in 0..layout.n {
            *self.matrix.at(i, v) = 1.0 + problem.sag[i];
            if layout.sheared {
                let [right, left, _] = layout.shear(i);
                *self.matrix.at(right, v) = -problem.slope[i];
                *self.matrix.at(left, v) = problem.slope[i];
            }
        }
        *self.matrix.at(v, v) =
            problem.spring * layout.length / (layout.pressure * mean_width(problem));
    }

    fn assemble_constant(&mut self, problem: &Problem<'_>, wear: &WearCoupling, layout: Layout) {
        self.path.clear();
        if layout.sheared {
            let paths = self
                .pressure
                .iter()
                .zip(&self.slip)
                .map(|(p, slip)| p * slip);
            self.path.extend(paths);
        } else {
            self.path.resize(layout.n, 0.0);
        }
        self.open_path(wear);
        self.open_other(wear, layout.sheared);
        for i in 0..layout.n {
            let raised = (1.0 + problem.sag[i]) * layout.lowest;
            self.constant[i] = (problem.gap[i] + raised - self.opened[i]) / layout.length;
            if layout.sheared {
                let slip = problem.fixed_slip[i] + problem.slope[i] * layout.lowest;
                let [right, left, gamma] = layout.shear(i);
                self.constant[right] = -slip / layout.length;
                self.constant[left] = slip / layout.length;
                self.constant[gamma] = CONE_SLACK * (1.0 + real(i) / real(layout.n));
            }
        }
        let load = problem.load + problem.spring * layout.lowest;
        self.constant[layout.height()] = load / (layout.pressure * mean_width(problem));
    }
}

fn mean_width(problem: &Problem<'_>) -> f64 {
    problem.width.iter().sum::<f64>() / real(problem.width.len())
}
