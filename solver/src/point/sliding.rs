//! Sliding of a point contact by increments: the contact at each new position, with the wear of the increment inside the solve.
//!
//! The gap of an increment is that of the unworn shapes x^2/(2 R) + z^2/(2 R) plus the worn depths of both bodies; the pressure p at its
//! end wears both by p |ds| (backward Euler). The dose is spread evenly over the positions that the contact has moved through, on either
//! body, so that no ripples of the length of an increment remain. The wear through layers is no linear function of the pressure: it is
//! linearised about that of the last solve, by Newton's method.
//!
//! Shapes are parabolas, as Hertz': a circle of depth h is deeper by the part h/(2 R).

mod solve;

use std::cmp::Ordering;
use std::ops::Range;

use super::contact_at_position::ContactAtPosition;
use super::energy::WholeAndSection;
use super::error::PointError;
use super::friction::WindowFriction;
use super::section::{half_lengths, section_integral};
use super::spring;
use super::state::State;
use super::stick::StickSlip;
use super::window::widen;
use crate::closed_form::PointScene;
use crate::contact::area::{AreaError, NormalContact};
use crate::law::friction::contact::ContactFriction;
use crate::number::{nearest, real};
use crate::schedule::plan::Cycles;
use crate::sides::Side;

/// Solves the increments of a point contact that slides.
pub(super) struct Sliding {
    scene: PointScene,
    contact: NormalContact,
    friction: ContactFriction,
    stick: StickSlip,
    /// Gap before the increment on the window, and, as linear functions of the pressure, the gap with the wear of the increment.
    gap: Vec<f64>,
    unloaded_gap: Vec<f64>,
    wear: Vec<f64>,
    dose: Vec<f64>,
}

/// An increment: where it ends, and the path that it wears by in mm, of all cycles that it represents.
#[derive(Debug, Clone, Copy)]
struct Increment {
    to: usize,
    worn_path_mm: f64,
    /// Cycles that it represents.
    cycles: f64,
    /// True if it wears by the slip of each cell.
    is_partial: bool,
}

impl Sliding {
    /// For a contact in a state.
    pub(super) fn new(scene: &PointScene, friction: ContactFriction, state: &State) -> Self {
        Self {
            scene: *scene,
            contact: NormalContact::new(state.lattice.cells(), scene.modulus()),
            friction,
            stick: StickSlip::default(),
            gap: Vec::new(),
            unloaded_gap: Vec::new(),
            wear: Vec::new(),
            dose: Vec::new(),
        }
    }

    /// Takes the motion of another block of a mission.
    pub(super) fn take_motion(&mut self, scene: &PointScene) {
        self.scene = *scene;
    }

    /// Friction of the contact.
    pub(super) fn friction(&self) -> &ContactFriction {
        &self.friction
    }

    /// Begins a computed cycle of these cycles, or a movement without wear.
    pub(super) fn begin(&self, state: &mut State, cycles: Cycles) {
        for side in Side::BOTH {
            state.surfaces.of_mut(side).begin_cycle();
        }
        self.update_coefficient(state, cycles);
    }

    /// Takes the mean coefficient of these cycles, where it is the same at every place.
    pub(super) fn update_coefficient(&self, state: &mut State, cycles: Cycles) {
        if let Some(table) = self.friction.by_cycle() {
            let Range { start, end } = cycles.range();
            state.coefficient = table.mean(start, end);
        }
    }

    /// The contact in a state, slipping into a direction.
    pub(super) fn contact(&self, state: &State, direction: f64) -> ContactAtPosition {
        let friction = WindowFriction::of(&self.friction, state, state.position);
        ContactAtPosition::of(&self.scene, &friction, state, direction)
    }

    /// Slides to the neutral position without wear, where all of the contact has slipped in a direction, 1 or -1.
    pub(super) fn slip_to_neutral(
        &mut self,
        state: &mut State,
        direction: f64,
    ) -> Result<(), PointError> {
        let neutral = state.lattice.amplitude;
        self.slide(state, neutral, 0.0, 0.0)?;
        state.forget_shear();
        let friction = WindowFriction::of(&self.friction, state, state.position);
        let coefficients = friction.coefficients();
        let pressures = state.pressure.values.iter().enumerate();
        let shear = pressures.map(|(cell, pressure)| direction * coefficients.at(cell) * pressure);
        state.shear.0.values = shear.collect();
        Ok(())
    }

    /// Loads the unworn contact where the first pass begins.
    pub(super) fn load(&mut self, state: &mut State) -> Result<(), PointError> {
        self.slide(state, state.position, 0.0, 0.0)?;
        state.unworn_approach_mm = Some(state.approach_mm);
        Ok(())
    }

    /// The contact at the neutral position without the skew of a jump, which is solved for without wear and changes nothing.
    /// `force_n` is the load there.
    pub(super) fn unskewed(
        &mut self,
        state: &State,
        jump: f64,
        force_n: f64,
    ) -> Result<State, PointError> {
        let mut state = State {
            force_n,
            ..state.clone()
        };
        for side in Side::BOTH {
            state.surfaces.of_mut(side).unskew(jump);
        }
        let neutral = state.lattice.amplitude;
        self.slide(&mut state, neutral, 0.0, 0.0)?;
        Ok(state)
    }

    /// The whole path of cycles in place at the neutral position, where the amplitude is not resolved.
    pub(super) fn wear_in_place(
        &mut self,
        state: &mut State,
        cycles: f64,
    ) -> Result<(), PointError> {
        let neutral = state.lattice.amplitude;
        self.slide(state, neutral, self.scene.path_mm(), cycles)
    }

    /// A part of a pass to a position over a length in mm, of a number of cycles.
    pub(super) fn pass(
        &mut self,
        state: &mut State,
        to: usize,
        length: f64,
        cycles: f64,
    ) -> Result<(), PointError> {
        let from = state.position;
        let cells = from.abs_diff(to);
        let (along, _) = half_lengths(&state.pressure);
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
            self.slide(state, next, path, cycles)?;
        }
        Ok(())
    }

    /// Displaces the slider by a length in mm, of a number of cycles, where a part of the contact may stick: stick and slip under the
    /// pressure before the increment, then the pressure with the wear by the slip of each cell.
    pub(super) fn slip_partly(
        &mut self,
        state: &mut State,
        displacement_mm: f64,
        cycles: f64,
    ) -> Result<(), PointError> {
        self.fit(state);
        let friction = WindowFriction::of(&self.friction, state, state.position);
        let bounds = friction.bounds(&state.pressure.values);
        let (scene, stick) = (&self.scene, &mut self.stick);
        stick.advance(scene, &bounds, state, displacement_mm)?;
        let increment = Increment {
            to: state.position,
            worn_path_mm: 0.0,
            cycles,
            is_partial: true,
        };
        self.solve_widening(state, increment)?;
        self.dose.clear();
        let doses = state.pressure.values.iter().zip(&state.slip.values);
        self.dose
            .extend(doses.map(|(pressure, slip)| cycles * pressure * slip));
        for side in Side::BOTH {
            let first_row = state.lattice.first_row(side, state.position);
            state.surfaces.of_mut(side).add(&self.dose, first_row);
        }
        let cells = state.lattice.cells();
        let work = WholeAndSection {
            whole: cells.integral(&self.dose),
            section: section_integral(&cells, &self.dose),
        };
        // The window may have been widened.
        let friction = WindowFriction::of(&self.friction, state, state.position);
        state.add_work(work, friction.means(&self.dose));
        state.force_n = spring::next_force_n(&self.scene, state);
        Ok(())
    }

    /// One increment to a position over a path in mm, of a number of cycles.
    fn slide(
        &mut self,
        state: &mut State,
        to: usize,
        path_mm: f64,
        cycles: f64,
    ) -> Result<(), PointError> {
        let increment = Increment {
            to,
            worn_path_mm: path_mm * cycles,
            cycles,
            is_partial: false,
        };
        self.solve_widening(state, increment)?;
        for side in Side::BOTH {
            let rows = rows_passed(state, side, increment);
            let surface = state.surfaces.of_mut(side);
            surface.add_dose(&state.pressure.values, increment.worn_path_mm, rows);
        }
        state.position = to;
        let line_load = section_integral(&state.lattice.cells(), &state.pressure.values);
        let work = WholeAndSection {
            whole: state.force_n * increment.worn_path_mm,
            section: line_load * increment.worn_path_mm,
        };
        let friction = WindowFriction::of(&self.friction, state, to);
        state.add_work(work, friction.means(&state.pressure.values));
        state.force_n = spring::next_force_n(&self.scene, state);
        Ok(())
    }

    /// Solves for the pressure at the end of an increment, on a window that holds the contact.
    fn solve_widening(
        &mut self,
        state: &mut State,
        increment: Increment,
    ) -> Result<(), PointError> {
        loop {
            match self.solve(state, increment) {
                Ok(()) => return Ok(()),
                Err(AreaError::ReachesEdge { .. }) => widen(state)?,
                Err(error) => return Err(PointError::Contact { cycle: 0, error }),
            }
        }
    }

    /// Solves for the contact at a position of the slider without wear.
    pub(super) fn settle(&mut self, state: &mut State, position: usize) -> Result<(), PointError> {
        self.slide(state, position, 0.0, 0.0)
    }
}

/// First rows of the windows on a body that the contact moves through in an increment, without the one where it is.
fn rows_passed(state: &State, side: Side, increment: Increment) -> Range<usize> {
    let last = state.lattice.first_row(side, increment.to);
    let first = state.lattice.first_row(side, state.position);
    match first.cmp(&last) {
        Ordering::Less => first + 1..last + 1,
        Ordering::Equal => last..last + 1,
        Ordering::Greater => last..first,
    }
}
