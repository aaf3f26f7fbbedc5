//! Dense matrices and their LU factorisation, with buffers that are reused from call to call.

use super::vector::{add_scaled, vectorized};

/// A square matrix, stored by columns.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SquareMatrix {
    order: usize,
    values: Vec<f64>,
}

impl SquareMatrix {
    /// A zero matrix.
    pub(crate) fn zeros(order: usize) -> Self {
        Self {
            order,
            values: vec![0.0; order * order],
        }
    }

    /// Resizes to another order and sets all entries to zero; the allocation is reused.
    pub(crate) fn reset(&mut self, order: usize) {
        self.order = order;
        self.values.clear();
        self.values.resize(order * order, 0.0);
    }

    /// Resizes to another order with unspecified entries; the allocation is reused.
    pub(crate) fn reshape(&mut self, order: usize) {
        self.order = order;
        self.values.resize(order * order, 0.0);
    }

    /// Number of rows.
    pub(crate) fn order(&self) -> usize {
        self.order
    }

    /// Entry (row, column).
    pub(crate) fn get(&self, row: usize, column: usize) -> f64 {
        self.values[column * self.order + row]
    }

    /// Mutable entry (row, column).
    pub(crate) fn at(&mut self, row: usize, column: usize) -> &mut f64 {
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
    pub(crate) fn column(&self, column: usize) -> &[f64] {
        &self.values[column * self.order..(column + 1) * self.order]
    }

    /// A mutable column.
    pub(crate) fn column_mut(&mut self, column: usize) -> &mut [f64] {
        &mut self.values[column * self.order..(column + 1) * self.order]
    }
}

/// LU factorisation with partial pivoting of small dense systems, without allocating once its buffers have grown.
#[derive(Debug, Default)]
pub(crate) struct DenseLu {
    factors: SquareMatrix,
    /// Row of the matrix that became each row of the factors.
    permutation: Vec<usize>,
    permuted: Vec<f64>,
}

impl DenseLu {
    /// The matrix to be factored, of an order, with unspecified entries.
    pub(crate) fn matrix(&mut self, order: usize) -> &mut SquareMatrix {
        self.factors.reshape(order);
        &mut self.factors
    }

    /// Factors the matrix by Gaussian elimination (Golub and Van Loan 2013, algorithm 3.4.1). Where it is singular, solutions
    /// are not finite.
    pub(crate) fn factor(&mut self) {
        let n = self.factors.order;
        self.permutation.clear();
        self.permutation.extend(0..n);
        let (values, permutation) = (&mut self.factors.values[..], &mut self.permutation[..]);
        vectorized(
            #[inline(always)]
            || {
                for k in 0..n {
                    let column = &values[k * n + k..(k + 1) * n];
                    let mut pivot = 0;
                    for (i, value) in column.iter().enumerate() {
                        if value.abs() > column[pivot].abs() {
                            pivot = i;
                        }
                    }
                    if pivot > 0 {
                        permutation.swap(k, k + pivot);
                        for column in values.chunks_exact_mut(n) {
                            column.swap(k, k + pivot);
                        }
                    }
                    let (done, rest) = values.split_at_mut((k + 1) * n);
                    let multipliers = &mut done[k * n + k..];
                    let (diagonal, multipliers) = multipliers.split_at_mut(1);
                    let reciprocal = 1.0 / diagonal[0];
                    for multiplier in multipliers.iter_mut() {
                        *multiplier *= reciprocal;
                    }
                    for column in rest.chunks_exact_mut(n) {
                        let (top, below) = column.split_at_mut(k + 1);
                        add_scaled(below, -top[k], multipliers);
                    }
                }
            },
        );
    }

    /// Overwrites a right-hand side with the solution; `false` if it is not finite.
    pub(crate) fn solve(&mut self, rhs: &mut [f64]) -> bool {
        let n = self.factors.order;
        debug_assert!(rhs.len() == n, "one right-hand side of the matrix' order");
        substitute(&self.factors, &self.permutation, rhs, &mut self.permuted);
        rhs.iter().all(|x| x.is_finite())
    }
}

/// Overwrites a right-hand side with the solution of the system whose leading block holds its factors, L with a unit diagonal
/// and U, of the permuted rows.
pub(super) fn substitute(
    factors: &SquareMatrix,
    permutation: &[usize],
    rhs: &mut [f64],
    permuted: &mut Vec<f64>,
) {
    permuted.clear();
    permuted.extend(permutation.iter().map(|row| rhs[*row]));
    let (n, x) = (permutation.len(), &mut permuted[..]);
    vectorized(
        #[inline(always)]
        || {
            for k in 0..n {
                let (above, below) = x.split_at_mut(k + 1);
                add_scaled(below, -above[k], &factors.column(k)[k + 1..n]);
            }
            for k in (0..n).rev() {
                let (above, below) = x.split_at_mut(k);
                let column = factors.column(k);
                below[0] /= column[k];
                add_scaled(above, -below[0], &column[..k]);
            }
        },
    );
    rhs.copy_from_slice(permuted);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_needs_pivots_is_solved() {
        let mut lu = DenseLu::default();
        for n in [3, 2, 5] {
            let a = lu.matrix(n);
            a.reset(n);
            for i in 0..n {
                *a.at(i, (i + 1) % n) = 2.0;
                *a.at(i, (i + 2) % n) += 1.0;
            }
            let x: Vec<f64> = (0..n).map(|i| crate::number::real(i) - 1.5).collect();
            let mut b: Vec<f64> = (0..n)
                .map(|i| (0..n).map(|j| a.get(i, j) * x[j]).sum())
                .collect();
            lu.factor();
            let regular = lu.solve(&mut b);
            assert!(
                regular && b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-12),
                "order {n}"
            );
        }
    }

    #[test]
    fn a_singular_system_is_told() {
        let mut lu = DenseLu::default();
        lu.matrix(2).reset(2);
        lu.factor();
        assert!(!lu.solve(&mut [1.0, 1.0]));
    }
}
