//! Sliding of a point contact by increments: the contact at each new position, with the wear of the increment inside the solve.
//!
//! The gap of an increment is that of the unworn shapes x^2/(2 R) + z^2/(2 R) plus the worn depths of both bodies; the pressure p at its
//! end wears both by p |ds| (backward Euler). The dose is spread evenly over the positions that the contact has moved through, on either
//! body, so that no ripples of the length of an increment remain. The mean rates of layers are found by repeating the solve.
//!
//! Shapes are parabolas, as Hertz': a circle of depth h is deeper by the part h/(2 R).

use super::error::PointError;
use super::field::{Axis, Field};
use super::lattice::Lattice;
use super::record::half_lengths;
use super::scene::PointScene;
use super::state::State;
use super::stick::StickSlip;
use crate::contact::area::{AreaError, NormalContact, NormalProblem};
use crate::number::{nearest, real};
use crate::sides::{Side, Sides};

/// Most cells of a window: a solve then takes half a second.
const MOST_CELLS: usize = 1 << 19;

/// Cells along a half-length of the contact, over those of the unworn one, from which on the grid is coarsened: a coarser one has still
/// as many as that.
const COARSENED: f64 = 2.2;

/// Most solves of an increment through layers, and change of the pressure over its sum at which they end.
const MOST_REPETITIONS: usize = 6;
const PRESSURE_TOLERANCE: f64 = 1e-4;

/// A point contact that slides.
pub(super) struct Sliding<'a> {
    scene: &'a PointScene,
    pub(super) state: State,
    contact: NormalContact,
    friction: StickSlip,
    /// Gap and wear on the window.
    gap: Vec<f64>,
    wear: Vec<f64>,
    /// Contact solves and their iterations.
    pub(super) work: (usize, usize),
}

/// An increment: where it ends, and the path that it wears by in mm, of all cycles that it represents.
#[derive(Debug, Clone, Copy)]
struct Increment {
    to: usize,
    worn_path_mm: f64,
    /// Cycles that it represents.
    cycles: f64,
    /// Whether it wears by the slip of each cell.
    is_partial: bool,
}

impl<'a> Sliding<'a> {
    /// The unworn contact, loaded where the first pass begins.
    pub(super) fn new(scene: &'a PointScene) -> Result<Self, PointError> {
        let state = State::unworn(scene);
        let position = state.position;
        let mut sliding = Self {
            scene,
            contact: NormalContact::new(state.lattice.cells(), scene.modulus()),
            friction: StickSlip::default(),
            gap: Vec::new(),
            wear: Vec::new(),
            state,
            work: (0, 0),
        };
        sliding.slide(position, 0.0, 0.0)?;
        Ok(sliding)
    }

    /// Returns to an earlier state.
    pub(super) fn restore(&mut self, state: State) {
        let is_other = state.lattice != self.state.lattice;
        self.state = state;
        if is_other {
            self.rebuild();
        }
    }

    /// The contact at the neutral position without the skew of a jump, which is solved for without wear and changes nothing: its pressure and
    /// its lattice.
    pub(super) fn unskewed(&mut self, jump: f64) -> Result<(Field, Lattice), PointError> {
        let state = self.state.clone();
        for side in Side::BOTH {
            self.state.surfaces.of_mut(side).unskew(jump);
        }
        let solved = self.slide(self.state.lattice.amplitude, 0.0, 0.0);
        let found = (self.state.pressure.clone(), self.state.lattice);
        self.restore(state);
        solved.map(|()| found)
    }

    /// The whole path of cycles in place, where the amplitude is not resolved.
    pub(super) fn wear_in_place(&mut self, cycles: f64) -> Result<(), PointError> {
        self.slide(0, 4.0 * self.scene.amplitude_mm.abs(), cycles)
    }

    /// Half of a pass, between a turning point and the neutral position, of a number of cycles.
    pub(super) fn half_pass(&mut self, to: usize, cycles: f64) -> Result<(), PointError> {
        let from = self.state.position;
        let cells = from.abs_diff(to);
        let length = self.scene.amplitude_mm.abs();
        let (along, _) = half_lengths(&self.state.pressure);
        let step = nearest((self.scene.accuracy.step_over_half_length * along).floor()).max(1);
        let count = cells.div_ceil(step).max(1);
        let path = length / real(count);
        for i in 1..=count {
            let moved = cells * i / count;
            let next = if to > from {
                from + moved
            } else {
                from - moved
            };
            self.slide(next, path, cycles)?;
        }
        Ok(())
    }

    /// Displaces the slider by a length in mm, of a number of cycles, where a part of the contact may stick: stick and slip under the
    /// pressure before the increment, then the pressure with the wear by the slip of each cell.
    pub(super) fn slip_partly(
        &mut self,
        displacement_mm: f64,
        cycles: f64,
    ) -> Result<(), PointError> {
        self.friction
            .advance(self.scene, &mut self.state, displacement_mm)?;
        let increment = Increment {
            to: self.state.position,
            worn_path_mm: 0.0,
            cycles,
            is_partial: true,
        };
        self.solve_widening(increment)?;
        let State {
            pressure,
            slip,
            surfaces,
            lattice,
            ..
        } = &mut self.state;
        let doses = pressure.values.iter().zip(&slip.values);
        let doses: Vec<f64> = doses
            .map(|(pressure, slip)| cycles * pressure * slip)
            .collect();
        for side in Side::BOTH {
            surfaces.of_mut(side).add(&doses);
        }
        self.state.sliding_work += lattice.cells().integral(&doses);
        Ok(())
    }

    /// One increment to a position over a path in mm, of a number of cycles.
    fn slide(&mut self, to: usize, path_mm: f64, cycles: f64) -> Result<(), PointError> {
        let increment = Increment {
            to,
            worn_path_mm: path_mm * cycles,
            cycles,
            is_partial: false,
        };
        self.solve_widening(increment)?;
        for side in Side::BOTH {
            let rows = self.rows_passed(side, increment);
            let surface = self.state.surfaces.of_mut(side);
            surface.add_dose(&self.state.pressure.values, increment.worn_path_mm, &rows);
        }
        self.state.position = to;
        self.state.sliding_work += self.scene.force_n * increment.worn_path_mm;
        Ok(())
    }

    /// Solves for the pressure at the end of an increment, on a window that holds the contact.
    fn solve_widening(&mut self, increment: Increment) -> Result<(), PointError> {
        loop {
            match self.solve(increment) {
                Ok(()) => return Ok(()),
                Err(AreaError::ReachesEdge { .. }) => self.widen()?,
                Err(error) => return Err(PointError::Contact { cycle: 0, error }),
            }
        }
    }

    /// First rows of the windows on a body that the contact moves through, without the first of them.
    fn rows_passed(&self, side: Side, increment: Increment) -> Vec<usize> {
        let State {
            lattice, position, ..
        } = &self.state;
        let last = lattice.first_row(side, increment.to);
        let first = lattice.first_row(side, *position);
        match first.cmp(&last) {
            std::cmp::Ordering::Less => (first + 1..=last).collect(),
            std::cmp::Ordering::Equal => vec![last],
            std::cmp::Ordering::Greater => (last..first).collect(),
        }
    }

    /// Solves for the pressure at the end of an increment.
    fn solve(&mut self, increment: Increment) -> Result<(), AreaError> {
        self.update_gap(increment.to);
        let is_linear = Side::BOTH.map(|side| self.state.surfaces.of(side).is_linear());
        let repetitions = if is_linear == [true, true] || increment.cycles <= 0.0 {
            1
        } else {
            MOST_REPETITIONS
        };
        for _ in 0..repetitions {
            self.update_wear(increment);
            let problem = NormalProblem {
                gap_mm: &self.gap,
                wear_mm_per_mpa: &self.wear,
                force_n: self.scene.force_n,
            };
            let pressure = &mut self.state.pressure.values;
            let before = (repetitions > 1).then(|| pressure.clone());
            let found = self.contact.solve(&problem, pressure)?;
            self.work.0 += 1;
            self.work.1 += found.iterations;
            if before.is_some_and(|before| change(&before, pressure) < PRESSURE_TOLERANCE) {
                break;
            }
        }
        Ok(())
    }

    /// Gap of the undeformed surfaces at a position of the slider.
    fn update_gap(&mut self, position: usize) {
        let State {
            lattice, surfaces, ..
        } = &self.state;
        let curvatures = self
            .scene
            .bodies
            .as_ref()
            .map(super::scene::PointBody::curvature);
        let offsets = Sides::from_fn(|side| lattice.offset_mm(side, position));
        self.gap = lattice.cells().map(|x, z| {
            let height = |side| {
                let (along, across) = *curvatures.of(side);
                let x = x + offsets.of(side);
                0.5 * (along * x * x + across * z * z)
            };
            height(Side::Slider) + height(Side::Receptacle)
        });
        let rows = 2 * lattice.window().0;
        for side in Side::BOTH {
            let surface = surfaces.of(side);
            let doses = surface.dose.rows(lattice.first_row(side, position), rows);
            for (gap, dose) in self.gap.iter_mut().zip(doses) {
                *gap += surface.depth_mm(*dose);
            }
        }
    }

    /// Wear of both surfaces per pressure in an increment, by the mean rates under the present pressure.
    fn update_wear(&mut self, increment: Increment) {
        let State {
            lattice,
            surfaces,
            pressure,
            slip,
            ..
        } = &self.state;
        self.wear.clear();
        self.wear.resize(pressure.values.len(), 0.0);
        let rows = 2 * lattice.window().0;
        for side in Side::BOTH {
            let surface = surfaces.of(side);
            let doses = surface
                .dose
                .rows(lattice.first_row(side, increment.to), rows);
            let places = doses.iter().zip(&pressure.values).zip(&slip.values);
            for (wear, ((dose, pressure), slip)) in self.wear.iter_mut().zip(places) {
                let path = if increment.is_partial {
                    increment.cycles * slip
                } else {
                    increment.worn_path_mm
                };
                *wear += path * surface.mean_rate(*dose, path * pressure);
            }
        }
    }

    /// Widens the window where the contact reaches its edge.
    fn widen(&mut self) -> Result<(), PointError> {
        let (rows, width) = (
            self.state.lattice.cells().along_x,
            self.state.pressure.width(),
        );
        let has_load = |values: &[f64]| values.iter().any(|pressure| *pressure > 0.0);
        let pressure = &self.state.pressure;
        let along = has_load(pressure.rows(0, 1)) || has_load(pressure.rows(rows - 1, 1));
        let mut columns = pressure.values.chunks_exact(width);
        let across = columns.any(|row| row[0] > 0.0 || row[width - 1] > 0.0);
        let lattice = self.state.lattice.widened((along, across));
        let cells = lattice.cells().count();
        if cells > MOST_CELLS {
            return Err(PointError::Window {
                cells,
                most: MOST_CELLS,
            });
        }
        self.state.resize(lattice);
        self.rebuild();
        Ok(())
    }

    /// Coarsens the grids along axes on which the contact has become long.
    pub(super) fn coarsen(&mut self) {
        for axis in [Axis::Along, Axis::Across] {
            let (along, across) = half_lengths(&self.state.pressure);
            let cells = match axis {
                Axis::Along => along,
                Axis::Across => across,
            };
            let is_long = cells > COARSENED * self.scene.accuracy.cells_per_half_length;
            let Some(lattice) = self.state.lattice.coarsened(axis).filter(|_| is_long) else {
                continue;
            };
            self.state.merge(axis, lattice);
            self.rebuild();
        }
    }

    fn rebuild(&mut self) {
        self.friction = StickSlip::default();
        self.contact = NormalContact::new(self.state.lattice.cells(), self.scene.modulus());
    }
}

/// Sum of the changes of a pressure over its sum.
fn change(before: &[f64], after: &[f64]) -> f64 {
    let changes = before.iter().zip(after).map(|(a, b)| (a - b).abs());
    changes.sum::<f64>() / after.iter().sum::<f64>()
}
