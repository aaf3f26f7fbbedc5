//! The response of both bodies at the coupled nodes, in the local frame of the receptacle's surface.
//!
//! A column of G = Mhat C_m Mhat^T + C_s is computed when its node first touches: most candidates never do.

use super::local_slopes::LocalSlopes;
use super::mortar::Coupling;
use super::pair::Zones;
use super::problem::Problem;
use super::state::ContactState;
use crate::condensation::{Block, ZoneOperators};
use crate::sides::Side;

/// Change of the gap and of the tangential jump of each coupled node, per force along N and T at coupled nodes.
#[derive(Debug, Default)]
pub(super) struct Response {
    /// Number of coupled nodes.
    nodes: usize,
    /// For each node: gaps, then jumps for a force along N; gaps, then jumps for one along T, mm per N/mm.
    columns: Vec<f64>,
    computed: Vec<bool>,
    /// Tangential jump that the forces of the last increment would make at the new position, mm.
    pub(super) last_jump: Vec<f64>,
    master: Vec<Block>,
    displacement: Vec<[f64; 2]>,
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
        self.computed.resize(n, false);
        self.compute_last_jump(zones, slave, coupling, &slopes.receptacle, last);
    }

    /// Per force along N = (-s, 1) at a node; requires its column.
    pub(super) fn along_normal(&self, node: usize) -> Column<'_> {
        self.column(2 * node)
    }

    /// Per force along T = (1, s) at a node; requires its column.
    pub(super) fn along_tangent(&self, node: usize) -> Column<'_> {
        self.column(2 * node + 1)
    }

    fn column(&self, column: usize) -> Column<'_> {
        debug_assert!(self.computed[column / 2], "a column is computed before use");
        let begin = 2 * column * self.nodes;
        self.columns[begin..begin + 2 * self.nodes].split_at(self.nodes)
    }

    /// Computes both columns of a node once.
    pub(super) fn compute(&mut self, problem: &Problem<'_>, node: usize) {
        if std::mem::replace(&mut self.computed[node], true) {
            return;
        }
        let Problem {
            zones,
            coupling,
            slope,
            master_slope,
            ..
        } = *problem;
        let n = self.nodes;
        let k = coupling.first + node;
        let (begin, end) = coupling.master_range;
        self.master.clear();
        self.master.resize(end - begin, [0.0; 4]);
        let (from, weights) = coupling.dual_row(k);
        for (offset, weight) in weights.iter().enumerate() {
            let response = zones.master.to_force_at(from + offset, begin..end);
            for (sum, c) in self.master.iter_mut().zip(response) {
                add(sum, *weight, c);
            }
        }
        let own = zones.slave.to_force_at(k, coupling.first..coupling.end);
        let (normal, tangent) = self.columns[4 * node * n..4 * (node + 1) * n].split_at_mut(2 * n);
        let (normal_gap, normal_jump) = normal.split_at_mut(n);
        let (tangent_gap, tangent_jump) = tangent.split_at_mut(n);
        let s = slope[node];
        for i in 0..n {
            let (from, weights) = coupling.dual_row(coupling.first + i);
            let mut u = own[i];
            for (weight, c) in weights.iter().zip(&self.master[from - begin..]) {
                add(&mut u, *weight, c);
            }
            let gap = |x: f64, y: f64| y - master_slope[i] * x;
            let jump = |x: f64, y: f64| x + slope[i] * y;
            let (gap_x, gap_y) = (gap(u[0], u[1]), gap(u[2], u[3]));
            let (jump_x, jump_y) = (jump(u[0], u[1]), jump(u[2], u[3]));
            normal_gap[i] = gap_y - s * gap_x;
            normal_jump[i] = jump_y - s * jump_x;
            tangent_gap[i] = gap_x + s * gap_y;
            tangent_jump[i] = jump_x + s * jump_y;
        }
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
        let n = coupling.len();
        self.displacement.clear();
        self.displacement.resize(end - begin + n, [0.0; 2]);
        let (master, own) = self.displacement.split_at_mut(end - begin);
        accumulate(master, zones.master, last, slave.other(), begin);
        accumulate(own, zones.slave, last, slave, coupling.first);
        self.last_jump.clear();
        for (i, s) in slope.iter().enumerate() {
            let (from, weights) = coupling.dual_row(coupling.first + i);
            let [mut x, mut y] = own[i];
            for (weight, u) in weights.iter().zip(&master[from - begin..]) {
                x += weight * u[0];
                y += weight * u[1];
            }
            self.last_jump.push(x + s * y);
        }
    }
}

fn add(sum: &mut Block, weight: f64, c: &Block) {
    for (sum, c) in sum.iter_mut().zip(c) {
        *sum += weight * c;
    }
}

/// target += compliance of the nodes from `first` on, times the last nodal forces on a side.
fn accumulate(
    target: &mut [[f64; 2]],
    zone: &ZoneOperators,
    last: &ContactState,
    side: Side,
    first: usize,
) {
    let force = last.force.of(side);
    for node in last.loaded(side) {
        let f = &force[2 * node..2 * node + 2];
        if f[0] == 0.0 && f[1] == 0.0 {
            continue;
        }
        let response = zone.to_force_at(node, first..first + target.len());
        for (u, c) in target.iter_mut().zip(response) {
            u[0] += f[0] * c[0] + f[1] * c[2];
            u[1] += f[0] * c[1] + f[1] * c[3];
        }
    }
}
