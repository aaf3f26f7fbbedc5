//! The window and the grid of a point contact as it grows: wider where the contact reaches the edge, coarser where it has become long.

use super::error::PointError;
use super::field::Axis;
use super::section::half_lengths;
use super::state::State;

/// Most cells of a window: a solve then takes half a second.
const MOST_CELLS: usize = 1 << 19;

/// Cells along a half-length of the contact, over those of the unworn one, from which on the grid is coarsened: a coarser one has still
/// as many as that.
const COARSENED: f64 = 2.2;

/// Coarsens the grids along axes on which the contact has become long against the cells per half-length of the unworn one.
pub(super) fn coarsen(state: &mut State, cells_per_half_length: f64) {
    for axis in [Axis::Along, Axis::Across] {
        let (along, across) = half_lengths(&state.pressure);
        let cells = match axis {
            Axis::Along => along,
            Axis::Across => across,
        };
        let is_long = cells > COARSENED * cells_per_half_length;
        if let Some(lattice) = state.lattice.coarsened(axis).filter(|_| is_long) {
            state.merge(axis, lattice);
        }
    }
}

/// Widens the window where the contact reaches its edge.
///
/// # Errors
/// [`PointError::Window`] if it would have too many cells.
pub(super) fn widen(state: &mut State) -> Result<(), PointError> {
    let (rows, width) = (state.lattice.cells().along_x, state.pressure.width());
    let has_load = |values: &[f64]| values.iter().any(|pressure| *pressure > 0.0);
    let pressure = &state.pressure;
    let along = has_load(pressure.rows(0, 1)) || has_load(pressure.rows(rows - 1, 1));
    let mut columns = pressure.values.chunks_exact(width);
    let across = columns.any(|row| row[0] > 0.0 || row[width - 1] > 0.0);
    let lattice = state.lattice.widened(along, across);
    let cells = lattice.cells().count();
    if cells > MOST_CELLS {
        return Err(PointError::Window {
            cells,
            most: MOST_CELLS,
        });
    }
    state.resize(lattice);
    Ok(())
}
