//! The condensed response of a contact surface.

use crate::linear::{Approximation, Entries, Hodlr};
use std::ops::Range;

/// Error of the compressed compliance over the norm of each of its blocks: round-off.
const COMPRESSION: Approximation = Approximation {
    tolerance: 1e-14,
    compared: true,
    symmetric: true,
};

/// Displacements of contact nodes per force at contact nodes, mm per N/mm: by columns, u_x and u_y of each node.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Compliance {
    nodes: usize,
    columns: Vec<f64>,
}

/// u_x and u_y of neighbouring nodes, for a force along x and for one along y at a node, mm per N/mm.
pub type Response<'a> = [&'a [f64]; 2];

impl Compliance {
    /// A compliance of zeros.
    pub(super) fn zeros(nodes: usize) -> Self {
        Self {
            nodes,
            columns: vec![0.0; 4 * nodes * nodes],
        }
    }

    /// Number of contact nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.nodes
    }

    /// The response of a range of nodes to a force at a node.
    pub(crate) fn to_force_at(&self, node: usize, of: &Range<usize>) -> Response<'_> {
        [2 * node, 2 * node + 1].map(|column| {
            let begin = 2 * column * self.nodes;
            &self.columns[begin + 2 * of.start..begin + 2 * of.end]
        })
    }

    /// Displacement of surface unknown `row` = 2 i + d per force at unknown `column` = 2 j + e.
    pub(crate) fn get(&self, row: usize, column: usize) -> f64 {
        self.columns[2 * column * self.nodes + row]
    }

    /// Mutable access to the same entry.
    pub(super) fn at(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.columns[2 * column * self.nodes + row]
    }

    /// The same as dense blocks along its diagonal and blocks of low rank beside them.
    pub(super) fn compressed(&self) -> Hodlr {
        let mut compressed = Hodlr::default();
        let order = 2 * self.nodes;
        compressed.approximate(order, &mut Symmetric(self), &[], COMPRESSION);
        compressed
    }
}

/// A compliance, whose rows are its columns.
struct Symmetric<'a>(&'a Compliance);

impl Entries for Symmetric<'_> {
    fn row(&mut self, row: usize, columns: Range<usize>, entries: &mut [f64]) {
        self.column(row, columns, entries);
    }

    fn column(&mut self, column: usize, rows: Range<usize>, entries: &mut [f64]) {
        let begin = 2 * column * self.0.nodes;
        entries.copy_from_slice(&self.0.columns[begin + rows.start..begin + rows.end]);
    }
}
