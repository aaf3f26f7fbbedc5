//! Systems as those of `condensed`, whose core has off-diagonal blocks of low rank.

use super::vector::{add_scaled, dot, vectorized};
use super::{Hodlr, HodlrLu, SquareMatrix};

/// The blocks of a system [A B; C D].
pub(crate) struct Blocks<'a> {
    /// A, to be approximated.
    pub core: &'a mut Hodlr,
    /// B by columns.
    pub right: &'a mut [f64],
    /// C by rows.
    pub below: &'a mut [f64],
    /// D.
    pub corner: &'a mut SquareMatrix,
}

/// A system condensed onto its border. Buffers are reused.
#[derive(Default)]
pub(crate) struct HierarchicalSystem {
    core: HodlrLu,
    order: usize,
    /// B, then A^-1 B, by columns; C by rows; D, then S.
    right: Vec<f64>,
    below: Vec<f64>,
    corner: SquareMatrix,
}

impl HierarchicalSystem {
    /// The core to be approximated, and the other blocks to be written, with unspecified entries: B by columns, C by rows, D.
    pub(crate) fn blocks(&mut self, core: usize, border: usize) -> Blocks<'_> {
        self.order = core;
        self.right.resize(core * border, 0.0);
        self.below.resize(core * border, 0.0);
        self.corner.reshape(border);
        Blocks {
            core: self.core.matrix(),
            right: &mut self.right,
            below: &mut self.below,
            corner: &mut self.corner,
        }
    }

    /// Condenses the system onto its border. Where A is singular, solutions are not finite.
    pub(crate) fn condense(&mut self) {
        self.core.factor(&mut self.right);
        let Self {
            order,
            right,
            below,
            corner,
            ..
        } = self;
        vectorized(
            #[inline(always)]
            || {
                for (column, b) in right.chunks_exact(*order).enumerate() {
                    let rows = corner.column_mut(column).iter_mut();
                    for (entry, c) in rows.zip(below.chunks_exact(*order)) {
                        *entry -= dot(c, b);
                    }
                }
            },
        );
    }

    /// Entry of the Schur complement.
    pub(crate) fn schur(&self, row: usize, column: usize) -> f64 {
        self.corner.get(row, column)
    }

    /// Overwrites a right-hand side [f; g] with [A^-1 f; g - C A^-1 f].
    pub(crate) fn eliminate(&mut self, rhs: &mut [f64]) {
        let (f, g) = rhs.split_at_mut(self.order);
        self.core.solve(f);
        vectorized(
            #[inline(always)]
            || {
                for (g, c) in g.iter_mut().zip(self.below.chunks_exact(self.order)) {
                    *g -= dot(c, f);
                }
            },
        );
    }

    /// Overwrites [A^-1 f; y] with the solution [x; y].
    pub(crate) fn substitute(&self, solution: &mut [f64]) {
        let (x, y) = solution.split_at_mut(self.order);
        vectorized(
            #[inline(always)]
            || {
                for (y, column) in y.iter().zip(self.right.chunks_exact(self.order)) {
                    add_scaled(x, -y, column);
                }
            },
        );
    }
}
