//! The cycles of a point contact: each computed one stands for a jump, whose wear both of its passes do at once.

use std::ops::ControlFlow;

use super::error::PointError;
use super::field::Field;
use super::jump::{JumpControl, fixed, rejected};
use super::lattice::Lattice;
use super::record::{DepthMap, PointCycle, PointOutcome, PointSummary, half_lengths};
use super::scene::{PointScene, SlipRegime};
use super::sliding::Sliding;
use crate::contact::area::Cells;
use crate::law::surface::SurfaceWear;
use crate::number::real_cycles;
use crate::sides::{Side, Sides};

/// Largest step over indentation of a single cycle whose contact is reported without a step, where only one body wears; otherwise its
/// pressure in the last pass is reported, with the step of the jump. As for line contacts (`Tuning::unskewed_to`).
const UNSKEWED_TO: f64 = 0.1;

/// Increments of each pass where a part of the contact may stick: under the same pressure the first one would do, since slip grows
/// with the displacement without turning.
const PARTIAL_INCREMENTS: u32 = 2;

/// The contact at the neutral position.
struct Neutral {
    peak_pressure_mpa: f64,
    half_lengths_mm: (f64, f64),
    pressure_mpa: Vec<f64>,
    window: Cells,
}

/// A run between two computed cycles.
struct Run<'a> {
    scene: &'a PointScene,
    sliding: Sliding<'a>,
    control: JumpControl,
    neutral: Neutral,
    done: u64,
    computed: usize,
}

/// Simulates a point contact. Its cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that is no point contact, a contact without a solution.
pub fn run(
    scene: &PointScene,
    mut on_cycle: impl FnMut(&PointCycle) -> ControlFlow<()>,
) -> Result<PointSummary, PointError> {
    scene.check()?;
    let mut run = Run::start(scene)?;
    let initial = run.report(0, 0.0, (0, 0));
    let mut last = initial;
    let mut outcome = PointOutcome::Completed;
    while run.done < scene.cycles {
        last = run.compute_cycle()?;
        if on_cycle(&last).is_break() {
            outcome = PointOutcome::Stopped;
            break;
        }
        if scene
            .stop_depth_mm
            .is_some_and(|stop| deepest(&last) >= stop)
        {
            outcome = PointOutcome::StopDepth;
            break;
        }
        run.sliding.coarsen();
    }
    Ok(run.finish(outcome, initial, last))
}

fn deepest(cycle: &PointCycle) -> f64 {
    cycle.max_depth_mm.slider.max(cycle.max_depth_mm.receptacle)
}

impl<'a> Run<'a> {
    fn start(scene: &'a PointScene) -> Result<Self, PointError> {
        let mut sliding = Sliding::new(scene)?;
        if scene.slip == SlipRegime::Partial {
            // To the turning point where the first pass begins, without wear.
            sliding.slip_partly(-scene.amplitude_mm, 0.0)?;
        }
        Ok(Self {
            scene,
            neutral: Neutral::of(&sliding.state.pressure, &sliding.state.lattice),
            sliding,
            control: JumpControl::default(),
            done: 0,
            computed: 0,
        })
    }

    /// Computes the next cycle, with shorter jumps until its error is accepted.
    fn compute_cycle(&mut self) -> Result<PointCycle, PointError> {
        let tolerance = self.scene.accuracy.tolerance;
        let work = self.sliding.work;
        loop {
            let remaining = self.scene.cycles - self.done;
            let jump = match self.scene.accuracy.cycle_jump {
                Some(jump) => fixed(jump, remaining),
                None => self
                    .control
                    .next(tolerance, (self.done, remaining), self.step()),
            };
            let before = self.sliding.state.clone();
            let error = self
                .pass_both(real_cycles(jump))
                .map_err(|error| error.at(self.done))?;
            let shorter = rejected(tolerance, self.done, jump, error);
            let is_chosen = self.scene.accuracy.cycle_jump.is_none();
            if let Some(shorter) = shorter.filter(|_| is_chosen) {
                self.sliding.restore(before);
                self.control.limit(shorter);
            } else {
                self.control.update(jump, error);
                self.done += jump;
                self.computed += 1;
                return Ok(self.report(jump, error, work));
            }
        }
    }

    /// Both passes of a computed cycle of a jump; returns the estimated error of its wear.
    fn pass_both(&mut self, jump: f64) -> Result<f64, PointError> {
        let n = self.sliding.state.lattice.amplitude;
        for side in Side::BOTH {
            self.sliding.state.surfaces.of_mut(side).begin_cycle();
        }
        if self.scene.slip == SlipRegime::Partial {
            self.slip_both_ways(jump)?;
            self.neutral = self.present();
        } else if n == 0 {
            self.sliding.wear_in_place(jump)?;
            self.neutral = self.present();
        } else {
            let (start, end) = match self.sliding.state.position {
                0 => (0, 2 * n),
                other => (other, 0),
            };
            self.sliding.half_pass(n, jump)?;
            self.sliding.half_pass(end, jump)?;
            for side in Side::BOTH {
                self.sliding.state.surfaces.of_mut(side).turn();
            }
            self.sliding.half_pass(n, jump)?;
            self.neutral = self.present();
            self.sliding.half_pass(start, jump)?;
            if self.wears_once() && self.step() < UNSKEWED_TO {
                let (pressure, lattice) = self.sliding.unskewed(jump)?;
                self.neutral = Neutral::of(&pressure, &lattice);
            }
        }
        let (mut change, mut total) = (0.0, 0.0);
        for side in Side::BOTH {
            let sums = self.sliding.state.surfaces.of_mut(side).end_cycle(jump);
            change += sums.0;
            total += sums.1;
        }
        Ok(if total > 0.0 {
            0.5 * change / total
        } else {
            0.0
        })
    }

    /// A cycle from turning point to turning point where a part of the contact may stick.
    fn slip_both_ways(&mut self, jump: f64) -> Result<(), PointError> {
        let amplitude = self.scene.amplitude_mm;
        for direction in [1.0, -1.0] {
            for _ in 0..PARTIAL_INCREMENTS {
                let part = 2.0 * amplitude / f64::from(PARTIAL_INCREMENTS);
                self.sliding.slip_partly(direction * part, jump)?;
            }
        }
        Ok(())
    }

    /// Leading-edge step over the indentation that a cycle leaves.
    fn step(&self) -> f64 {
        if self.sliding.state.lattice.amplitude == 0 {
            return 0.0;
        }
        let half_length = self.neutral.half_lengths_mm.0;
        let stroke = 2.0 * self.scene.amplitude_mm.abs();
        let travel = self.scene.travel_over_receptacle();
        let parts = [(Side::Slider, 1.0 - travel), (Side::Receptacle, travel)];
        let steps = parts.map(|(side, part)| {
            let length = (part * stroke).min(2.0 * half_length);
            self.sliding.state.surfaces.of(side).largest_rate() * length
        });
        (steps[0] + steps[1]) * self.scene.modulus() / half_length
    }

    /// Whether only one body wears: where both do, their surfaces without the compliance of the wear differ by what increments leave, and
    /// the pressure of the pass is the better one.
    fn wears_once(&self) -> bool {
        let wear = self.scene.bodies.as_ref().map(|body| body.wear.is_some());
        wear.slider != wear.receptacle
    }

    /// The contact at the present position.
    fn present(&self) -> Neutral {
        let state = &self.sliding.state;
        Neutral::of(&state.pressure, &state.lattice)
    }

    fn report(&self, jump: u64, jump_error: f64, work: (usize, usize)) -> PointCycle {
        let state = &self.sliding.state;
        let area = state.lattice.cells().area_mm2();
        let sliding_work = state.sliding_work;
        let depths = Sides::from_fn(|side| state.surfaces.of(side).depths_mm());
        PointCycle {
            cycle: self.done,
            jump,
            max_depth_mm: depths.largest_of_each(),
            worn_volume_mm3: depths.map(|depths| area * depths.iter().sum::<f64>()),
            ideal_volume_mm3: self.scene.bodies.as_ref().map(|body| {
                let rate = body.wear.map_or(Some(0.0), SurfaceWear::uniform);
                rate.map(|rate| rate * sliding_work)
            }),
            peak_pressure_mpa: self.neutral.peak_pressure_mpa,
            half_length_along_mm: self.neutral.half_lengths_mm.0,
            half_length_across_mm: self.neutral.half_lengths_mm.1,
            dissipated_energy_mj: self.scene.friction * sliding_work,
            jump_error,
            increments: self.sliding.work.0 - work.0,
            iterations: self.sliding.work.1 - work.1,
        }
    }

    fn finish(self, outcome: PointOutcome, initial: PointCycle, last: PointCycle) -> PointSummary {
        let state = &self.sliding.state;
        PointSummary {
            outcome,
            initial,
            last,
            computed_cycles: self.computed,
            solves: self.sliding.work,
            depth: Sides::from_fn(|side| {
                let surface = state.surfaces.of(side);
                let cells = surface.dose.cells(state.lattice.size_mm);
                DepthMap::new(&cells, surface.depths_mm())
            }),
            pressure_mpa: self.neutral.pressure_mpa,
            window: self.neutral.window,
        }
    }
}

impl Neutral {
    fn of(pressure: &Field, lattice: &Lattice) -> Self {
        let window = lattice.cells();
        let (along, across) = half_lengths(pressure);
        Self {
            peak_pressure_mpa: pressure.values.iter().fold(0.0, |most, p| p.max(most)),
            half_lengths_mm: (along * window.dx_mm, across * window.dz_mm),
            pressure_mpa: pressure.values.clone(),
            window,
        }
    }
}

#[cfg(test)]
mod tests;
