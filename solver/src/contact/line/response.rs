//! The response of both bodies at the coupled nodes, in the local frame of the interface.
//!
//! A column of G = Mhat C_m Mhat^T + C_s times the force of an unknown is computed when that is first solved for: most
//! candidates never touch, and a node that slips has one unknown, its pressure with the friction.

use super::deformation::Deformation;
use super::problem::Problem;
use super::status::Status;
use super::unknown::Unknown;

/// Changes of the gap and of the tangential jump of each coupled node, per unit of tractions at coupled nodes.
#[derive(Debug, Default)]
pub(super) struct Response {
    /// Number of coupled nodes.
    nodes: usize,
    /// For each node: gaps, then jumps per unit of its pressure; gaps, then jumps per unit of its shear, mm/MPa.
    columns: Vec<f64>,
    /// Unknowns whose columns are computed, pressure and shear of each node.
    computed: Vec<[Option<Unknown>; 2]>,
    deformation: Deformation,
}

/// Gaps and tangential jumps of all coupled nodes.
pub(super) type Column<'a> = (&'a [f64], &'a [f64]);

impl Response {
    /// Resets to another set of coupled nodes; no column is computed yet.
    pub(super) fn reset(&mut self, nodes: usize) {
        self.nodes = nodes;
        self.columns.resize(4 * nodes * nodes, 0.0);
        self.computed.clear();
        self.computed.resize(nodes, [None; 2]);
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
        let coupling = problem.coupling;
        let (node, force) = (coupling.first + unknown.node(), unknown.force(problem));
        let deformation = &mut self.deformation;
        deformation.under_force(problem.zones, coupling, node, force);
        let n = self.nodes;
        let (gap, jump) = self.columns[2 * place * n..2 * (place + 1) * n].split_at_mut(n);
        let slopes = problem.slope.iter().zip(problem.master_slope);
        let rows = gap.iter_mut().zip(jump).zip(slopes);
        let displacements = deformation.averaged(coupling);
        for (((gap, jump), (slope, master_slope)), [x, y]) in rows.zip(displacements) {
            *gap = y - master_slope * x;
            *jump = x + slope * y;
        }
    }
}

/// Number of an unknown's column: the pressure and the shear of each node.
fn place(unknown: Unknown) -> usize {
    match unknown {
        Unknown::Pressure(node, _) => 2 * node,
        Unknown::Shear(node) => 2 * node + 1,
    }
}
