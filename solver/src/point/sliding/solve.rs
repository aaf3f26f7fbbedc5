//! Solve of an increment: its gap with the wear that is linearised about the last pressure.

use super::{Increment, Sliding};
use crate::contact::area::{AreaError, NormalContact, NormalProblem};
use crate::point::state::State;
use crate::point::stick::StickSlip;
use crate::sides::Side;

/// Most solves of an increment through layers, and change of the pressure over its sum at which they end.
const MOST_REPETITIONS: usize = 12;
const PRESSURE_TOLERANCE: f64 = 1e-4;

impl Sliding {
    /// Builds the operators again where the grid has changed.
    pub(super) fn fit(&mut self, state: &State) {
        let cells = state.lattice.cells();
        if *self.contact.cells() != cells {
            self.stick = StickSlip::default();
            self.contact = NormalContact::new(cells, self.scene.modulus());
        }
    }

    /// Solves for the pressure at the end of an increment.
    pub(super) fn solve(
        &mut self,
        state: &mut State,
        increment: Increment,
    ) -> Result<(), AreaError> {
        let cells = state.lattice.cells();
        self.fit(state);
        self.update_gap(state, increment.to);
        let is_linear = Side::BOTH.map(|side| state.surfaces.of(side).is_linear());
        let repetitions = if is_linear == [true, true] || increment.cycles <= 0.0 {
            1
        } else {
            MOST_REPETITIONS
        };
        for _ in 0..repetitions {
            self.update_wear(state, increment);
            let problem = NormalProblem {
                gap_mm: &self.unloaded_gap,
                wear_mm_per_mpa: &self.wear,
                force_n: state.force_n,
            };
            let pressure = &mut state.pressure.values;
            let before = (repetitions > 1).then(|| pressure.clone());
            let found = self.contact.solve(&problem, pressure)?;
            state.approach_mm = found.approach_mm;
            state.work.0 += 1;
            state.work.1 += found.iterations;
            let force = (cells.integral(pressure) / state.force_n - 1.0).abs();
            let worst = &mut state.worst_residuals;
            *worst = (worst.0.max(force), worst.1.max(found.residual));
            if before.is_some_and(|before| change(&before, pressure) < PRESSURE_TOLERANCE) {
                break;
            }
        }
        Ok(())
    }

    /// Gap of the undeformed surfaces at a position of the slider.
    fn update_gap(&mut self, state: &State, position: usize) {
        self.gap = state.lattice.unworn_gap_mm(&self.scene, position);
        let State {
            lattice, surfaces, ..
        } = state;
        let rows = 2 * lattice.window().0;
        for side in Side::BOTH {
            let surface = surfaces.of(side);
            let doses = surface.dose.rows(lattice.first_row(side, position), rows);
            for (gap, dose) in self.gap.iter_mut().zip(doses) {
                *gap += surface.depth_mm(*dose);
            }
        }
    }

    /// Linearises the wear of both surfaces in an increment about the present pressure.
    fn update_wear(&mut self, state: &State, increment: Increment) {
        let State {
            lattice,
            surfaces,
            pressure,
            slip,
            ..
        } = state;
        self.wear.clear();
        self.wear.resize(pressure.values.len(), 0.0);
        self.unloaded_gap.clone_from(&self.gap);
        let rows = 2 * lattice.window().0;
        for side in Side::BOTH {
            let surface = surfaces.of(side);
            let doses = surface
                .dose
                .rows(lattice.first_row(side, increment.to), rows);
            let places = doses.iter().zip(&pressure.values).zip(&slip.values);
            let linear = self.unloaded_gap.iter_mut().zip(&mut self.wear);
            for ((gap, wear), ((dose, pressure), slip)) in linear.zip(places) {
                let path = if increment.is_partial {
                    increment.cycles * slip
                } else {
                    increment.worn_path_mm
                };
                let added = path * pressure;
                let (worn, rate) = surface.growth(*dose, added);
                *gap += worn - rate * added;
                *wear += path * rate;
            }
        }
    }
}

/// Sum of the changes of a pressure over its sum.
fn change(before: &[f64], after: &[f64]) -> f64 {
    let changes = before.iter().zip(after).map(|(a, b)| (a - b).abs());
    changes.sum::<f64>() / after.iter().sum::<f64>()
}
