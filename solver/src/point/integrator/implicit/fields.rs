//! Fields of all positions, one after the other, and what is done with them cell by cell.

use crate::contact::area::Cells;

/// Scales a pressure to a force in N; returns the factor.
pub(super) fn scale(cells: &Cells, force_n: f64, pressure: &mut [f64]) -> f64 {
    let factor = force_n / cells.integral(pressure);
    for p in pressure {
        *p *= factor;
    }
    factor
}

/// Mean of a field over the cells in contact.
pub(super) fn mean_in_contact(field: &[f64], pressure: &[f64]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (value, p) in field.iter().zip(pressure) {
        if *p > 0.0 {
            sum += value;
            count += 1.0;
        }
    }
    sum / f64::max(count, 1.0)
}

/// Sets a field to 0 out of contact, and subtracts its mean at each position of so many cells.
pub(super) fn remove_resultants(count: usize, pressure: &[f64], field: &mut [f64]) {
    let fields = field.chunks_exact_mut(count);
    for (field, pressure) in fields.zip(pressure.chunks_exact(count)) {
        let mean = mean_in_contact(field, pressure);
        for (value, p) in field.iter_mut().zip(pressure) {
            *value = if *p > 0.0 { *value - mean } else { 0.0 };
        }
    }
}

/// Sets a field to 0 out of contact.
pub(super) fn mask(pressure: &[f64], field: &mut [f64]) {
    for (value, p) in field.iter_mut().zip(pressure) {
        if *p <= 0.0 {
            *value = 0.0;
        }
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
