//! Steps of Newton's method for the pressures at all positions of a cycle.
//!
//! For the present contacts and layers what opens the gaps is linear in the pressures. The step of the free cells follows from it by conjugate
//! gradients in the product sum path a b over all positions, with a resultant of zero at each of them, preconditioned by the inverse on the whole
//! plane (`filter`) with what the layers differ from their mean by (`surface`): 5 to 20 iterations.
//!
//! The end of the step is cut off at 0, stopped where a place comes to its next faster layer, and scaled to the force: it is feasible, and so
//! is the straight way to it. The step goes to the least energy on that way, which is convex and falls there at first; where it would not, the
//! step is shortened before it is cut off. Cells that a step would have cut off, had it gone to its end, leave in the next one: at once where the
//! energy falls until they are open. Of a plated ball, the sets of cells recur for ever with steps to their ends, and without leaving cells the
//! iterations are twice as many.

use super::fields::{mask, remove_resultants, scale};
use super::pressures::{CyclePressures, JumpSurfaces};
use crate::sides::{Side, Sides};

/// Most iterations of a step, and residual over that at its beginning, in the norm of the preconditioner, at which they end. Arbitrary: 0.05 and 0.2
/// take 7 % more and less for a plated ball.
const MOST_ITERATIONS: usize = 30;
const SOLVED_TO: f64 = 0.1;

/// Slope of the energy along the way to the end of a step over that before it is cut off, and most halvings until it falls by that.
const LEAST_DESCENT: f64 = 1e-3;
const MOST_HALVINGS: usize = 30;

/// Most steps of a search along a direction, and slope over the first one at which it ends.
const MOST_SEARCHES: usize = 8;
const SEARCHED_TO: f64 = 0.1;

/// The end of a step.
#[derive(Debug, Clone, Copy)]
struct StepEnd {
    /// Part of the step.
    part: f64,
    /// True if pressures are cut off or limited.
    is_cut: bool,
}

impl CyclePressures {
    /// Moves the pressures under a force in N by a step; returns its iterations.
    pub(super) fn take_step(
        &mut self,
        force_n: f64,
        surfaces: &mut JumpSurfaces<'_>,
        pressure: &mut [f64],
    ) -> usize {
        if self.begin_step(surfaces, pressure) {
            return 1;
        }
        let iterations = self.solve_step(surfaces);
        let end = self.end_of_step(force_n, surfaces, pressure);
        let count = self.cells.count();
        if end.is_cut {
            let steps = self.direction.chunks_exact(count);
            for (step, response) in steps.zip(self.response.chunks_exact_mut(count)) {
                self.compliance.apply(step, response);
            }
        } else {
            let reliefs = self.response.iter_mut().zip(&self.relief);
            for (response, relief) in reliefs {
                *response = end.part * relief;
            }
        }
        let length = self.length(surfaces).clamp(0.0, 1.0);
        let moved = self.direction.iter().zip(&self.response);
        let fields = pressure.iter_mut().zip(&mut self.displacement);
        for ((p, u), ((step, response), cut)) in fields.zip(moved.zip(&mut self.cut)) {
            *cut = if *p > 0.0 && *step >= *p { 1.0 } else { 0.0 };
            *p = (*p - length * step).max(0.0);
            *u -= length * response;
        }
        iterations + 1
    }

    /// Begins a step with the cells that leave, whose load the others take in proportion to theirs; returns `true` if that is the whole step, because the
    /// energy falls all the way.
    fn begin_step(&mut self, surfaces: &mut JumpSurfaces<'_>, pressure: &mut [f64]) -> bool {
        let count = self.cells.count();
        self.step.fill(0.0);
        self.relief.fill(0.0);
        let mut leaves = false;
        let cells = pressure
            .chunks_exact(count)
            .zip(self.free.chunks_exact(count));
        for ((pressure, free), step) in cells.zip(self.step.chunks_exact_mut(count)) {
            let total: f64 = pressure.iter().sum();
            let left = pressure.iter().zip(free);
            let left: f64 = left.map(|(p, free)| p * (1.0 - free)).sum();
            if left > 0.0 {
                leaves = true;
                let part = left / (total - left).max(f64::MIN_POSITIVE);
                for ((p, free), step) in pressure.iter().zip(free).zip(step) {
                    *step = if *free > 0.0 { -part * p } else { *p };
                }
            }
        }
        if leaves {
            self.direction.copy_from_slice(&self.step);
            self.respond(surfaces);
            if self.length(surfaces) >= 1.0 {
                let moved = self.step.iter().zip(&self.response);
                let fields = pressure.iter_mut().zip(&mut self.displacement);
                for ((p, u), (step, response)) in fields.zip(moved) {
                    *p -= step;
                    *u -= response;
                }
                self.cut.fill(0.0);
                return true;
            }
            self.relief.copy_from_slice(&self.response);
            for (residual, opening) in self.residual.iter_mut().zip(&self.opening) {
                *residual -= opening;
            }
        }
        remove_resultants(count, &self.free, &mut self.residual);
        false
    }

    /// Computes the displacement by the direction, and that with its wear.
    fn respond(&mut self, surfaces: &mut JumpSurfaces<'_>) {
        let count = self.cells.count();
        let responses = self.response.chunks_exact_mut(count);
        for (direction, response) in self.direction.chunks_exact(count).zip(responses) {
            self.compliance.apply(direction, response);
        }
        self.opening.copy_from_slice(&self.response);
        for side in Side::BOTH {
            let surface = surfaces.of_mut(side);
            surface.add_worn(&self.positions, &self.direction, &mut self.opening);
        }
    }

    /// Solves for the step by conjugate gradients; returns their iterations.
    fn solve_step(&mut self, surfaces: &mut JumpSurfaces<'_>) -> usize {
        let count = self.cells.count();
        let mut product = self.precondition(surfaces);
        let end = SOLVED_TO.powi(2) * product;
        self.direction.copy_from_slice(&self.steepest);
        for iterations in 1..=MOST_ITERATIONS {
            self.respond(surfaces);
            let length = product / self.dot(&self.direction, &self.opening);
            let moved = self.direction.iter().zip(&self.response);
            let fields = self.step.iter_mut().zip(&mut self.relief);
            for ((step, relief), (direction, response)) in fields.zip(moved) {
                *step += length * direction;
                *relief += length * response;
            }
            for (residual, opening) in self.residual.iter_mut().zip(&self.opening) {
                *residual -= length * opening;
            }
            remove_resultants(count, &self.free, &mut self.residual);
            let next = self.precondition(surfaces);
            if next <= end || next.is_nan() {
                return iterations;
            }
            let beta = next / product;
            product = next;
            for (direction, steepest) in self.direction.iter_mut().zip(&self.steepest) {
                *direction = *steepest + beta * *direction;
            }
        }
        MOST_ITERATIONS
    }

    /// Preconditions the residual; returns the product of both.
    fn precondition(&mut self, surfaces: &mut JumpSurfaces<'_>) -> f64 {
        let count = self.cells.count();
        self.opening.copy_from_slice(&self.residual);
        for side in Side::BOTH {
            let surface = surfaces.of_mut(side);
            surface.scale(&self.positions, &self.free, &mut self.opening);
        }
        self.filter.apply(&self.opening, &mut self.steepest);
        mask(&self.free, &mut self.steepest);
        for side in [Side::Receptacle, Side::Slider] {
            let surface = surfaces.of_mut(side);
            surface.scale(&self.positions, &self.free, &mut self.steepest);
        }
        remove_resultants(count, &self.free, &mut self.steepest);
        self.dot(&self.residual, &self.steepest)
    }

    /// Writes what the step takes off the pressures down to its feasible end into the direction.
    fn end_of_step(
        &mut self,
        force_n: f64,
        surfaces: &mut JumpSurfaces<'_>,
        pressure: &[f64],
    ) -> StepEnd {
        let slope = self.dot(&self.step, &self.gap);
        let mut end = StepEnd {
            part: 1.0,
            is_cut: false,
        };
        for halving in 0..MOST_HALVINGS {
            let places = pressure.iter().zip(&self.step);
            end.is_cut = false;
            for (reached, (p, step)) in self.direction.iter_mut().zip(places) {
                *reached = p - end.part * step;
                if *reached < 0.0 {
                    *reached = 0.0;
                    end.is_cut = true;
                }
            }
            if halving == 0 {
                for side in Side::BOTH {
                    let surface = surfaces.of_mut(side);
                    end.is_cut |= surface.stop_at_layers(&self.positions, &mut self.direction);
                }
            }
            if end.is_cut {
                let reached = self.direction.chunks_exact_mut(self.cells.count());
                for reached in reached {
                    scale(&self.cells, force_n, reached);
                }
            }
            for (reached, p) in self.direction.iter_mut().zip(pressure) {
                *reached = p - *reached;
            }
            let falls = self.dot(&self.direction, &self.gap);
            if !end.is_cut || falls > LEAST_DESCENT * end.part * slope {
                break;
            }
            end.part *= 0.5;
        }
        end
    }

    /// Length of the step to the least energy against the direction: its slope falls with the step, through the layers of both sides.
    fn length(&self, surfaces: &mut JumpSurfaces<'_>) -> f64 {
        let elastic = self.dot(&self.direction, &self.response);
        let slope = self.dot(&self.direction, &self.gap);
        let (mut worn, mut curvature) = (0.0, elastic);
        for side in Side::BOTH {
            let surface = surfaces.of_mut(side);
            let (depths, change) = surface.direct(&self.positions, &self.direction);
            worn += depths;
            curvature += change;
        }
        let mut step = slope / curvature;
        let Sides { slider, receptacle } = surfaces;
        if slider.is_linear() && receptacle.is_linear() {
            return step;
        }
        let after = |step: f64| {
            let depths = slider.slope_after(step) + receptacle.slope_after(step);
            slope - worn + depths - step * elastic
        };
        let (mut low, mut at_low) = (0.0, slope);
        let (mut high, mut at_high) = (f64::INFINITY, 0.0);
        for _ in 0..MOST_SEARCHES {
            let value = after(step);
            if value.abs() <= SEARCHED_TO * slope.abs() {
                break;
            }
            if value > 0.0 {
                (low, at_low) = (step, value);
            } else {
                (high, at_high) = (step, value);
            }
            step = if high.is_finite() {
                low + (high - low) * (at_low / (at_low - at_high)).clamp(0.1, 0.9)
            } else {
                2.0 * step
            };
        }
        step
    }
}
