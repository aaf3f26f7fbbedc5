//! The response of both bodies at the coupled nodes, in the local frame of the receptacle's surface.
//!
//! A column of G = Mhat C_m Mhat^T + C_s times the force of an unknown is computed when that is first solved for: most
//! candidates never touch, and a node that slips has one unknown, its pressure with the friction.

use super::local_slopes::LocalSlopes;
use super::mortar::Coupling;
use super::pair::Zones;
use super::problem::Problem;
use super::state::ContactState;
use super::status::Status;
use super::unknown::Unknown;
use crate::condensation::ZoneOperators;
use crate::linear::vector::vectorized;
use crate::sides::Side;

/// Changes of the gap and of the tangential jump of each coupled node, per unit of tractions at coupled nodes.
#[derive(Debug, Default)]
pub(super) struct Response {
    /// Number of coupled nodes.
    nodes: usize,
    /// For each node: gaps, then jumps per unit of its pressure; gaps, then jumps per unit of its shear, mm/MPa.
    columns: Vec<f64>,
    /// Unknowns whose columns are computed, pressure and shear of each node.
    computed: Vec<[Option<Unknown>; 2]>,
    /// Tangential jump that the forces of the last increment would make at the new position, mm.
    pub(super) last_jump: Vec<f64>,
    /// Displacements of the master's and of the slave's nodes, u_x and u_y of each, mm.
    master: Vec<f64>,
    slave: Vec<f64>,
}

/// Gaps and tangential jumps of all coupled nodes.
pub(super) type Column<'a> = (&'a [f64], &'a [f64]);

impl Response {
    /// Resets to another set of coupled nodes; no column is computed yet.
    pub(super) fn reset(
        &mut self,
        zones: Zones<'_>,
        slave: Side,
        coupling: &Coupling,
        slopes: &LocalSlopes,
        last: &ContactState,
    ) {
        let n = coupling.len();
        self.nodes = n;
        self.columns.resize(4 * n * n, 0.0);
        self.computed.clear();
        self.computed.resize(n, [None; 2]);
        self.compute_last_jump(zones, slave, coupling, &slopes.receptacle, last);
    }

    /// Per unit of an unknown; requires its column.
    #[inline]
    pub(super) fn column(&self, unknown: Unknown) -> Column<'_> {
        let place = place(unknown);
        debug_assert!(
            self.computed[place / 2][place % 2] == Some(unknown),
            "a column is computed before use"
        );
        let begin = 2 * place * self.nodes;
        self.columns[begin..begin + 2 * self.nodes].split_at(self.nodes)
    }

    /// Computes the columns of the pressure without friction and of the shear of a node.
    pub(super) fn compute_both(&mut self, problem: &Problem<'_>, node: usize) {
        self.compute(problem, Unknown::Pressure(node, Status::Stick));
        self.compute(problem, Unknown::Shear(node));
    }

    /// Computes the column of an unknown once.
    pub(super) fn compute(&mut self, problem: &Problem<'_>, unknown: Unknown) {
        let place = place(unknown);
        let computed = &mut self.computed[place / 2][place % 2];
        if computed.replace(unknown) == Some(unknown) {
            return;
        }
        self.displace(problem, unknown);
        let n = self.nodes;
        let (gap, jump) = self.columns[2 * place * n..2 * (place + 1) * n].split_at_mut(n);
        let displacements = averaged(problem.coupling, &self.master, &self.slave);
        let slopes = problem.slope.iter().zip(problem.master_slope);
        let rows = gap.iter_mut().zip(jump).zip(slopes);
        for (((gap, jump), (slope, master_slope)), [x, y]) in rows.zip(displacements) {
            *gap = y - master_slope * x;
            *jump = x + slope * y;
        }
    }

    /// Displaces the nodes of both bodies by the force of an unknown.
    fn displace(&mut self, problem: &Problem<'_>, unknown: Unknown) {
        let Problem {
            coupling, zones, ..
        } = *problem;
        let (begin, end) = coupling.master_range;
        clear(&mut self.master, end - begin);
        clear(&mut self.slave, coupling.len());
        let [x, y] = unknown.force(problem);
        let node = coupling.first + unknown.node();
        let (from, weights) = coupling.dual_row(node);
        for (to, weight) in (from..).zip(weights) {
            let force = [weight * x, weight * y];
            add_force(&mut self.master, zones.master, to, force, begin);
        }
        let first = coupling.first;
        add_force(&mut self.slave, zones.slave, node, [x, y], first);
    }

    fn compute_last_jump(
        &mut self,
        zones: Zones<'_>,
        slave: Side,
        coupling: &Coupling,
        slope: &[f64],
        last: &ContactState,
    ) {
        let (begin, end) = coupling.master_range;
        clear(&mut self.master, end - begin);
        clear(&mut self.slave, coupling.len());
        add_forces(&mut self.master, zones.master, last, slave.other(), begin);
        add_forces(&mut self.slave, zones.slave, last, slave, coupling.first);
        let displacements = averaged(coupling, &self.master, &self.slave);
        self.last_jump.clear();
        self.last_jump
            .extend(displacements.zip(slope).map(|([x, y], s)| x + s * y));
    }
}

/// Number of an unknown's column: the pressure and the shear of each node.
fn place(unknown: Unknown) -> usize {
    match unknown {
        Unknown::Pressure(node, _) => 2 * node,
        Unknown::Shear(node) => 2 * node + 1,
    }
}

fn clear(displacement: &mut Vec<f64>, nodes: usize) {
    displacement.clear();
    displacement.resize(2 * nodes, 0.0);
}

/// Relative displacements of both bodies at the coupled nodes: the master's, averaged, and the slave's.
fn averaged<'a>(
    coupling: &'a Coupling,
    master: &'a [f64],
    slave: &'a [f64],
) -> impl Iterator<Item = [f64; 2]> + 'a {
    let (master, _) = master.as_chunks::<2>();
    let (slave, _) = slave.as_chunks::<2>();
    let begin = coupling.master_range.0;
    coupling
        .dual_rows()
        .zip(slave)
        .map(move |((from, weights), own)| {
            let mut sum = *own;
            for (weight, u) in weights.iter().zip(&master[from - begin..]) {
                sum[0] += weight * u[0];
                sum[1] += weight * u[1];
            }
            sum
        })
}

/// Displaces the nodes of a body from `first` on by a force at a node.
fn add_force(
    displacement: &mut [f64],
    zone: &ZoneOperators,
    node: usize,
    force: [f64; 2],
    first: usize,
) {
    let nodes = first..first + displacement.len() / 2;
    let [per_x, per_y] = zone.to_force_at(node, &nodes);
    vectorized(
        #[inline(always)]
        || {
            for (u, (per_x, per_y)) in displacement.iter_mut().zip(per_x.iter().zip(per_y)) {
                *u += force[0] * per_x + force[1] * per_y;
            }
        },
    );
}

/// Displaces the nodes of a body from `first` on by the last forces.
fn add_forces(
    displacement: &mut [f64],
    zone: &ZoneOperators,
    last: &ContactState,
    side: Side,
    first: usize,
) {
    let force = last.force.of(side);
    for node in last.loaded(side) {
        let force = [force[2 * node], force[2 * node + 1]];
        if force[0] != 0.0 || force[1] != 0.0 {
            add_force(displacement, zone, node, force, first);
        }
    }
}
