//! Low-rank approximation of a matrix block from few of its rows and columns: adaptive cross approximation with partial pivoting
//! (Bebendorf 2000; Bebendorf and Rjasanow 2003).
//!
//! With the residual R_k = A - sum_l u_l v_l^T of the first k crosses, the next one is v = R(i, :)/R(i, j), u = R(:, j), j the
//! column of the largest entry of row i, and the next row that of the largest entry of u. Rows near the other cluster, where a
//! kernel is largest, are looked at again when a cross is small: a block of several kinds of equations may be
//! zero in one kind of its columns.

use super::vector::{add_scaled, vectorized};
use std::ops::Range;

/// Rows beside the other cluster that are looked at before a block is taken as approximated: both kinds of equations at some
/// nodes.
const CHECKED_ROWS: usize = 6;

/// A matrix whose entries are computed by rows and columns.
pub(crate) trait Entries {
    /// Writes the entries of a row at a range of columns.
    fn row(&mut self, row: usize, columns: Range<usize>, entries: &mut [f64]);

    /// Writes the entries of a column at a range of rows.
    fn column(&mut self, column: usize, rows: Range<usize>, entries: &mut [f64]);
}

/// Factors U and V of blocks U V^T, by columns, one block after the other.
#[derive(Debug, Clone, Default)]
pub(super) struct CrossApproximation {
    u: Vec<f64>,
    v: Vec<f64>,
    used: Vec<bool>,
    row: Vec<f64>,
    column: Vec<f64>,
    /// Largest product of the norms of a cross.
    largest: f64,
}

impl CrossApproximation {
    /// Approximates a block to a part of its norm, by what its crosses show or with each of its rows compared.
    pub(super) fn approximate(
        &mut self,
        entries: &mut impl Entries,
        rows: &Range<usize>,
        columns: &Range<usize>,
        tolerance: f64,
        compared: bool,
    ) {
        self.u.clear();
        self.v.clear();
        self.used.clear();
        self.used.resize(rows.len(), false);
        self.largest = 0.0;
        let nearest = |k: usize| {
            if rows.start < columns.start {
                rows.len() - 1 - k
            } else {
                k
            }
        };
        let looked_at = if compared {
            rows.len()
        } else {
            CHECKED_ROWS.min(rows.len())
        };
        for k in 0..looked_at {
            self.add_crosses(entries, rows, columns, nearest(k), tolerance);
        }
    }

    /// Adds crosses, from a row on, until one is smaller than a part of the largest.
    fn add_crosses(
        &mut self,
        entries: &mut impl Entries,
        rows: &Range<usize>,
        columns: &Range<usize>,
        first: usize,
        tolerance: f64,
    ) {
        let mut next = Some(first);
        while let Some(i) = next.filter(|i| !self.used[*i]) {
            self.used[i] = true;
            if self.v.len() / columns.len() >= rows.len().min(columns.len()) {
                return;
            }
            self.row.resize(columns.len(), 0.0);
            entries.row(rows.start + i, columns.clone(), &mut self.row);
            subtract(&self.v, &self.u, i, &mut self.row);
            let j = largest_of(self.row.iter().map(|entry| entry.abs()));
            let pivot = self.row[j];
            // A row without a part that counts has no column that would show more.
            let row_norm = norm(&self.row);
            if pivot == 0.0 || row_norm * norm_of_ones(rows.len()) <= tolerance * self.largest {
                return;
            }
            self.column.resize(rows.len(), 0.0);
            entries.column(columns.start + j, rows.clone(), &mut self.column);
            subtract(&self.u, &self.v, j, &mut self.column);
            let size = row_norm / pivot.abs() * norm(&self.column);
            self.v.extend(self.row.iter().map(|entry| entry / pivot));
            self.u.extend_from_slice(&self.column);
            self.largest = self.largest.max(size);
            if size <= tolerance * self.largest {
                return;
            }
            let used = self.used.iter();
            let unused = self
                .column
                .iter()
                .zip(used)
                .map(|(entry, used)| if *used { -1.0 } else { entry.abs() });
            next = Some(largest_of(unused));
        }
    }

    /// U and V.
    pub(super) fn factors(&self) -> (&[f64], &[f64]) {
        (&self.u, &self.v)
    }
}

/// Subtracts from a row or column what the crosses have of it: `along` holds their factors along it, `across` those across.
fn subtract(along: &[f64], across: &[f64], at: usize, values: &mut [f64]) {
    let crosses = along.len() / values.len();
    let stride = across.len().checked_div(crosses).unwrap_or(0);
    vectorized(
        #[inline(always)]
        || {
            for (k, factor) in along.chunks_exact(values.len()).enumerate() {
                add_scaled(values, -across[k * stride + at], factor);
            }
        },
    );
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Norm of a vector of ones.
fn norm_of_ones(length: usize) -> f64 {
    crate::number::real(length).sqrt()
}

/// Place of the first of the largest values.
fn largest_of(values: impl Iterator<Item = f64>) -> usize {
    let mut largest = (0, f64::NEG_INFINITY);
    for (i, value) in values.enumerate() {
        if value > largest.1 {
            largest = (i, value);
        }
    }
    largest.0
}
