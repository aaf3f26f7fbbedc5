//! Banded matrices over the coupled nodes.

use std::ops::Range;

/// A square matrix with equally many diagonals on both sides of the main one.
#[derive(Debug, Default)]
pub(in crate::contact) struct Band {
    nodes: usize,
    /// Number of diagonals on each side of the main one.
    bandwidth: usize,
    /// Diagonal d holds the entries (i, i + d - bandwidth) at i.
    diagonals: Vec<f64>,
}

impl Band {
    /// Resets to a zero matrix of an order and a bandwidth.
    pub(in crate::contact) fn reset(&mut self, nodes: usize, bandwidth: usize) {
        self.nodes = nodes;
        self.bandwidth = bandwidth;
        self.diagonals.clear();
        self.diagonals.resize((2 * bandwidth + 1) * nodes, 0.0);
    }

    /// Entry (i, l), which must lie within the band.
    pub(in crate::contact) fn at(&mut self, i: usize, l: usize) -> &mut f64 {
        &mut self.diagonals[(l + self.bandwidth - i) * self.nodes + i]
    }

    /// Entry (i, i).
    pub(in crate::contact) fn diagonal(&self, i: usize) -> f64 {
        self.diagonals[self.bandwidth * self.nodes + i]
    }

    /// Number of diagonals on each side of the main one.
    pub(in crate::contact) fn bandwidth(&self) -> usize {
        self.bandwidth
    }

    /// Writes this matrix with every column multiplied by a factor, and a diagonal added to it.
    pub(in crate::contact) fn combine(
        &self,
        factor: impl Fn(usize) -> f64,
        diagonal: impl Fn(usize) -> f64,
        combined: &mut Self,
    ) {
        combined.nodes = self.nodes;
        combined.bandwidth = self.bandwidth;
        combined.diagonals.clear();
        combined.diagonals.extend_from_slice(&self.diagonals);
        for d in 0..=2 * self.bandwidth {
            for i in self.rows(d, &(0..self.nodes)) {
                combined.diagonals[d * self.nodes + i] *= factor(i + d - self.bandwidth);
            }
        }
        for i in 0..self.nodes {
            *combined.at(i, i) += diagonal(i);
        }
    }

    /// Replaces this matrix by the diagonal one of its row sums.
    pub(in crate::contact) fn lump(&mut self) {
        let (n, bandwidth) = (self.nodes, self.bandwidth);
        for d in (0..=2 * bandwidth).filter(|d| *d != bandwidth) {
            for i in self.rows(d, &(0..n)) {
                self.diagonals[bandwidth * n + i] += self.diagonals[d * n + i];
            }
        }
        self.diagonals.drain(..bandwidth * n);
        self.diagonals.truncate(n);
        self.bandwidth = 0;
    }

    /// Adds the product with the values at the nodes of a span.
    pub(in crate::contact) fn add_product(
        &self,
        span: &Range<usize>,
        values: &[f64],
        sum: &mut [f64],
    ) {
        self.for_each_term(span, values, sum, |sum, term| *sum += term);
    }

    /// Subtracts the product with the values at the nodes of a span.
    pub(in crate::contact) fn subtract_product(
        &self,
        span: &Range<usize>,
        values: &[f64],
        sum: &mut [f64],
    ) {
        self.for_each_term(span, values, sum, |sum, term| *sum -= term);
    }

    /// Applies each term of the product with the values at the nodes of a span to the result at its row.
    fn for_each_term(
        &self,
        span: &Range<usize>,
        values: &[f64],
        result: &mut [f64],
        apply: impl Fn(&mut f64, f64),
    ) {
        for d in 0..=2 * self.bandwidth {
            let rows = self.rows(d, span);
            if rows.is_empty() {
                continue;
            }
            let values = &values[rows.start + d - self.bandwidth..rows.end + d - self.bandwidth];
            let entries = &self.diagonals[d * self.nodes..][rows.clone()];
            for (result, (entry, value)) in result[rows].iter_mut().zip(entries.iter().zip(values))
            {
                apply(result, entry * value);
            }
        }
    }

    /// Adds, at the nodes of a span, a multiple of one column.
    pub(in crate::contact) fn add_column(
        &self,
        span: &Range<usize>,
        column: usize,
        value: f64,
        sum: &mut [f64],
    ) {
        let begin = column.saturating_sub(self.bandwidth).max(span.start);
        let end = (column + self.bandwidth + 1).min(span.end);
        for (i, sum) in (begin..end).zip(&mut sum[begin..end]) {
            *sum += self.diagonals[(column + self.bandwidth - i) * self.nodes + i] * value;
        }
    }

    /// Rows of diagonal d that lie in a span with their columns.
    fn rows(&self, d: usize, span: &Range<usize>) -> Range<usize> {
        let above = self.bandwidth.saturating_sub(d);
        let below = d.saturating_sub(self.bandwidth);
        span.start + above..span.end.saturating_sub(below)
    }
}
