//! Systems whose first unknowns, the core, are coupled to near ones of them and to a border of others,
//!   [A B; C D] [x; y] = [f; g],
//! with A of a half-width w. In blocks of w unknowns A is block tridiagonal, and is eliminated block by block (Golub and Van Loan 2013, section
//! 4.5). Without a core the system is dense.
//!
//! Rows are exchanged within blocks only: of systems that are the identity plus what a contact gives back, the blocks are regular.

use super::SquareMatrix;
use super::blocked_lu::{BlockedLu, Exchanges};
use super::dense::substitute;
use super::vector::add_scaled;
use faer::linalg::matmul::matmul;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};
use std::ops::Range;

/// A system to be written and solved. Buffers are reused.
#[derive(Default)]
pub(crate) struct BorderedBand {
    core: usize,
    half_width: usize,
    /// A, by columns, each from w rows above the diagonal to w below it.
    band: Vec<f64>,
    /// C, by columns.
    below: Vec<f64>,
    /// B and f, by columns.
    right: Vec<f64>,
    /// D.
    corner: SquareMatrix,
    elimination: Elimination,
}

/// Buffers of the elimination.
#[derive(Default)]
struct Elimination {
    lu: BlockedLu,
    exchanges: Exchanges,
    permuted: Vec<f64>,
    /// The block on the diagonal, the one below it, and the border's rows of these columns.
    diagonal: Vec<f64>,
    lower: Vec<f64>,
    left: Vec<f64>,
    next_left: Vec<f64>,
    /// Eliminated rows of all blocks: the block to the right, B and f.
    rows: Vec<f64>,
}

/// A column of the system.
pub(crate) struct Column<'a> {
    core: usize,
    /// Entries of the core's rows, the one of row i at i + shift.
    near: &'a mut [f64],
    shift: usize,
    border: &'a mut [f64],
}

impl Column<'_> {
    /// Adds to an entry, which is not beyond the band.
    pub(crate) fn add(&mut self, row: usize, value: f64) {
        if row < self.core {
            self.near[row.wrapping_add(self.shift)] += value;
        } else {
            self.border[row - self.core] += value;
        }
    }

    /// Multiplies all entries.
    pub(crate) fn scale(&mut self, factor: f64) {
        for entry in self.near.iter_mut().chain(self.border.iter_mut()) {
            *entry *= factor;
        }
    }
}

impl BorderedBand {
    /// Resets to a zero system of a core of some half-width, and a border.
    pub(crate) fn reset(&mut self, core: usize, half_width: usize, border: usize) {
        (self.core, self.half_width) = (core, half_width);
        self.corner.reset(border);
        for (values, length) in [
            (&mut self.band, core * (2 * half_width + 1)),
            (&mut self.below, core * border),
            (&mut self.right, core * (border + 1)),
        ] {
            values.clear();
            values.resize(length, 0.0);
        }
    }

    /// A column to be written.
    pub(crate) fn column_mut(&mut self, column: usize) -> Column<'_> {
        let (core, width, m) = (self.core, 2 * self.half_width + 1, self.corner.order());
        if column < core {
            Column {
                core,
                near: &mut self.band[column * width..(column + 1) * width],
                shift: self.half_width.wrapping_sub(column),
                border: &mut self.below[column * m..(column + 1) * m],
            }
        } else {
            let column = column - core;
            Column {
                core,
                near: &mut self.right[column * core..(column + 1) * core],
                shift: 0,
                border: self.corner.column_mut(column),
            }
        }
    }

    /// The matrix of a system without a core.
    #[cfg(test)]
    pub(crate) fn dense(&self) -> &SquareMatrix {
        &self.corner
    }

    /// Overwrites a right-hand side with the solution, and the system. Where a block is singular, the solution is not finite.
    pub(crate) fn solve(&mut self, rhs: &mut [f64]) {
        let (core, m) = (self.core, self.corner.order());
        let (f, g) = rhs.split_at_mut(core);
        self.right[m * core..].copy_from_slice(f);
        self.eliminate(g);
        let Elimination {
            lu,
            exchanges,
            permuted,
            ..
        } = &mut self.elimination;
        let corner = MatMut::from_column_major_slice_mut(self.corner.values_mut(), m, m);
        if m > 0 {
            lu.factor(corner, exchanges);
            substitute(&self.corner, &exchanges.forward, g, permuted);
        }
        self.substitute_back(f, g);
    }

    /// Blocks of the core's unknowns.
    fn blocks(&self) -> Vec<Range<usize>> {
        let (core, size) = (self.core, self.half_width.max(1));
        let begin = (0..core).step_by(size);
        begin.map(|i| i..(i + size).min(core)).collect()
    }

    /// Eliminates the core from the border: D - C A^-1 B in place of D, g - C A^-1 f in place of g.
    fn eliminate(&mut self, g: &mut [f64]) {
        let (core, m) = (self.core, self.corner.order());
        let blocks = self.blocks();
        let band = Band {
            half_width: self.half_width,
            values: &self.band,
        };
        let it = &mut self.elimination;
        it.rows.clear();
        if let Some(first) = blocks.first() {
            band.copy_block(first, first, &mut it.diagonal);
            it.left.clear();
            it.left.extend_from_slice(&self.below[..m * first.len()]);
        }
        for (k, block) in blocks.iter().enumerate() {
            let next = blocks.get(k + 1).cloned().unwrap_or(core..core);
            it.eliminate_block(band, &self.right, block, &next);
            let (s, t) = (block.len(), next.len());
            let Elimination {
                rows,
                lower,
                diagonal,
                left,
                next_left,
                ..
            } = it;
            let rows = &rows[rows.len() - s * (t + m + 1)..];
            let rows = MatRef::from_column_major_slice(rows, s, t + m + 1);
            let (to_next, rest) = (rows.subcols(0, t), rows.subcols(t, m + 1));
            let of_border = MatRef::from_column_major_slice(left, m, s);
            let corner = MatMut::from_column_major_slice_mut(self.corner.values_mut(), m, m);
            subtract(corner, of_border, rest.subcols(0, m));
            let g = MatMut::from_column_major_slice_mut(g, m, 1);
            subtract(g, of_border, rest.subcols(m, 1));
            if t == 0 {
                continue;
            }
            band.copy_block(&next, block, lower);
            let lower = MatRef::from_column_major_slice(lower, t, s);
            let right = MatMut::from_column_major_slice_mut(&mut self.right, core, m + 1);
            subtract(right.submatrix_mut(next.start, 0, t, m + 1), lower, rest);
            band.copy_block(&next, &next, diagonal);
            let diagonal = MatMut::from_column_major_slice_mut(diagonal, t, t);
            subtract(diagonal, lower, to_next);
            next_left.clear();
            next_left.extend_from_slice(&self.below[m * next.start..m * next.end]);
            let of_next = MatMut::from_column_major_slice_mut(next_left, m, t);
            subtract(of_next, of_border, to_next);
            std::mem::swap(left, next_left);
        }
    }

    /// Writes the core's unknowns over f, with those of the border.
    fn substitute_back(&self, f: &mut [f64], border: &[f64]) {
        let m = border.len();
        let mut end = self.elimination.rows.len();
        let mut next = self.core..self.core;
        for block in self.blocks().into_iter().rev() {
            let (s, t) = (block.len(), next.len());
            let rows = &self.elimination.rows[end - s * (t + m + 1)..end];
            end -= rows.len();
            let (own, after) = f[block.start..].split_at_mut(s);
            let (others, of_f) = rows.split_at(s * (t + m));
            own.copy_from_slice(of_f);
            let known = after[..t].iter().chain(border);
            for (column, x) in others.chunks_exact(s).zip(known) {
                add_scaled(own, -x, column);
            }
            next = block;
        }
    }
}

/// The core's matrix A.
#[derive(Clone, Copy)]
struct Band<'a> {
    half_width: usize,
    values: &'a [f64],
}

impl Band<'_> {
    /// Copies a block.
    fn copy_block(self, rows: &Range<usize>, columns: &Range<usize>, block: &mut Vec<f64>) {
        block.clear();
        block.resize(rows.len() * columns.len(), 0.0);
        self.write_block(rows, columns, block);
    }

    /// Writes a block over zeros.
    fn write_block(self, rows: &Range<usize>, columns: &Range<usize>, block: &mut [f64]) {
        let (w, width) = (self.half_width, 2 * self.half_width + 1);
        for (j, entries) in columns.clone().zip(block.chunks_exact_mut(rows.len())) {
            let near = rows.start.max(j.saturating_sub(w))..rows.end.min(j + w + 1);
            for i in near {
                entries[i - rows.start] = self.values[j * width + i + w - j];
            }
        }
    }
}

impl Elimination {
    /// Solves the block's rows for its unknowns: what the following ones, the border and f add.
    fn eliminate_block(
        &mut self,
        band: Band<'_>,
        right: &[f64],
        block: &Range<usize>,
        next: &Range<usize>,
    ) {
        let (s, t) = (block.len(), next.len());
        let core = band.values.len() / (2 * band.half_width + 1);
        let columns = t + right.len() / core;
        let begin = self.rows.len();
        self.rows.resize(begin + s * columns, 0.0);
        let (to_next, rest) = self.rows[begin..].split_at_mut(s * t);
        band.write_block(block, next, to_next);
        for (column, values) in right.chunks_exact(core).zip(rest.chunks_exact_mut(s)) {
            values.copy_from_slice(&column[block.clone()]);
        }
        let mut diagonal = MatMut::from_column_major_slice_mut(&mut self.diagonal, s, s);
        self.lu.factor(diagonal.rb_mut(), &mut self.exchanges);
        let rows = MatMut::from_column_major_slice_mut(&mut self.rows[begin..], s, columns);
        self.lu.solve(diagonal.rb(), &self.exchanges, rows);
    }
}

/// Subtracts a product.
fn subtract(from: MatMut<'_, f64>, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    if from.nrows() > 0 && from.ncols() > 0 {
        matmul(from, Accum::Add, a, b, -1.0, Par::Seq);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::real;

    /// Entry of a regular matrix of a core of half-width `w` and a border.
    fn entry(row: usize, column: usize, core: usize, w: usize) -> f64 {
        if row < core && column < core && row.abs_diff(column) > w {
            return 0.0;
        }
        let value = 1.0 / (1.0 + real((row + 2 * column) % 5));
        if row == column { value + 4.0 } else { value }
    }

    #[test]
    fn solutions_are_those_of_the_whole_system() {
        let mut system = BorderedBand::default();
        for (core, w, border) in [
            (0, 0, 5),
            (7, 2, 3),
            (40, 6, 4),
            (40, 6, 0),
            (12, 6, 2),
            (3, 5, 2),
            (9, 0, 1),
        ] {
            let order = core + border;
            system.reset(core, w, border);
            let mut solution = vec![0.0; order];
            for j in 0..order {
                let mut column = system.column_mut(j);
                for (i, sum) in solution.iter_mut().enumerate() {
                    let value = 0.5 * entry(i, j, core, w);
                    if value > 0.0 {
                        column.add(i, value);
                    }
                    *sum += 2.0 * value * (1.0 + real(j));
                }
                column.scale(2.0);
            }
            system.solve(&mut solution);
            for (i, x) in solution.iter().enumerate() {
                let off = (x - 1.0 - real(i)).abs();
                assert!(off < 1e-10, "{core} {w} {border}: {solution:?}");
            }
        }
    }
}
