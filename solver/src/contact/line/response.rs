//! The response of both bodies at the coupled nodes, in the local frame of the interface.
//!
//! A column of G = Mhat C_m Mhat^T + C_s times the force of an unknown is computed when that is first solved for: most
//! candidates never touch, and a node that slips has one unknown, its pressure with the friction.

use super::deformation::Deformation;
use super::problem::Problem;
use super::unknown::Unknown;
use crate::number::count;

/// Changes of the gap and of the tangential jump of each coupled node, per unit of tractions at coupled nodes.
#[derive(Debug, Default)]
pub(super) struct Response {
    /// Number of coupled nodes.
    nodes: usize,
    /// True if jumps and shears are computed.
    tangential: bool,
    /// Columns in the order in which they are first computed: gaps, then jumps per unit of an unknown, mm/MPa. Gaps only, where
    /// slip is imposed.
    columns: Vec<f64>,
    /// Unknowns whose columns are computed, pressure and shear of each node, and where these begin.
    computed: Vec<[Option<Unknown>; 2]>,
    begins: Vec<[usize; 2]>,
    /// Number of columns.
    count: usize,
    deformation: Deformation,
    /// Entries computed since the last reset of the count.
    pub(super) entries: u64,
}

/// Gaps and tangential jumps of all coupled nodes; no jumps where slip is imposed.
pub(super) type Column<'a> = (&'a [f64], &'a [f64]);

impl Response {
    /// Resets to another set of coupled nodes; no column is computed yet.
    pub(super) fn reset(&mut self, nodes: usize, tangential: bool) {
        self.nodes = nodes;
        self.tangential = tangential;
        self.count = 0;
        self.computed.clear();
        self.computed.resize(nodes, [None; 2]);
        self.begins.resize(nodes, [0; 2]);
    }

    /// Per unit of an unknown; requires its column.
    #[inline]
    pub(super) fn column(&self, unknown: Unknown) -> Column<'_> {
        let (node, kind) = (unknown.node(), kind(unknown));
        debug_assert!(
            self.computed[node][kind] == Some(unknown),
            "a column is computed before use"
        );
        let begin = self.begins[node][kind];
        self.columns[begin..begin + self.length()].split_at(self.nodes)
    }

    /// Length of a column.
    #[inline]
    fn length(&self) -> usize {
        if self.tangential {
            2 * self.nodes
        } else {
            self.nodes
        }
    }

    /// Computes the column of an unknown once.
    pub(super) fn compute(&mut self, problem: &Problem<'_>, unknown: Unknown) {
        let (node, kind) = (unknown.node(), kind(unknown));
        let length = self.length();
        match self.computed[node][kind].replace(unknown) {
            Some(computed) if computed == unknown => return,
            Some(_) => {}
            None => {
                self.begins[node][kind] = self.count * length;
                self.count += 1;
            }
        }
        let begin = self.begins[node][kind];
        let needed = self.columns.len().max(begin + length);
        self.columns.resize(needed, 0.0);
        self.entries += count(length);
        let coupling = problem.coupling;
        let (node, force) = (coupling.first + node, unknown.force(problem));
        let n = self.nodes;
        let deformation = &mut self.deformation;
        let nodes = coupling.first..coupling.end;
        deformation.under_force(problem.zones, coupling, node, force, nodes);
        let displacements = deformation.averaged(coupling);
        if !self.tangential {
            let rows = self.columns[begin..begin + n].iter_mut();
            let rows = rows.zip(problem.master_slope).zip(displacements);
            for ((gap, master_slope), [x, y]) in rows {
                *gap = y - master_slope * x;
            }
            return;
        }
        let (gap, jump) = self.columns[begin..begin + 2 * n].split_at_mut(n);
        let slopes = problem.slope.iter().zip(problem.master_slope);
        let rows = gap.iter_mut().zip(jump).zip(slopes);
        for (((gap, jump), (slope, master_slope)), [x, y]) in rows.zip(displacements) {
            *gap = y - master_slope * x;
            *jump = x + slope * y;
        }
    }
}

/// Which of its node's two columns an unknown has.
#[inline]
fn kind(unknown: Unknown) -> usize {
    match unknown {
        Unknown::Pressure(..) => 0,
        Unknown::Shear(_) => 1,
    }
}
