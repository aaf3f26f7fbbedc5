//! Semi-smooth Newton on the active nodes: Signorini, Coulomb and implicit Archard wear in one system.
//!
//! Unknowns are p of every closed node, q of every sticking node and the rigid height v. With e = p |sigma| the
//! equations are, for each closed node, the vanishing gap
//!   g_i = g0_i + v + N_i . (G F)_i + kappa_r e_i + (wear of the slider carried by the mortar)_i = 0,
//! for each sticking node sigma_i = 0, for each slipping one q = mu p sign(sigma), and the vertical balance
//! sum d_i (p_i - q_i s_i) = P + k_spring (v - v_0). All terms are linear but e, which is linearised in p and sigma. Choosing the
//! status from the signs of the last iterate is the primal-dual form of the semi-smooth Newton method
//! (Alart and Curnier 1991; Hueeber and Wohlmuth 2005); it needs no parameter.

use super::GAP_TOLERANCE;
use super::mortar::Coupling;
use super::recession::opened_by_wear;
use super::response::Response;
use super::status::{self, Status};
use crate::linear::{DenseLu, SquareMatrix};

/// What one increment asks for, over the coupled nodes.
pub(super) struct Problem<'a> {
    pub(super) coupling: &'a Coupling,
    pub(super) response: &'a Response,
    /// Gap of the worn, undeformed bodies at height 0, mm.
    pub(super) gap: &'a [f64],
    /// Projected widths of the coupled nodes, mm.
    pub(super) width: &'a [f64],
    pub(super) slope: &'a [f64],
    /// Projected widths of the slider's nodes, mm.
    pub(super) slider_width: &'a [f64],
    pub(super) friction: f64,
    /// Vertical load at height 0, N/mm, and what it gains a mm of height.
    pub(super) load: f64,
    pub(super) spring: f64,
    /// Gap that the slider opens by deforming under its far-face load as the height grows, mm per mm.
    pub(super) sag: &'a [f64],
    /// k times cycles, receptacle and slider, 1/MPa.
    pub(super) kappa: [f64; 2],
    /// How far the slider travels over the receptacle in this increment, mm.
    pub(super) travel: f64,
    /// How far its surface is to slip: the travel and what it runs past besides, mm.
    pub(super) step: f64,
    pub(super) last_height: f64,
}

/// Iterate over the coupled nodes.
#[derive(Debug, Default)]
pub(super) struct Iterate {
    pub(super) status: Vec<Status>,
    pub(super) pressure: Vec<f64>,
    pub(super) shear: Vec<f64>,
    /// Tangential slip in this increment, mm.
    pub(super) slip: Vec<f64>,
    /// p |sigma| of this increment, MPa mm.
    pub(super) path: Vec<f64>,
    /// Gap with deformation and wear, mm.
    pub(super) gap: Vec<f64>,
    pub(super) height: f64,
    pub(super) indentation: f64,
    /// Gap residual, over the indentation, that ends the iteration.
    pub(super) tolerance: f64,
}

/// How an iteration ended.
pub(super) enum End {
    /// Settled: statuses and gaps.
    Settled,
    /// The linear system had no finite solution.
    Singular { active: usize },
    /// Too many iterations.
    Unsettled { residual: f64, changes: usize },
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
    column: Vec<f64>,
    path_change: Vec<f64>,
    worn: Vec<f64>,
    recession: Vec<f64>,
    lu: DenseLu,
}

/// Round-off of a gap, over the largest length that it is the difference of: some units in the last place.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

const NO_ROW: usize = usize::MAX;

impl Newton {
    /// Iterates from the statuses and pressures of `it` until they settle.
    pub(super) fn solve(
        &mut self,
        problem: &Problem<'_>,
        it: &mut Iterate,
        most_iterations: usize,
    ) -> End {
        let (mut residual, mut changes) = (f64::INFINITY, 0);
        for iteration in 0..most_iterations {
            self.number(it);
            self.assemble(problem, it);
            if !self.lu.solve(&mut self.jacobian, &mut self.rhs) {
                return End::Singular {
                    active: self.unknowns.len(),
                };
            }
            self.read(problem, it);
            residual = self.evaluate(problem, it);
            changes = status::update(problem, it, iteration);
            if changes == 0 && residual <= it.tolerance {
                return End::Settled;
            }
            // Nothing but a spring that has lost its force is in equilibrium without a contact.
            if problem.spring <= 0.0 && it.status.iter().all(|s| *s == Status::Open) {
                return End::Singular { active: 0 };
            }
        }
        End::Unsettled { residual, changes }
    }

    fn number(&mut self, it: &Iterate) {
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

    fn assemble(&mut self, problem: &Problem<'_>, it: &Iterate) {
        let order = self.unknowns.len() + 1;
        self.jacobian.reset(order);
        self.rhs.clear();
        self.rhs.resize(order, 0.0);
        for u in 0..order - 1 {
            let unknown = self.unknowns[u];
            self.respond(problem, it, unknown);
            let own = match unknown {
                Unknown::Pressure(a) if it.status[a] != Status::Stick => {
                    Some((a, (it.status[a].direction() * it.slip[a]).max(0.0)))
                }
                _ => None,
            };
            self.add_wear(problem, it, own);
            self.write_column(u);
            *self.jacobian.at(order - 1, u) = match unknown {
                Unknown::Pressure(a) => {
                    let lean = it.status[a].direction() * problem.friction * problem.slope[a];
                    problem.width[a] * (1.0 - lean)
                }
                Unknown::Shear(a) => -problem.width[a] * problem.slope[a],
            };
        }
        self.column.clear();
        let places = problem.slope.iter().zip(problem.sag);
        self.column
            .extend(places.flat_map(|(s, sag)| [1.0 + sag, *s]));
        self.add_wear(problem, it, None);
        self.write_column(order - 1);
        self.assemble_rhs(problem, it);
        *self.jacobian.at(order - 1, order - 1) = -problem.spring;
        self.rhs[order - 1] = problem.load;
    }

    /// Jump of all coupled nodes per unit of one unknown.
    fn respond(&mut self, problem: &Problem<'_>, it: &Iterate, unknown: Unknown) {
        let g = &problem.response.local;
        let (node, normal, tangential) = match unknown {
            Unknown::Pressure(a) => {
                let d = problem.width[a];
                (a, d, -it.status[a].direction() * problem.friction * d)
            }
            Unknown::Shear(a) => (a, 0.0, -problem.width[a]),
        };
        let (n, t) = (g.column(2 * node), g.column(2 * node + 1));
        self.column.clear();
        self.column
            .extend(n.iter().zip(t).map(|(n, t)| normal * n + tangential * t));
    }

    /// Adds to the column's gaps the wear that its slips and its own pressure make.
    fn add_wear(&mut self, problem: &Problem<'_>, it: &Iterate, own: Option<(usize, f64)>) {
        if problem.kappa[0] + problem.kappa[1] <= 0.0 {
            return;
        }
        self.path_change.clear();
        self.path_change.extend(
            it.status
                .iter()
                .enumerate()
                .map(|(l, status)| status.direction() * it.pressure[l] * self.column[2 * l + 1]),
        );
        if let Some((a, slip)) = own {
            self.path_change[a] += slip;
        }
        self.wear_of_change(problem);
        for (column, worn) in self.column.chunks_exact_mut(2).zip(&self.worn) {
            column[0] += worn;
        }
    }

    /// Gap opened at each coupled node by wear of `path_change`, on both sides.
    fn wear_of_change(&mut self, problem: &Problem<'_>) {
        opened_by_wear(
            problem,
            &self.path_change,
            &mut self.recession,
            &mut self.worn,
        );
    }

    fn write_column(&mut self, u: usize) {
        let target = self.jacobian.column_mut(u);
        for (rows, response) in self.rows.iter().zip(self.column.chunks_exact(2)) {
            for (row, r) in rows.iter().zip(response) {
                if *row != NO_ROW {
                    target[*row] = *r;
                }
            }
        }
    }

    fn assemble_rhs(&mut self, problem: &Problem<'_>, it: &Iterate) {
        self.path_change.clear();
        for (l, status) in it.status.iter().enumerate() {
            let fixed = fixed_slip(problem, l) - it.slip[l];
            self.path_change
                .push(status.direction() * it.pressure[l] * fixed);
        }
        self.wear_of_change(problem);
        for (i, rows) in self.rows.iter().enumerate() {
            if rows[0] != NO_ROW {
                self.rhs[rows[0]] = -problem.gap[i] - self.worn[i];
            }
            if rows[1] != NO_ROW {
                self.rhs[rows[1]] = -fixed_slip(problem, i);
            }
        }
    }

    fn read(&self, problem: &Problem<'_>, it: &mut Iterate) {
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
    fn evaluate(&mut self, problem: &Problem<'_>, it: &mut Iterate) -> f64 {
        let g = &problem.response.local;
        self.column.clear();
        self.column.resize(g.order(), 0.0);
        for a in 0..it.status.len() {
            if it.status[a] == Status::Open {
                continue;
            }
            let normal = problem.width[a] * it.pressure[a];
            let tangential = -problem.width[a] * it.shear[a];
            let columns = g.column(2 * a).iter().zip(g.column(2 * a + 1));
            for (sum, (n, t)) in self.column.iter_mut().zip(columns) {
                *sum += normal * n + tangential * t;
            }
        }
        self.path_change.clear();
        let mut indentation = 0.0_f64;
        for (i, jump) in self.column.chunks_exact(2).enumerate() {
            it.slip[i] = fixed_slip(problem, i) + problem.slope[i] * it.height + jump[1];
            let slips = it.status[i].direction() * it.slip[i];
            it.path[i] = (it.pressure[i] * slips).max(0.0);
            self.path_change.push(it.path[i]);
            if it.status[i] != Status::Open {
                indentation = indentation.max(jump[0].abs());
            }
        }
        self.wear_of_change(problem);
        let (mut residual, mut largest) = (0.0_f64, 0.0_f64);
        for (i, jump) in self.column.chunks_exact(2).enumerate() {
            let raised = (1.0 + problem.sag[i]) * it.height;
            it.gap[i] = problem.gap[i] + raised + jump[0] + self.worn[i];
            if it.status[i] != Status::Open {
                indentation = indentation.max(self.worn[i]);
                residual = residual.max(it.gap[i].abs());
                largest = largest.max(problem.gap[i].abs() + raised.abs());
            }
        }
        it.indentation = indentation;
        let scale = indentation.max(f64::MIN_POSITIVE);
        it.tolerance = GAP_TOLERANCE.max(ROUND_OFF * largest / scale);
        residual / scale
    }
}

/// Slip of a node before the new forces and height are known, mm.
pub(super) fn fixed_slip(problem: &Problem<'_>, i: usize) -> f64 {
    problem.step - problem.slope[i] * problem.last_height - problem.response.last_jump[2 * i + 1]
}
