//! The contact at a position of the slider: its pressure and shear, where they are, and what they add up to.

use serde::{Deserialize, Serialize};

use super::friction::WindowFriction;
use super::section::{half_lengths, section, section_integral};
use super::state::State;
use crate::closed_form::{PointScene, SlipRegime};
use crate::contact::area::Cells;
use crate::sides::Sides;

/// The contact at a position of the slider.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ContactAtPosition {
    pub(super) peak_pressure_mpa: f64,
    pub(super) half_lengths_mm: (f64, f64),
    pub(super) line_load_n_per_mm: f64,
    pub(super) force_n: f64,
    /// Middle of the window on each body, mm.
    pub(super) middle_mm: Sides<f64>,
    pub(crate) cells: Cells,
    pub(crate) pressure_mpa: Vec<f64>,
    /// Shear on the receptacle along the middle section, MPa.
    pub(crate) shear_mpa: Vec<f64>,
    /// Mean coefficient of friction, weighted by the pressure, -.
    pub(super) friction: f64,
    /// Line load, N/mm, and the tangential force of the whole contact, N.
    pub(super) tangential: (f64, f64),
}

impl ContactAtPosition {
    /// Centres of the rows of cells on the receptacle, mm.
    pub(crate) fn x_on_receptacle(&self) -> Vec<f64> {
        let rows = 0..self.cells.along_x;
        rows.map(|row| self.middle_mm.receptacle + self.cells.x_mm(row))
            .collect()
    }

    /// Pressure along the middle section, MPa.
    pub(crate) fn section_pressure(&self) -> Vec<f64> {
        section(self.cells.along_z, &self.pressure_mpa).collect()
    }

    /// The contact in a state of a scene under the friction of its window, slipping into a direction.
    pub(super) fn of(
        scene: &PointScene,
        friction: &WindowFriction,
        state: &State,
        direction: f64,
    ) -> Self {
        let (window, pressure) = (state.lattice.cells(), &state.pressure);
        let shear = match scene.slip {
            SlipRegime::Gross => {
                let coefficients = friction.coefficients();
                let pressures = pressure.values.iter().enumerate();
                let shear = pressures.map(|(cell, p)| direction * coefficients.at(cell) * p);
                shear.collect()
            }
            SlipRegime::Partial => state.shear.0.values.clone(),
        };
        let (along, across) = half_lengths(pressure);
        Self {
            peak_pressure_mpa: pressure.values.iter().fold(0.0, |most, p| p.max(most)),
            half_lengths_mm: (along * window.dx_mm, across * window.dz_mm),
            line_load_n_per_mm: section_integral(&window, &pressure.values),
            force_n: window.integral(&pressure.values),
            middle_mm: Sides::from_fn(|side| state.lattice.offset_mm(side, state.position)),
            cells: window,
            pressure_mpa: pressure.values.clone(),
            shear_mpa: section(window.along_z, &shear).collect(),
            friction: friction.means(&pressure.values).whole,
            tangential: (section_integral(&window, &shear), window.integral(&shear)),
        }
    }
}
