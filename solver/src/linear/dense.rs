//! Dense matrices and their LU factorisation, with buffers that are reused from call to call.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Conj, MatMut, Par};

/// A square matrix, stored by columns.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SquareMatrix {
    order: usize,
    values: Vec<f64>,
}

impl SquareMatrix {
    /// A zero matrix.
    pub fn zeros(order: usize) -> Self {
        Self {
            order,
            values: vec![0.0; order * order],
        }
    }

    /// Resizes to another order and sets all entries to zero; the allocation is reused.
    pub fn reset(&mut self, order: usize) {
        self.order = order;
        self.values.clear();
        self.values.resize(order * order, 0.0);
    }

    /// Resizes to another order with unspecified entries; the allocation is reused.
    pub fn reshape(&mut self, order: usize) {
        self.order = order;
        self.values.resize(order * order, 0.0);
    }

    /// Number of rows.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Entry (row, column).
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.values[column * self.order + row]
    }

    /// Mutable entry (row, column).
    pub fn at(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.values[column * self.order + row]
    }

    /// All entries, by columns.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// All entries, by columns, mutable.
    pub(super) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// A column.
    pub fn column(&self, column: usize) -> &[f64] {
        &self.values[column * self.order..(column + 1) * self.order]
    }

    /// A mutable column.
    pub fn column_mut(&mut self, column: usize) -> &mut [f64] {
        &mut self.values[column * self.order..(column + 1) * self.order]
    }
}

/// Solves small dense systems by LU with partial pivoting, without allocating once its buffers have grown.
#[derive(Default)]
pub struct DenseLu {
    forward: Vec<usize>,
    backward: Vec<usize>,
    memory: Option<(usize, MemBuffer)>,
}

impl DenseLu {
    /// Overwrites `matrix` with its factors and `rhs` with the solution; `false` if the solution is not finite.
    pub fn solve(&mut self, matrix: &mut SquareMatrix, rhs: &mut [f64]) -> bool {
        let n = matrix.order;
        debug_assert!(rhs.len() == n, "one right-hand side of the matrix' order");
        self.forward.resize(n, 0);
        self.backward.resize(n, 0);
        let memory = match &mut self.memory {
            Some((order, memory)) if *order >= n => memory,
            slot => {
                let factor = factor::lu_in_place_scratch::<usize, f64>(
                    n,
                    n,
                    Par::Seq,
                    faer::Spec::default(),
                );
                let solve = solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
                &mut slot.insert((n, MemBuffer::new(factor.or(solve)))).1
            }
        };
        let mut lu = MatMut::from_column_major_slice_mut(&mut matrix.values, n, n);
        let stack = MemStack::new(memory);
        let (_, perm) = factor::lu_in_place(
            lu.rb_mut(),
            &mut self.forward,
            &mut self.backward,
            Par::Seq,
            stack,
            faer::Spec::default(),
        );
        let lu = lu.rb();
        let target = MatMut::from_column_major_slice_mut(&mut *rhs, n, 1);
        solve::solve_in_place_with_conj(lu, lu, perm, Conj::No, target, Par::Seq, stack);
        rhs.iter().all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_needs_pivots_is_solved() {
        let mut lu = DenseLu::default();
        for n in [3, 2, 5] {
            let mut a = SquareMatrix::zeros(n);
            for i in 0..n {
                *a.at(i, (i + 1) % n) = 2.0;
                *a.at(i, (i + 2) % n) += 1.0;
            }
            let x: Vec<f64> = (0..n).map(|i| crate::number::real(i) - 1.5).collect();
            let mut b: Vec<f64> = (0..n)
                .map(|i| (0..n).map(|j| a.get(i, j) * x[j]).sum())
                .collect();
            let regular = lu.solve(&mut a, &mut b);
            assert!(
                regular && b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-12),
                "order {n}"
            );
        }
    }

    #[test]
    fn a_singular_system_is_told() {
        let mut a = SquareMatrix::zeros(2);
        assert!(!DenseLu::default().solve(&mut a, &mut [1.0, 1.0]));
    }
}
