//! The linear system of an increment, condensed onto the border: dense, or with a core whose off-diagonal blocks have low rank.

use crate::linear::{Blocks, CondensedSystem, HierarchicalSystem, SquareMatrix};

/// The system as it was last written.
#[derive(Default)]
pub(super) struct System {
    dense: CondensedSystem,
    hierarchical: HierarchicalSystem,
    is_hierarchical: bool,
}

impl System {
    /// A dense system to be written, of an order.
    pub(super) fn dense(&mut self, order: usize) -> &mut SquareMatrix {
        self.is_hierarchical = false;
        self.dense.system(order)
    }

    /// A hierarchical system to be written, of the orders of its core and of its border.
    pub(super) fn hierarchical(&mut self, core: usize, border: usize) -> Blocks<'_> {
        self.is_hierarchical = true;
        self.hierarchical.blocks(core, border)
    }

    /// Returns `true` if a hierarchical system was written last.
    pub(super) fn is_hierarchical(&self) -> bool {
        self.is_hierarchical
    }

    /// Condenses what was written onto the unknowns after the first `core` ones.
    pub(super) fn condense(&mut self, core: usize) {
        if self.is_hierarchical {
            self.hierarchical.condense();
        } else {
            self.dense.condense(core);
        }
    }

    /// Entry of the Schur complement.
    pub(super) fn schur(&self, row: usize, column: usize) -> f64 {
        if self.is_hierarchical {
            self.hierarchical.schur(row, column)
        } else {
            self.dense.schur(row, column)
        }
    }

    /// Overwrites a right-hand side [f; g] with [A^-1 f; g - C A^-1 f].
    pub(super) fn eliminate(&mut self, rhs: &mut [f64]) {
        if self.is_hierarchical {
            self.hierarchical.eliminate(rhs);
        } else {
            self.dense.eliminate(rhs);
        }
    }

    /// Overwrites [A^-1 f; y] with the solution [x; y].
    pub(super) fn substitute(&self, solution: &mut [f64]) {
        if self.is_hierarchical {
            self.hierarchical.substitute(solution);
        } else {
            self.dense.substitute(solution);
        }
    }
}
