//! Response of both bodies at the coupled nodes of all planes to a pressure at one of them.

use super::problem::{Problem, Zones};
use crate::linear::vector::vectorized;

/// Changes of the gaps of all coupled nodes per pressure at a node, computed when that first closes. Buffers are reused.
#[derive(Debug, Default)]
pub(super) struct Response {
    columns: Vec<f64>,
    is_computed: Vec<bool>,
    order: usize,
    slave: Vec<f64>,
    master: Vec<f64>,
}

impl Response {
    /// Resets to nothing computed, for so many coupled nodes.
    pub(super) fn reset(&mut self, order: usize) {
        self.order = order;
        self.columns.resize(order * order, 0.0);
        self.is_computed.clear();
        self.is_computed.resize(order, false);
    }

    /// Gaps per pressure at a node, mm/MPa.
    pub(super) fn column(&self, node: usize) -> &[f64] {
        debug_assert!(self.is_computed[node], "computed before it is read");
        &self.columns[node * self.order..(node + 1) * self.order]
    }

    /// Computes the column of a node, unless that is known.
    pub(super) fn compute(&mut self, problem: &Problem, zones: Zones<'_>, node: usize) {
        if self.is_computed[node] {
            return;
        }
        self.is_computed[node] = true;
        let coupling = &problem.coupling;
        let (n, first) = (coupling.len(), coupling.first);
        let (plane, i) = (node / n, first + node % n);
        let force = problem.force[node];
        let (begin, stop) = coupling.master_range;
        let column = &mut self.columns[node * self.order..(node + 1) * self.order];
        for (k, gaps) in column.chunks_exact_mut(n).enumerate() {
            for (values, nodes) in [(&mut self.slave, n), (&mut self.master, stop - begin)] {
                values.clear();
                values.resize(2 * nodes, 0.0);
            }
            let of = &(first..coupling.end);
            displace(
                &mut self.slave,
                zones.slave.to_force_at(plane, i, k, of),
                force,
            );
            let (from, weights) = coupling.dual_row(i);
            for (to, weight) in (from..).zip(weights) {
                let response = zones.master.to_force_at(plane, to, k, &(begin..stop));
                displace(&mut self.master, response, force.map(|f| weight * f));
            }
            let (own, _) = self.slave.as_chunks::<2>();
            let (far, _) = self.master.as_chunks::<2>();
            let coupled = coupling.first..coupling.end;
            let rows = coupling.dual_rows(&coupled).zip(own);
            let slopes = &problem.master_slope[k * n..(k + 1) * n];
            for ((gap, slope), ((from, weights), own)) in gaps.iter_mut().zip(slopes).zip(rows) {
                let [mut x, mut y] = *own;
                for (weight, u) in weights.iter().zip(&far[from - begin..]) {
                    x += weight * u[0];
                    y += weight * u[1];
                }
                *gap = y - slope * x;
            }
        }
    }
}

/// Adds the displacements by a force.
fn displace(displacement: &mut [f64], [per_x, per_y]: [&[f64]; 2], force: [f64; 2]) {
    vectorized(
        #[inline(always)]
        || {
            for (u, (per_x, per_y)) in displacement.iter_mut().zip(per_x.iter().zip(per_y)) {
                *u += force[0] * per_x + force[1] * per_y;
            }
        },
    );
}
