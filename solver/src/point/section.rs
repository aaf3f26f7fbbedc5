//! The middle section of a field, z = 0, which lies between the two columns in the middle of a grid.

use super::field::Field;
use crate::contact::area::Cells;
use crate::number::real;

/// Values along the middle section: the means of the two columns beside it.
pub(super) fn section(width: usize, values: &[f64]) -> impl Iterator<Item = f64> {
    let (left, right) = (width / 2 - 1, width / 2);
    let rows = values.chunks_exact(width);
    rows.map(move |row| 0.5 * (row[left] + row[right]))
}

/// Integral along the middle section: the line load in N/mm of a pressure in MPa.
pub(super) fn section_integral(cells: &Cells, values: &[f64]) -> f64 {
    cells.dx_mm * section(cells.along_z, values).sum::<f64>()
}

/// Half-lengths of a contact along and across, in cells: to where the line load of the pressure, extended from the two outermost rows
/// on either side, vanishes, at most a row further. Exact for Hertz' ellipse, whose line load is a parabola, to the second order.
pub(super) fn half_lengths(pressure: &Field) -> (f64, f64) {
    let width = pressure.width();
    let along: Vec<f64> = pressure
        .values
        .chunks_exact(width)
        .map(|row| row.iter().sum())
        .collect();
    let mut across = vec![0.0; width];
    for row in pressure.values.chunks_exact(width) {
        for (sum, pressure) in across.iter_mut().zip(row) {
            *sum += pressure;
        }
    }
    (half_length(&along), half_length(&across))
}

fn half_length(load: &[f64]) -> f64 {
    let first = load.iter().position(|load| *load > 0.0);
    let last = load.iter().rposition(|load| *load > 0.0);
    let (Some(first), Some(last)) = (first, last) else {
        return 0.0;
    };
    if last - first < 2 {
        return 0.5 * real(last - first + 1);
    }
    let beyond = |outer: f64, inner: f64| {
        if inner > outer {
            (outer / (inner - outer)).min(1.0)
        } else {
            1.0
        }
    };
    let ends = beyond(load[first], load[first + 1]) + beyond(load[last], load[last - 1]);
    0.5 * (real(last - first) + ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_half_length_of_a_parabola_is_found_between_cells() {
        for edge in [8.2_f64, 8.5, 8.9] {
            let load: Vec<f64> = (0..24)
                .map(|i| (1.0 - ((f64::from(i) - 11.5) / edge).powi(2)).max(0.0))
                .collect();
            let found = half_length(&load);
            assert!((found / edge - 1.0).abs() < 0.012, "{edge}: {found}");
        }
    }

    #[test]
    fn the_middle_section_lies_between_the_middle_columns() {
        let cells = Cells {
            along_x: 2,
            along_z: 4,
            dx_mm: 0.5,
            dz_mm: 3.0,
        };
        let values = [9.0, 1.0, 3.0, 9.0, 9.0, 2.0, 4.0, 9.0];
        assert_eq!(section(4, &values).collect::<Vec<_>>(), [2.0, 3.0]);
        assert!((section_integral(&cells, &values) - 2.5).abs() < 1e-15);
    }
}
