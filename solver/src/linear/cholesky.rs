//! Sparse Cholesky factorisation with some unknowns ordered last: pattern -> factor -> solve.
//!
//! With the retained unknowns c last, K = L L^T and the trailing block L_cc of the factor is that of the Schur
//! complement S = K_cc - K_ci K_ii^-1 K_ic = L_cc L_cc^T, at no extra cost.

use super::SquareMatrix;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::inverse;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky, supernodal::SupernodalLltRef,
};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side, Spec};
use std::sync::Arc;

/// Why a matrix cannot be factored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum FactorError {
    /// The matrix is not positive definite: a body is not held, or its material is unphysical.
    #[error("the stiffness matrix of order {order} is not positive definite")]
    NotPositiveDefinite {
        /// Order.
        order: usize,
    },
    /// The pattern cannot be analysed.
    #[error("the pattern of a matrix of order {order} with {entries} entries cannot be analysed")]
    Pattern {
        /// Order.
        order: usize,
        /// Entries.
        entries: usize,
    },
}

/// Where a symmetric matrix has entries (lower triangle by columns), analysed once for many factorisations.
#[derive(Debug)]
pub(crate) struct CholeskyPattern {
    matrix: SymbolicSparseColMat<usize>,
    symbolic: SymbolicCholesky<usize>,
    retained: usize,
}

/// A factored matrix.
#[derive(Debug)]
pub(crate) struct CholeskyFactor {
    pattern: Arc<CholeskyPattern>,
    values: Vec<f64>,
}

impl CholeskyPattern {
    /// Analyses a lower triangle given by columns; the last `retained` unknowns stay last.
    ///
    /// # Errors
    /// [`FactorError::Pattern`] if the analysis fails.
    pub(crate) fn new(
        column_starts: Vec<usize>,
        rows: Vec<usize>,
        retained: usize,
    ) -> Result<Self, FactorError> {
        let order = column_starts.len() - 1;
        let error = FactorError::Pattern {
            order,
            entries: rows.len(),
        };
        let (forward, backward) =
            order_interior(&column_starts, &rows, order - retained).ok_or(error)?;
        let matrix = SymbolicSparseColMat::new_checked(order, order, column_starts, None, rows);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let ordering = SymmetricOrdering::Custom(PermRef::new_checked(&forward, &backward, order));
        let symbolic = factorize_symbolic_cholesky(matrix.as_ref(), Side::Lower, ordering, params)
            .map_err(|_| error)?;
        Ok(Self {
            matrix,
            symbolic,
            retained,
        })
    }

    /// Factors the matrix with these values, in the order of the pattern's rows.
    ///
    /// # Errors
    /// [`FactorError::NotPositiveDefinite`].
    pub(crate) fn factor(self: &Arc<Self>, values: &[f64]) -> Result<CholeskyFactor, FactorError> {
        let mut factor = vec![0.0; self.symbolic.len_val()];
        let matrix = SparseColMatRef::new(self.matrix.as_ref(), values);
        let scratch = self
            .symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        self.symbolic
            .factorize_numeric_llt(
                &mut factor,
                matrix,
                Side::Lower,
                faer::linalg::cholesky::llt::factor::LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Spec::default(),
            )
            .map_err(|_| FactorError::NotPositiveDefinite {
                order: self.matrix.nrows(),
            })?;
        Ok(CholeskyFactor {
            pattern: Arc::clone(self),
            values: factor,
        })
    }
}

/// Fill-reducing order of the interior alone, then the retained unknowns as they are.
fn order_interior(
    column_starts: &[usize],
    rows: &[usize],
    interior: usize,
) -> Option<(Vec<usize>, Vec<usize>)> {
    let order = column_starts.len() - 1;
    let mut upper_starts = vec![0];
    let mut upper_rows = Vec::with_capacity(rows.len());
    let mut counts = vec![0_usize; interior];
    for column in 0..interior {
        for &row in &rows[column_starts[column]..column_starts[column + 1]] {
            if row < interior {
                counts[row] += 1;
            }
        }
    }
    for count in &counts {
        upper_starts.push(upper_starts[upper_starts.len() - 1] + count);
    }
    upper_rows.resize(upper_starts[interior], 0);
    let mut next = upper_starts.clone();
    for column in 0..interior {
        for &row in &rows[column_starts[column]..column_starts[column + 1]] {
            if row < interior {
                upper_rows[next[row]] = column;
                next[row] += 1;
            }
        }
    }
    let entries = upper_rows.len();
    let upper =
        SymbolicSparseColMat::new_checked(interior, interior, upper_starts, None, upper_rows);
    let (mut forward, mut backward) = (vec![0; interior], vec![0; interior]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(interior, entries));
    let control = amd::Control::default();
    amd::order(
        &mut forward,
        &mut backward,
        upper.as_ref(),
        control,
        MemStack::new(&mut memory),
    )
    .ok()?;
    forward.extend(interior..order);
    backward.extend(interior..order);
    Some((forward, backward))
}

impl CholeskyFactor {
    /// The pattern that was factored, for factoring it again with other values.
    pub(crate) fn pattern(&self) -> &Arc<CholeskyPattern> {
        &self.pattern
    }

    /// Inverse of the Schur complement of the retained unknowns: their compliance, symmetric.
    pub(crate) fn retained_inverse(&self) -> SquareMatrix {
        let retained = self.pattern.retained;
        let mut lower = SquareMatrix::zeros(retained);
        self.copy_trailing(&mut lower);
        let mut out = SquareMatrix::zeros(retained);
        let mut memory = MemBuffer::new(inverse::inverse_scratch::<f64>(retained, Par::Seq));
        let l = faer::MatRef::from_column_major_slice(lower.values(), retained, retained);
        let target = MatMut::from_column_major_slice_mut(out.values_mut(), retained, retained);
        inverse::inverse(target, l, Par::Seq, MemStack::new(&mut memory));
        for column in 0..retained {
            for row in 0..column {
                *out.at(row, column) = out.get(column, row);
            }
        }
        out
    }

    /// The trailing block of the factor, whichever supernodes hold it.
    fn copy_trailing(&self, lower: &mut SquareMatrix) {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.pattern.symbolic.raw() else {
            debug_assert!(false, "a supernodal factorisation was asked for");
            return;
        };
        let first = self.pattern.matrix.nrows() - self.pattern.retained;
        let factor = SupernodalLltRef::new(symbolic, &self.values);
        for s in 0..symbolic.n_supernodes() {
            let node = factor.supernode(s);
            let (start, values) = (node.start(), node.val());
            for column in first.saturating_sub(start)..values.ncols() {
                for row in column..values.nrows() {
                    let global = match row.checked_sub(values.ncols()) {
                        None => start + row,
                        Some(below) => node.pattern()[below],
                    };
                    *lower.at(global - first, start + column - first) = values[(row, column)];
                }
            }
        }
    }

    /// Overwrites `rhs` (all unknowns) with the solution.
    pub(crate) fn solve(&self, rhs: &mut [f64]) {
        let symbolic = &self.pattern.symbolic;
        let mut memory = MemBuffer::new(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let n = rhs.len();
        LltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, n, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::real;

    /// Lower triangle of a chain of springs with unit stiffness, grounded at its first mass.
    fn chain(n: usize) -> (Vec<usize>, Vec<usize>, Vec<f64>) {
        let (mut starts, mut rows, mut values) = (vec![0], vec![], vec![]);
        for i in 0..n {
            rows.push(i);
            values.push(if i + 1 < n { 2.0 } else { 1.0 });
            if i + 1 < n {
                rows.push(i + 1);
                values.push(-1.0);
            }
            starts.push(rows.len());
        }
        (starts, rows, values)
    }

    #[test]
    fn retained_compliance_of_a_chain_is_that_of_springs_in_series() {
        let (starts, rows, values) = chain(12);
        let pattern =
            Arc::new(CholeskyPattern::new(starts, rows, 3).expect("a chain can be analysed"));
        let inverse = pattern
            .factor(&values)
            .expect("a chain is held")
            .retained_inverse();
        for i in 0..3 {
            for j in 0..3 {
                let expected = real(10 + i.min(j));
                assert!((inverse.get(i, j) - expected).abs() < 1e-12 * expected);
            }
        }
    }

    #[test]
    fn a_load_at_the_end_of_a_chain_stretches_every_spring_alike() {
        let (starts, rows, values) = chain(12);
        let pattern =
            Arc::new(CholeskyPattern::new(starts, rows, 3).expect("a chain can be analysed"));
        let mut u = vec![0.0; 12];
        u[11] = 1.0;
        pattern
            .factor(&values)
            .expect("a chain is held")
            .solve(&mut u);
        assert!(
            u.iter()
                .enumerate()
                .all(|(i, u)| (u - real(i + 1)).abs() < 1e-12)
        );
    }

    #[test]
    fn a_body_that_is_not_held_is_refused() {
        let (starts, rows, mut values) = chain(4);
        values[0] = 1.0;
        let pattern =
            Arc::new(CholeskyPattern::new(starts, rows, 1).expect("a chain can be analysed"));
        let refused = pattern.factor(&values).err();
        assert_eq!(refused, Some(FactorError::NotPositiveDefinite { order: 4 }));
    }
}
