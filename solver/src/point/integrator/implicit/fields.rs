//! Fields of all positions, one after the other, and what is done with them cell by cell.

use crate::contact::area::Cells;
use crate::linear::vector::dot;

/// Scales a pressure to a force in N; returns the factor.
pub(super) fn scale(cells: &Cells, force_n: f64, pressure: &mut [f64]) -> f64 {
    let factor = force_n / cells.integral(pressure);
    for p in pressure {
        *p *= factor;
    }
    factor
}

/// Sets a field to 0 in cells that are not free, and subtracts its mean in the others at each position of so many cells.
pub(super) fn remove_resultants(count: usize, free: &[f64], field: &mut [f64]) {
    let fields = field.chunks_exact_mut(count);
    for (field, free) in fields.zip(free.chunks_exact(count)) {
        let mean = dot(field, free) / free.iter().sum::<f64>().max(1.0);
        for (value, free) in field.iter_mut().zip(free) {
            *value = free * (*value - mean);
        }
    }
}

/// Sets a field to 0 in cells that are not free.
pub(super) fn mask(free: &[f64], field: &mut [f64]) {
    for (value, free) in field.iter_mut().zip(free) {
        *value *= free;
    }
}

/// Returns `true` if a contact has the outermost cells of its window.
pub(super) fn reaches_edge(cells: &Cells, pressure: &[f64]) -> bool {
    let Cells {
        along_x, along_z, ..
    } = *cells;
    let is_edge = |index: usize| {
        let (i, j) = (index / along_z, index % along_z);
        i == 0 || i + 1 == along_x || j == 0 || j + 1 == along_z
    };
    let mut loaded = pressure.iter().enumerate().filter(|(_, p)| **p > 0.0);
    loaded.any(|(index, _)| is_edge(index % cells.count()))
}

/// Adds the mirrored field to a field.
pub(super) fn add_mirrored(field: &mut [f64]) {
    let (left, right) = field.split_at_mut(field.len() / 2);
    for (a, b) in left.iter_mut().zip(right.iter_mut().rev()) {
        let sum = *a + *b;
        (*a, *b) = (sum, sum);
    }
}
