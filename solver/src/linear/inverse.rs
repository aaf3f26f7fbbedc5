//! Inverses of small dense matrices.

use super::SquareMatrix;
use super::blocked_lu::{BlockedLu, Exchanges};
use faer::MatMut;
use faer::prelude::ReborrowMut;

/// A matrix and its inverse. Buffers are reused.
#[derive(Default)]
pub(crate) struct Inverse {
    factors: SquareMatrix,
    result: SquareMatrix,
    exchanges: Exchanges,
    lu: BlockedLu,
}

impl Inverse {
    /// The matrix to be written, of an order, with unspecified entries.
    pub(crate) fn matrix(&mut self, order: usize) -> &mut SquareMatrix {
        self.factors.reshape(order);
        &mut self.factors
    }

    /// Inverts the matrix; `false` if the inverse is not finite.
    pub(crate) fn invert(&mut self) -> bool {
        let order = self.factors.order();
        self.result.reset(order);
        for i in 0..order {
            *self.result.at(i, i) = 1.0;
        }
        let factors = self.factors.values_mut();
        let mut factors = MatMut::from_column_major_slice_mut(factors, order, order);
        let inverse = self.result.values_mut();
        let inverse = MatMut::from_column_major_slice_mut(inverse, order, order);
        self.lu.factor(factors.rb_mut(), &mut self.exchanges);
        self.lu.solve(factors.as_ref(), &self.exchanges, inverse);
        self.result.values().iter().all(|value| value.is_finite())
    }

    /// The last inverse.
    pub(crate) fn inverse(&self) -> &SquareMatrix {
        &self.result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::real;

    #[test]
    fn a_matrix_times_its_inverse_is_one() {
        let mut inverse = Inverse::default();
        for order in [1, 5, 40] {
            let entry = |i: usize, j: usize| 1.0 / (1.0 + real((i + 2 * j) % 7)) + real(i * j % 3);
            let diagonal = |i: usize, j: usize| if i == j { 9.0 } else { 0.0 };
            let matrix = inverse.matrix(order);
            for i in 0..order {
                for j in 0..order {
                    *matrix.at(i, j) = entry(i, j) + diagonal(i, j);
                }
            }
            assert!(inverse.invert());
            for i in 0..order {
                for k in 0..order {
                    let sum: f64 = (0..order)
                        .map(|j| (entry(i, j) + diagonal(i, j)) * inverse.inverse().get(j, k))
                        .sum();
                    let expected = if i == k { 1.0 } else { 0.0 };
                    assert!((sum - expected).abs() < 1e-12, "{order}: {sum}");
                }
            }
        }
    }

    #[test]
    fn a_singular_matrix_has_no_inverse() {
        let mut inverse = Inverse::default();
        inverse.matrix(2).reset(2);
        assert!(!inverse.invert());
    }
}
