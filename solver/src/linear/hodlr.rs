//! Square matrices whose off-diagonal blocks have low rank (HODLR: hierarchically off-diagonal low-rank; Ambikasaran and Darve 2013).
//!
//! ```text
//!   | D0   U0 V0^T |                        levels 1, 2, ... of clusters, halved down to dense leaves;
//!   | U1 V1^T   D1 |   and D0, D1 likewise  block j of a level: rows of cluster j, columns of its sibling
//! ```

use super::cross_approximation::{CrossApproximation, Entries};
use super::vector::{add_scaled, dot, vectorized};
use std::ops::Range;

/// Most rows of a leaf. Arbitrary: 64 and 128 take as long, to 15 % (`cargo bench -p solver -- partial_slip`).
const MOST_LEAF_ROWS: usize = 96;

/// A block of low rank: where its factors begin, by columns.
#[derive(Debug, Clone, Copy)]
pub(super) struct LowRank {
    pub(super) u: usize,
    pub(super) v: usize,
    pub(super) rank: usize,
}

/// Accuracy of the approximation of blocks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Approximation {
    /// Error over the norm of a block.
    pub tolerance: f64,
    /// True if all entries of a block are compared, not only those of its crosses.
    pub compared: bool,
    /// True if the matrix is symmetric.
    pub symmetric: bool,
}

/// A matrix of few entries beside its diagonal: row, column and value, by columns.
pub(crate) type Triplets<'a> = &'a [(usize, usize, f64)];

/// Where the parts of a matrix are.
#[derive(Debug, Clone, Default)]
pub(super) struct Shape {
    pub(super) order: usize,
    pub(super) levels: u32,
    /// Blocks of level 1, then of level 2, ...
    pub(super) blocks: Vec<LowRank>,
}

impl Shape {
    /// Rows of a cluster of a level.
    pub(super) fn cluster(&self, level: u32, number: usize) -> Range<usize> {
        (self.order * number) >> level..(self.order * (number + 1)) >> level
    }

    /// The block in the rows of a cluster.
    pub(super) fn block(&self, level: u32, number: usize) -> LowRank {
        self.blocks[(1 << level) - 2 + number]
    }
}

/// A square matrix whose off-diagonal blocks have low rank. Buffers are reused.
#[derive(Debug, Clone, Default)]
pub(crate) struct Hodlr {
    pub(super) shape: Shape,
    /// Dense leaves, by columns, one after the other.
    pub(super) leaves: Vec<f64>,
    /// Factors of all blocks, level by level.
    pub(super) factors: Vec<f64>,
    /// Where those of each level begin, from level 1 on.
    pub(super) level_starts: Vec<usize>,
    cross: CrossApproximation,
}

impl Hodlr {
    /// Approximates a matrix: smooth entries, and few others beside the diagonal that are added to them.
    pub(crate) fn approximate(
        &mut self,
        order: usize,
        entries: &mut impl Entries,
        added: Triplets<'_>,
        to: Approximation,
    ) {
        self.shape.order = order;
        self.shape.levels = 0;
        while order >> self.shape.levels > MOST_LEAF_ROWS {
            self.shape.levels += 1;
        }
        self.shape.blocks.clear();
        self.factors.clear();
        self.level_starts.clear();
        for level in 1..=self.shape.levels {
            self.level_starts.push(self.factors.len());
            for number in 0..1 << level {
                let rows = self.shape.cluster(level, number);
                let columns = self.shape.cluster(level, number ^ 1);
                let mirrored = (number % 2 == 1 && to.symmetric).then(|| self.mirrored());
                let block = mirrored.unwrap_or_else(|| {
                    let (tolerance, compared) = (to.tolerance, to.compared);
                    self.cross
                        .approximate(entries, &rows, &columns, tolerance, compared);
                    self.push_block(&rows, &columns, added)
                });
                self.shape.blocks.push(block);
            }
        }
        self.write_leaves(entries, added);
    }

    /// The block beside the last one, of a symmetric matrix.
    fn mirrored(&self) -> LowRank {
        let blocks = &self.shape.blocks;
        let LowRank { u, v, rank } = blocks[blocks.len() - 1];
        LowRank { u: v, v: u, rank }
    }

    /// Stores the factors of the approximated block, and the added entries in it: a rank for each of their rows.
    fn push_block(
        &mut self,
        rows: &Range<usize>,
        columns: &Range<usize>,
        added: Triplets<'_>,
    ) -> LowRank {
        let mut beside: Vec<(usize, usize, f64)> = within(added, columns)
            .filter(|(row, ..)| rows.contains(row))
            .collect();
        beside.sort_by_key(|entry| entry.0);
        let mut distinct: Vec<usize> = beside.iter().map(|entry| entry.0).collect();
        distinct.dedup();
        let (u, v) = self.cross.factors();
        let rank = u.len() / rows.len() + distinct.len();
        let begin = self.factors.len();
        self.factors.extend_from_slice(u);
        for row in &distinct {
            let unit = self.factors.len() + row - rows.start;
            self.factors.resize(self.factors.len() + rows.len(), 0.0);
            self.factors[unit] = 1.0;
        }
        let middle = self.factors.len();
        self.factors.extend_from_slice(v);
        for row in &distinct {
            let start = self.factors.len();
            self.factors.resize(start + columns.len(), 0.0);
            for (_, column, value) in beside.iter().filter(|entry| entry.0 == *row) {
                self.factors[start + column - columns.start] += value;
            }
        }
        LowRank {
            u: begin,
            v: middle,
            rank,
        }
    }

    fn write_leaves(&mut self, entries: &mut impl Entries, added: Triplets<'_>) {
        self.leaves.clear();
        for number in 0..1 << self.shape.levels {
            let rows = self.shape.cluster(self.shape.levels, number);
            let begin = self.leaves.len();
            self.leaves.resize(begin + rows.len() * rows.len(), 0.0);
            let leaf = &mut self.leaves[begin..];
            for (column, values) in rows.clone().zip(leaf.chunks_exact_mut(rows.len())) {
                entries.column(column, rows.clone(), values);
            }
            for (row, column, value) in within(added, &rows) {
                if rows.contains(&row) {
                    leaf[(column - rows.start) * rows.len() + row - rows.start] += value;
                }
            }
        }
    }

    /// Adds to the rows of a range the product with values at a range of columns.
    pub(crate) fn add_product(
        &self,
        columns: &Range<usize>,
        values: &[f64],
        rows: &Range<usize>,
        sum: &mut [f64],
    ) {
        vectorized(
            #[inline(always)]
            || {
                let mut begin = 0;
                for number in 0..1 << self.shape.levels {
                    let own = self.shape.cluster(self.shape.levels, number);
                    self.add_leaf(&own, begin, columns, values, rows, sum);
                    begin += own.len() * own.len();
                }
                for level in 1..=self.shape.levels {
                    for number in 0..1 << level {
                        self.add_block(level, number, columns, values, rows, sum);
                    }
                }
            },
        );
    }

    #[expect(clippy::inline_always, reason = "only then it is vectorized")]
    #[inline(always)]
    fn add_leaf(
        &self,
        own: &Range<usize>,
        begin: usize,
        columns: &Range<usize>,
        values: &[f64],
        rows: &Range<usize>,
        sum: &mut [f64],
    ) {
        let (to, from) = (common(own, rows), common(own, columns));
        if to.is_empty() {
            return;
        }
        for column in from {
            let first = begin + (column - own.start) * own.len();
            let entries = &self.leaves[first + to.start - own.start..first + to.end - own.start];
            let sum = &mut sum[to.start - rows.start..to.end - rows.start];
            add_scaled(sum, values[column - columns.start], entries);
        }
    }

    #[expect(clippy::inline_always, reason = "only then it is vectorized")]
    #[inline(always)]
    fn add_block(
        &self,
        level: u32,
        number: usize,
        columns: &Range<usize>,
        values: &[f64],
        rows: &Range<usize>,
        sum: &mut [f64],
    ) {
        let block = self.shape.block(level, number);
        let own = self.shape.cluster(level, number);
        let other = self.shape.cluster(level, number ^ 1);
        let (to, from) = (common(&own, rows), common(&other, columns));
        if to.is_empty() || from.is_empty() {
            return;
        }
        let values = &values[from.start - columns.start..from.end - columns.start];
        let sum = &mut sum[to.start - rows.start..to.end - rows.start];
        for k in 0..block.rank {
            let (u, v) = (block.u + k * own.len(), block.v + k * other.len());
            let v = &self.factors[v + from.start - other.start..v + from.end - other.start];
            let u = &self.factors[u + to.start - own.start..u + to.end - own.start];
            add_scaled(sum, dot(v, values), u);
        }
    }
}

/// The entries in a range of columns.
fn within<'a>(
    added: Triplets<'a>,
    columns: &Range<usize>,
) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
    let begin = added.partition_point(|entry| entry.1 < columns.start);
    let end = added.partition_point(|entry| entry.1 < columns.end);
    added[begin..end].iter().copied()
}

/// Intersection of two ranges.
fn common(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    let start = a.start.max(b.start);
    start..a.end.min(b.end).max(start)
}
