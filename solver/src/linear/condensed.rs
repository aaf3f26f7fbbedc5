//! Systems whose last unknowns are solved for again and again, with changing conditions.
//!
//! With the leading block A, the core, and the trailing block D, the border,
//!   [A B; C D] [x; y] = [f; g]  is  S y = g - C A^-1 f  and  x = A^-1 f - A^-1 B y  with the Schur complement
//!   S = D - C A^-1 B.
//! One factorisation of A serves all conditions that the border's unknowns are under.

use super::SquareMatrix;
use super::blocked_lu::{BlockedLu, Exchanges};
use super::dense::substitute;
use super::vector::{add_scaled, vectorized};
use faer::linalg::matmul::matmul;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, Par};

/// A system condensed onto its border. Buffers are reused.
#[derive(Default)]
pub(crate) struct CondensedSystem {
    /// A's factors, A^-1 B, C and S in place of the system.
    matrix: SquareMatrix,
    core: usize,
    exchanges: Exchanges,
    lu: BlockedLu,
    permuted: Vec<f64>,
}

impl CondensedSystem {
    /// The system to be written, of an order, with unspecified entries.
    pub(crate) fn system(&mut self, order: usize) -> &mut SquareMatrix {
        self.matrix.reshape(order);
        &mut self.matrix
    }

    /// Condenses the system onto the unknowns after the first `core` ones. Where A is singular, solutions are not finite.
    pub(crate) fn condense(&mut self, core: usize) {
        let order = self.matrix.order();
        self.core = core;
        if core == 0 {
            return;
        }
        let all = MatMut::from_column_major_slice_mut(self.matrix.values_mut(), order, order);
        let (mut a, mut b, c, d) = all.split_at_mut(core, core);
        self.lu.factor(a.rb_mut(), &mut self.exchanges);
        self.lu.solve(a.rb(), &self.exchanges, b.rb_mut());
        matmul(d, Accum::Add, c.rb(), b.rb(), -1.0, Par::Seq);
    }

    /// Entry of the Schur complement.
    pub(crate) fn schur(&self, row: usize, column: usize) -> f64 {
        self.matrix.get(self.core + row, self.core + column)
    }

    /// Overwrites a right-hand side [f; g] with [A^-1 f; g - C A^-1 f].
    pub(crate) fn eliminate(&mut self, rhs: &mut [f64]) {
        let core = self.core;
        if core == 0 {
            return;
        }
        let (f, g) = rhs.split_at_mut(core);
        substitute(&self.matrix, &self.exchanges.forward, f, &mut self.permuted);
        let matrix = &self.matrix;
        vectorized(
            #[inline(always)]
            || {
                for (column, x) in f.iter().enumerate() {
                    add_scaled(g, -x, &matrix.column(column)[core..]);
                }
            },
        );
    }

    /// Overwrites [A^-1 f; y] with the solution [x; y].
    pub(crate) fn substitute(&self, solution: &mut [f64]) {
        let (x, y) = solution.split_at_mut(self.core);
        vectorized(
            #[inline(always)]
            || {
                for (column, y) in y.iter().enumerate() {
                    add_scaled(x, -y, &self.matrix.column(self.core + column)[..self.core]);
                }
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::real;

    /// A matrix that needs pivots, and its product with 1, 2, 3, ...
    fn example(order: usize, system: &mut SquareMatrix) -> Vec<f64> {
        let mut product = vec![0.0; order];
        for (i, product) in product.iter_mut().enumerate() {
            for j in 0..order {
                let value = 1.0 / (1.0 + real((i + 2 * j) % 5))
                    + if (i + 1) % order == j { 3.0 } else { 0.0 };
                *system.at(i, j) = value;
                *product += value * (1.0 + real(j));
            }
        }
        product
    }

    #[test]
    fn a_condensed_system_has_the_solution_of_the_whole() {
        let mut condensed = CondensedSystem::default();
        let mut lu = super::super::DenseLu::default();
        for (order, core) in [(6, 4), (9, 3), (5, 0), (4, 3)] {
            let mut solution = example(order, condensed.system(order));
            condensed.condense(core);
            condensed.eliminate(&mut solution);
            let border = order - core;
            let schur = lu.matrix(border);
            for i in 0..border {
                for j in 0..border {
                    *schur.at(i, j) = condensed.schur(i, j);
                }
            }
            lu.factor();
            assert!(lu.solve(&mut solution[core..]), "{order} {core}");
            condensed.substitute(&mut solution);
            for (i, x) in solution.iter().enumerate() {
                assert!(
                    (x - 1.0 - real(i)).abs() < 1e-12,
                    "{order} {core}: {solution:?}"
                );
            }
        }
    }
}
