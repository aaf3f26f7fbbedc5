//! Friction of a point contact: coefficients at the cells of its window.
//!
//! The coefficient of a cell is that of both surfaces there (`law::friction`), at the depths of the beginning of the computed cycle; one by
//! cycle is the mean of the cycles that the computed one represents. Pressures do not depend on it.

use super::energy::WholeAndSection;
use super::state::State;
use crate::change::Change;
use crate::law::friction::contact::ContactFriction;
use crate::law::friction::{Coefficients, of_both};
use crate::sides::Sides;

/// Coefficients of friction at the cells of a window, -.
pub(super) struct WindowFriction {
    of_all: f64,
    /// Coefficient of each cell where they differ.
    of_cells: Option<Vec<f64>>,
    /// Cells across.
    width: usize,
}

impl WindowFriction {
    /// Coefficients of a friction on the window of a state, with the slider at a position.
    pub(super) fn of(friction: &ContactFriction, state: &State, position: usize) -> Self {
        Self {
            of_all: state.coefficient,
            of_cells: of_cells(friction, state, position),
            width: state.lattice.cells().along_z,
        }
    }

    /// Coefficients of the cells.
    pub(super) fn coefficients(&self) -> Coefficients<'_> {
        match &self.of_cells {
            None => Coefficients::Uniform(self.of_all),
            Some(cells) => Coefficients::Local(cells),
        }
    }

    /// Largest shear traction at each cell under pressures in MPa.
    pub(super) fn bounds(&self, pressure: &[f64]) -> Vec<f64> {
        let coefficients = self.coefficients();
        let cells = pressure.iter().enumerate();
        cells
            .map(|(cell, pressure)| coefficients.at(cell) * pressure)
            .collect()
    }

    /// Mean coefficients with a weight of each cell.
    pub(super) fn means(&self, weights: &[f64]) -> WholeAndSection<f64> {
        let (coefficients, width) = (self.coefficients(), self.width);
        // The section lies between the two columns in the middle.
        let is_beside = |cell: usize| [width / 2 - 1, width / 2].contains(&(cell % width));
        let cells = weights.iter().enumerate();
        WholeAndSection {
            whole: coefficients.mean(weights.iter().copied()),
            section: coefficients.mean(cells.map(
                |(cell, weight)| {
                    if is_beside(cell) { *weight } else { 0.0 }
                },
            )),
        }
    }
}

/// Coefficient of each cell; `None` where all have the same.
fn of_cells(friction: &ContactFriction, state: &State, position: usize) -> Option<Vec<f64>> {
    if friction.by_cycle().is_some() {
        return None;
    }
    let rows = 2 * state.lattice.window().0;
    let surfaces = Sides::from_fn(|side| {
        let (law, surface) = (friction.of_surface(side)?, state.surfaces.of(side));
        let first = state.lattice.first_row(side, position);
        let doses = surface.dose_before().rows(first, rows).iter();
        let coefficients = doses.map(|dose| law.at(surface.depth_mm(*dose)));
        Some(coefficients.collect::<Vec<f64>>())
    });
    let cells = 0..state.lattice.cells().count();
    let of_cell = |cell: usize| {
        let both = surfaces.as_ref().map(|side| Some(side.as_ref()?[cell]));
        of_both(both).unwrap_or(0.0)
    };
    Some(cells.map(of_cell).collect())
}

/// Error of a computed cycle by the change of the coefficients of its places, over its energy.
pub(super) fn change_in_cycle(friction: &ContactFriction, state: &State) -> f64 {
    if friction.by_cycle().is_some() {
        return 0.0;
    }
    let surfaces = &state.surfaces;
    let depth = Change {
        before: &Sides::from_fn(|side| surfaces.of(side).depths_before_mm()),
        after: &Sides::from_fn(|side| surfaces.of(side).depths_mm()),
    };
    friction.change(depth, |side, cell| {
        let surface = surfaces.of(side);
        surface.dose.values[cell] - surface.dose_before().values[cell]
    })
}
