//! Computed cycles of a point contact: each stands for a jump, whose wear both of its passes do at once.

use serde::{Deserialize, Serialize};

use super::error::PointError;
use super::jump::{JumpControl, fixed, rejected};
use super::record::{DepthMap, PointCycle};
use super::scene::{PointScene, SlipRegime};
use super::section::{half_lengths, section, section_integral};
use super::sliding::Sliding;
use super::state::State;
use super::surface::Surface;
use crate::contact::area::Cells;
use crate::law::surface::SurfaceWear;
use crate::number::real_cycles;
use crate::sides::{Side, Sides};

/// Largest step over indentation of a single cycle whose contact is reported without a step, where only one body wears; otherwise its
/// pressure in the last pass is reported, with the step of the jump. As for line contacts (`Tuning::unskewed_to`).
const UNSKEWED_TO: f64 = 0.1;

/// State of a run between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointState {
    pub(super) sliding: State,
    control: JumpControl,
    /// The contact at the neutral position, and at both turning points of the last cycle.
    pub(super) neutral: Placed,
    pub(super) turning: [Placed; 2],
    pub(super) done: u64,
    pub(super) computed: usize,
    /// Most contact solves of a cycle.
    pub(super) most_increments: usize,
    last: PointCycle,
    /// Sum of the errors of all jumps, each times its cycles.
    error_sum: f64,
    /// Line load in N/mm and force in N along x at the ends of the increments of the last cycle, where a part may stick.
    increments: Vec<(f64, f64)>,
}

/// Worst residuals of a run, relative.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Residuals {
    /// Of the normal force.
    pub(crate) force: f64,
    /// Of the complementarity of gap and pressure.
    pub(crate) contact: f64,
    /// Tangential over mu times the normal force.
    pub(crate) friction_use: f64,
}

/// The contact at a position of the slider.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Placed {
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
    /// Its line load, N/mm, and the tangential force of the whole contact, N.
    pub(super) tangential: (f64, f64),
}

/// Computes the cycles of a point contact.
pub(crate) struct PointIntegrator<'a> {
    scene: &'a PointScene,
    sliding: Sliding<'a>,
}

impl PointState {
    /// Cycles done.
    pub(crate) fn cycle(&self) -> u64 {
        self.done
    }

    /// The last computed cycle.
    pub(crate) fn last(&self) -> &PointCycle {
        &self.last
    }

    /// Worn depths of a side.
    pub(crate) fn depth(&self, side: Side) -> DepthMap {
        let surface = self.sliding.surfaces.of(side);
        let cells = surface.dose.cells(self.sliding.lattice.size_mm);
        DepthMap::new(&cells, surface.depths_mm())
    }

    /// Largest wear of a place of each side per cycle in the last computed one, as equivalent depth, mm.
    pub(crate) fn fastest_rate(&self) -> Sides<f64> {
        Sides::from_fn(|side| self.sliding.surfaces.of(side).fastest_rate())
    }

    /// Worn depths of both sides at each cell of the contact at the neutral position, mm.
    pub(crate) fn depths_in_contact(&self) -> Vec<Sides<f64>> {
        let (cells, lattice) = (self.neutral.cells, &self.sliding.lattice);
        // The window may have been widened since.
        let widened = lattice.window().0 - cells.along_x / 2;
        let first = Sides::from_fn(|side| {
            let row = lattice.first_row(side, lattice.amplitude) + widened;
            (row, lattice.half(side).1 - cells.along_z / 2)
        });
        let loaded = self.neutral.pressure_mpa.iter().enumerate();
        let loaded = loaded.filter(|(_, pressure)| **pressure > 0.0);
        let depths = loaded.map(|(index, _)| {
            let (row, column) = (index / cells.along_z, index % cells.along_z);
            Sides::from_fn(|side| {
                let surface = self.sliding.surfaces.of(side);
                let (first_row, first_column) = *first.of(side);
                let dose = surface.dose.rows(first_row + row, 1)[first_column + column];
                surface.depth_mm(dose)
            })
        });
        depths.collect()
    }

    /// Cells of the window, their length in mm, and the contact solves and iterations so far.
    pub(crate) fn size(&self) -> (usize, f64, (usize, usize)) {
        let cells = self.sliding.lattice.cells();
        (cells.count(), cells.dx_mm, self.sliding.work)
    }

    /// Computed cycles, and the most contact solves of one.
    pub(crate) fn computed(&self) -> (usize, usize) {
        (self.computed, self.most_increments)
    }

    /// The contact at the neutral position.
    pub(crate) fn neutral(&self) -> &Placed {
        &self.neutral
    }

    /// The contact at the ends of both passes of the last cycle.
    pub(crate) fn turning(&self) -> &[Placed; 2] {
        &self.turning
    }

    /// The friction loop of the last cycle from the neutral position on: displacements in mm with line loads of the middle section in
    /// N/mm and forces in N. Of gross slip a rectangle.
    pub(crate) fn friction_loop(&self, scene: &PointScene) -> Vec<(f64, (f64, f64))> {
        let a = -scene.amplitude_mm;
        if let [back, end, forth, start] = self.increments[..] {
            return vec![
                (0.0, forth),
                (a, start),
                (0.0, back),
                (-a, end),
                (0.0, forth),
            ];
        }
        let forth = self.neutral.tangential;
        let reversed = |(line, whole): (f64, f64)| (-line, -whole);
        let [end, start] = self.turning.each_ref().map(|at| at.tangential);
        vec![
            (0.0, forth),
            (a, start),
            (a, reversed(start)),
            (-a, end),
            (-a, reversed(end)),
            (0.0, forth),
        ]
    }

    /// Worst residuals so far.
    pub(crate) fn residuals(&self, scene: &PointScene) -> Residuals {
        let (force, contact) = self.sliding.worst_residuals;
        let forces = self.friction_loop(scene).into_iter();
        let most = forces.fold(0.0, |most: f64, (_, (_, whole))| most.max(whole.abs()));
        let limit = scene.friction * self.neutral.force_n;
        Residuals {
            force,
            contact,
            friction_use: if limit > 0.0 { most / limit } else { 0.0 },
        }
    }

    /// Mean error of the jumps, weighted with their cycles.
    pub(crate) fn mean_jump_error(&self) -> f64 {
        self.error_sum / real_cycles(self.done.max(1))
    }

    /// Gives a state of a checkpoint the laws of its scene.
    pub(crate) fn resume(&mut self, scene: &PointScene) {
        for side in Side::BOTH {
            let wear = scene.bodies.of(side).wear;
            self.sliding.surfaces.of_mut(side).resume(wear);
        }
    }
}

impl<'a> PointIntegrator<'a> {
    /// The loaded contact before any wear.
    ///
    /// # Errors
    /// A scene that is no point contact, a contact without a solution.
    pub(crate) fn start(scene: &'a PointScene) -> Result<(Self, PointState), PointError> {
        scene.check()?;
        let mut state = State::unworn(scene);
        let mut sliding = Sliding::new(scene, &state);
        sliding.load(&mut state)?;
        if scene.slip == SlipRegime::Partial {
            // To the turning point where the first pass begins, without wear.
            sliding.slip_partly(&mut state, -scene.amplitude_mm, 0.0)?;
        }
        // Without wear there is no skew.
        let at_neutral = sliding.unskewed(&state, (1.0, scene.force_n))?;
        let neutral = Placed::of(scene, &at_neutral, 0.0);
        let mut state = PointState {
            control: JumpControl::default(),
            turning: [neutral.clone(), neutral.clone()],
            neutral,
            done: 0,
            computed: 0,
            most_increments: 0,
            last: PointCycle::default(),
            error_sum: 0.0,
            increments: Vec::new(),
            sliding: state,
        };
        let integrator = Self { scene, sliding };
        state.last = integrator.report(&state, (0, 0.0), state.sliding.work);
        Ok((integrator, state))
    }

    /// For a state of a checkpoint.
    pub(crate) fn resume(scene: &'a PointScene, state: &PointState) -> Self {
        Self {
            sliding: Sliding::new(scene, &state.sliding),
            scene,
        }
    }

    /// Computes the next cycle up to a number of them, with shorter jumps until its error is accepted.
    ///
    /// # Errors
    /// A contact without a solution.
    pub(crate) fn compute_cycle(
        &mut self,
        state: &mut PointState,
        until: u64,
    ) -> Result<PointCycle, PointError> {
        let accuracy = self.scene.accuracy;
        self.sliding.coarsen(&mut state.sliding);
        let work = state.sliding.work;
        let allowed = accuracy.tolerance / accuracy.cycles_refinement;
        loop {
            let remaining = until.max(state.done + 1) - state.done;
            let jump = match accuracy.cycle_jump {
                Some(jump) => fixed(jump, remaining),
                None => state.control.next(
                    (accuracy.tolerance, accuracy.cycles_refinement),
                    (state.done, remaining),
                    self.step(state),
                ),
            };
            let before = state.sliding.clone();
            let error = self
                .pass_both(state, real_cycles(jump))
                .map_err(|error| error.at(state.done))?;
            let shorter = rejected(allowed, state.done, jump, error);
            if let Some(shorter) = shorter.filter(|_| accuracy.cycle_jump.is_none()) {
                let work = state.sliding.work;
                state.sliding = State { work, ..before };
                state.control.limit(shorter);
            } else {
                state.control.update(jump, error);
                state.done += jump;
                state.error_sum += real_cycles(jump) * error;
                state.computed += 1;
                state.last = self.report(state, (jump, error), work);
                state.most_increments = state.most_increments.max(state.last.increments);
                return Ok(state.last);
            }
        }
    }

    /// Both passes of a computed cycle of a jump; returns the estimated error of its wear.
    fn pass_both(&mut self, state: &mut PointState, jump: f64) -> Result<f64, PointError> {
        let (scene, sliding) = (self.scene, &mut self.sliding);
        // The last pass goes from -A to A or back as the amplitude says; so does the one through the neutral position.
        let last = -scene.amplitude_mm.signum();
        let PointState {
            sliding: present,
            neutral,
            turning,
            increments,
            ..
        } = state;
        let n = present.lattice.amplitude;
        for side in Side::BOTH {
            present.surfaces.of_mut(side).begin_cycle();
        }
        increments.clear();
        if scene.slip == SlipRegime::Partial {
            // Under the same pressure one increment a pass would do: slip grows with the displacement without turning.
            for (direction, end) in [1.0, -1.0].into_iter().zip(turning.iter_mut()) {
                for at in [&mut *neutral, end] {
                    sliding.slip_partly(present, direction * scene.amplitude_mm, jump)?;
                    *at = Placed::of(scene, present, direction);
                    increments.push(at.tangential);
                }
            }
        } else if n == 0 {
            sliding.wear_in_place(present, jump)?;
            *neutral = Placed::of(scene, present, last);
            *turning = [-last, last].map(|direction| Placed::of(scene, present, direction));
        } else {
            let (start, end) = match present.position {
                0 => (0, 2 * n),
                other => (other, 0),
            };
            sliding.half_pass(present, n, jump)?;
            sliding.half_pass(present, end, jump)?;
            turning[0] = Placed::of(scene, present, -last);
            for side in Side::BOTH {
                present.surfaces.of_mut(side).turn();
            }
            sliding.half_pass(present, n, jump)?;
            *neutral = Placed::of(scene, present, last);
            sliding.half_pass(present, start, jump)?;
            turning[1] = Placed::of(scene, present, last);
            if self.wears_once() && self.step(state) < UNSKEWED_TO {
                let at = (jump, state.neutral.force_n);
                let unskewed = self.sliding.unskewed(&state.sliding, at)?;
                state.neutral = Placed::of(self.scene, &unskewed, last);
            }
        }
        let (mut change, mut total) = (0.0, 0.0);
        for side in Side::BOTH {
            let sums = state.sliding.surfaces.of_mut(side).end_cycle(jump);
            change += sums.0;
            total += sums.1;
        }
        Ok(if total > 0.0 {
            0.5 * change / total
        } else {
            0.0
        })
    }

    /// Leading-edge step over the indentation that a cycle leaves.
    fn step(&self, state: &PointState) -> f64 {
        if state.sliding.lattice.amplitude == 0 {
            return 0.0;
        }
        let surfaces = state.sliding.surfaces.as_ref();
        let rates = surfaces.map(Surface::largest_rate);
        self.scene
            .step_over_indentation(rates, state.neutral.half_lengths_mm.0)
    }

    /// Whether only one body wears: where both do, their surfaces without the compliance of the wear differ by what increments leave, and
    /// the pressure of the pass is the better one.
    fn wears_once(&self) -> bool {
        let wear = self.scene.bodies.as_ref().map(|body| body.wear.is_some());
        wear.slider != wear.receptacle
    }

    fn report(
        &self,
        state: &PointState,
        (jump, jump_error): (u64, f64),
        work: (usize, usize),
    ) -> PointCycle {
        let (sliding, neutral) = (&state.sliding, &state.neutral);
        let area = sliding.lattice.cells().area_mm2();
        let depths = Sides::from_fn(|side| sliding.surfaces.of(side).depths_mm());
        let ideal = |work: f64| {
            self.scene.bodies.as_ref().map(|body| {
                let rate = body.wear.map_or(Some(0.0), SurfaceWear::uniform);
                rate.map(|rate| rate * work)
            })
        };
        PointCycle {
            cycle: state.done,
            jump,
            max_depth_mm: depths.largest_of_each(),
            worn_volume_mm3: depths.map(|depths| area * depths.iter().sum::<f64>()),
            ideal_volume_mm3: ideal(sliding.sliding_work),
            ideal_area_mm2: ideal(sliding.section_work),
            force_n: neutral.force_n,
            line_load_n_per_mm: neutral.line_load_n_per_mm,
            peak_pressure_mpa: neutral.peak_pressure_mpa,
            half_length_along_mm: neutral.half_lengths_mm.0,
            half_length_across_mm: neutral.half_lengths_mm.1,
            dissipated_energy_mj: self.scene.friction * sliding.sliding_work,
            dissipated_energy_mj_per_mm: self.scene.friction * sliding.section_work,
            jump_error,
            increments: sliding.work.0 - work.0,
            iterations: sliding.work.1 - work.1,
        }
    }
}

impl Placed {
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

    /// The contact in a state of a scene, slipping into a direction.
    fn of(scene: &PointScene, state: &State, direction: f64) -> Self {
        let (window, pressure) = (state.lattice.cells(), &state.pressure);
        let shear = match scene.slip {
            SlipRegime::Gross => {
                let shear = pressure.values.iter();
                shear.map(|p| direction * scene.friction * p).collect()
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
            tangential: (section_integral(&window, &shear), window.integral(&shear)),
        }
    }
}
