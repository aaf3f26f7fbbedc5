//! Values on a grid of cells about a middle: they can be moved to a larger grid or to cells of twice the size.

use serde::{Deserialize, Serialize};

use crate::contact::area::Cells;

/// A direction of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// The sliding direction.
    Along,
    /// The other one.
    Across,
}

/// A value for each cell of a grid about a middle, which lies between cells.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Field {
    /// Cells on either side of the middle, along and across.
    half: (usize, usize),
    /// The one at (i, j) has the index i width + j.
    pub(super) values: Vec<f64>,
}

impl Field {
    /// Zero everywhere.
    pub(super) fn zero(half: (usize, usize)) -> Self {
        Self {
            half,
            values: vec![0.0; 4 * half.0 * half.1],
        }
    }

    /// Cells on either side of the middle, along and across.
    pub(super) fn half(&self) -> (usize, usize) {
        self.half
    }

    /// Of these values.
    pub(super) fn of(half: (usize, usize), values: Vec<f64>) -> Self {
        debug_assert!(values.len() == 4 * half.0 * half.1, "each cell has a value");
        Self { half, values }
    }

    /// Cells across.
    pub(super) fn width(&self) -> usize {
        2 * self.half.1
    }

    /// Cells of a size in mm.
    pub(super) fn cells(&self, (dx_mm, dz_mm): (f64, f64)) -> Cells {
        Cells {
            along_x: 2 * self.half.0,
            along_z: 2 * self.half.1,
            dx_mm,
            dz_mm,
        }
    }

    /// The values of whole rows along the sliding direction.
    pub(super) fn rows(&self, first: usize, count: usize) -> &[f64] {
        let width = self.width();
        &self.values[first * width..(first + count) * width]
    }

    /// The same, to be changed.
    pub(super) fn rows_mut(&mut self, first: usize, count: usize) -> &mut [f64] {
        let width = self.width();
        &mut self.values[first * width..(first + count) * width]
    }

    /// The field on a grid of another length and width about the same middle; 0 where it had no cells.
    #[must_use]
    pub(super) fn resized(&self, half: (usize, usize)) -> Self {
        let mut resized = Self::zero(half);
        let common = (half.0.min(self.half.0), half.1.min(self.half.1));
        for row in 0..2 * common.0 {
            let at = |of: &Self| (of.half.0 - common.0 + row) * of.width() + of.half.1 - common.1;
            let (from, to) = (at(self), at(&resized));
            let source = &self.values[from..from + 2 * common.1];
            resized.values[to..to + 2 * common.1].copy_from_slice(source);
        }
        resized
    }

    /// The means of pairs of cells, on a grid of at least the same length.
    #[must_use]
    pub(super) fn merged(&self, axis: Axis) -> Self {
        let even = |half: usize| half.next_multiple_of(2);
        match axis {
            Axis::Along => {
                let from = self.resized((even(self.half.0), self.half.1));
                let mut merged = Self::zero((from.half.0 / 2, from.half.1));
                let width = from.width();
                let pairs = from.values.chunks_exact(2 * width);
                for (row, pair) in merged.values.chunks_exact_mut(width).zip(pairs) {
                    for (value, (a, b)) in
                        row.iter_mut().zip(pair[..width].iter().zip(&pair[width..]))
                    {
                        *value = 0.5 * (a + b);
                    }
                }
                merged
            }
            Axis::Across => {
                let from = self.resized((self.half.0, even(self.half.1)));
                let pairs = from.values.chunks_exact(2);
                Self {
                    half: (from.half.0, from.half.1 / 2),
                    values: pairs.map(|pair| 0.5 * (pair[0] + pair[1])).collect(),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field() -> Field {
        let mut field = Field::zero((1, 2));
        field.values = vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
        field
    }

    #[test]
    fn a_larger_grid_has_the_same_values_about_its_middle() {
        let larger = field().resized((2, 3));
        assert_eq!(larger.rows(1, 1), [0.0, 1.0, 2.0, 3.0, 4.0, 0.0]);
        assert_eq!(larger.resized((1, 2)), field());
    }

    #[test]
    fn merged_cells_keep_the_integral() {
        let across = field().merged(Axis::Across);
        assert_eq!(across.values, [1.5, 3.5, 5.5, 7.5]);
        // One row on either side of the middle: each is merged with an empty one.
        let along = field().merged(Axis::Along);
        assert_eq!(along.rows(0, 1), [0.5, 1.0, 1.5, 2.0]);
        let sum: f64 = along.values.iter().sum();
        assert!((sum - 18.0).abs() < 1e-14);
    }
}
