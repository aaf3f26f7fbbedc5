//! Computed cycles of a point contact: each stands for a jump, whose wear both of its passes do at once.

mod implicit;

use super::contact_at_position::ContactAtPosition;
use super::error::PointError;
use super::jump::{JumpControl, jump_error, rejected, share_in_wear};
use super::lattice::Lattice;
use super::legs::legs;
use super::motions::PointMotions;
use super::point_state::PointState;
use super::record::PointCycle;
use super::sliding::Sliding;
use super::state::{State, start};
use super::surface::{Surface, WearSums};
use super::window;
use crate::closed_form::{CyclePath, PointScene, SlipRegime};
use crate::law::surface::SurfaceWear;
use crate::number::real_cycles;
use crate::schedule::attempts::{Attempts, Remedy, longest_accepted_jump};
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};
use implicit::CyclePressures;

/// Largest step over indentation of a single cycle whose contact is reported without a step, where only one body wears; otherwise its
/// pressure in the last pass is reported, with the step of the jump. As for line contacts (`Tuning::unskewed_to`).
const UNSKEWED_TO: f64 = 0.1;

/// Computes the cycles of a point contact.
pub(crate) struct PointIntegrator {
    /// The contact in its present motion.
    pub(super) scene: PointScene,
    /// Slip where the amplitude is small against the contact.
    pub(super) slip: SlipRegime,
    pub(super) sliding: Sliding,
    /// Grids of the unworn contact.
    pub(super) unworn: Lattice,
    /// True for a mission.
    pub(super) is_mission: bool,
    /// Contacts of implicit jumps.
    pub(super) pressures: Option<CyclePressures>,
}

impl PointIntegrator {
    /// The unworn contact without load in the first of its motions.
    ///
    /// # Errors
    /// A scene that is no point contact.
    pub(crate) fn unloaded(motions: &PointMotions) -> Result<Self, PointError> {
        motions.check()?;
        let unworn = motions.lattice();
        let scene = *motions.first();
        Ok(Self {
            sliding: Sliding::new(&scene, &State::unworn(&scene, unworn)),
            slip: motions.slip,
            scene,
            unworn,
            is_mission: motions.is_mission,
            pressures: None,
        })
    }

    /// Applies the load to the unworn contact.
    ///
    /// # Errors
    /// A contact without a solution.
    pub(crate) fn load(&mut self) -> Result<PointState, PointError> {
        let (scene, sliding) = (&self.scene, &mut self.sliding);
        let mut state = State::unworn(scene, self.unworn);
        sliding.load(&mut state)?;
        if scene.slip == SlipRegime::Partial {
            // To the turning point where the first pass begins, without wear.
            sliding.slip_partly(&mut state, -scene.amplitude_mm, 0.0)?;
        }
        // Without wear there is no skew.
        let at_neutral = sliding.unskewed(&state, 1.0, scene.force_n)?;
        let neutral = ContactAtPosition::of(scene, &at_neutral, 0.0);
        let mut state = PointState {
            control: JumpControl::default(),
            turning: [neutral.clone(), neutral.clone()],
            neutral,
            done: 0,
            sliding_distance_mm: 0.0,
            computed: 0,
            most_increments: 0,
            last: PointCycle::default(),
            error_sum: 0.0,
            increments: Vec::new(),
            sliding: state,
        };
        state.last = self.report(&state, 0, 0.0, state.sliding.work);
        Ok(state)
    }

    /// For a state of a checkpoint.
    pub(crate) fn resume(motions: &PointMotions, state: &PointState) -> Self {
        let scene = *motions.first();
        Self {
            sliding: Sliding::new(&scene, &state.sliding),
            slip: motions.slip,
            scene,
            unworn: motions.lattice(),
            is_mission: motions.is_mission,
            pressures: None,
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
        // A rest wears nothing, also by the round-off of merged cells.
        if self.scene.path_mm() != 0.0 {
            let cells = self.scene.accuracy.cells_per_half_length;
            window::coarsen(&mut state.sliding, cells);
            state.sliding.position = start(&self.scene, &state.sliding.lattice);
        }
        let remaining = until.max(state.done + 1) - state.done;
        if let Some(cycle) = self.implicit_jump(state, remaining)? {
            return Ok(cycle);
        }
        let work = state.sliding.work;
        state.sliding.passing.clear();
        let mut attempts = PointAttempts {
            integrator: self,
            state,
            remaining,
        };
        let first = attempts.next_jump();
        let (jump, error) = longest_accepted_jump(&mut attempts, first)?;
        state.control.update(jump, error);
        Ok(self.end_cycle(state, jump, error, work))
    }

    /// Ends the computed cycle or the implicit jump of a number of cycles and an error, after earlier work.
    pub(super) fn end_cycle(
        &self,
        state: &mut PointState,
        jump: u64,
        error: f64,
        work: (usize, usize),
    ) -> PointCycle {
        state.done += jump;
        state.sliding_distance_mm += self.scene.path_mm() * real_cycles(jump);
        state.error_sum += real_cycles(jump) * error;
        state.computed += 1;
        state.last = self.report(state, jump, error, work);
        state.most_increments = state.most_increments.max(state.last.increments);
        state.last
    }

    /// The passes of a computed cycle of a jump; returns the estimated error of its wear.
    fn pass_all(&mut self, state: &mut PointState, jump: f64) -> Result<f64, PointError> {
        let (scene, sliding) = (&self.scene, &mut self.sliding);
        for side in Side::BOTH {
            state.sliding.surfaces.of_mut(side).begin_cycle();
        }
        let legs = legs(scene);
        match scene.slip {
            SlipRegime::Partial => {
                state.increments.clear();
                // Under the same pressure one increment a pass would do: slip grows with the displacement without turning.
                for leg in &legs {
                    sliding.slip_partly(&mut state.sliding, leg.to - leg.from, jump)?;
                    let at = ContactAtPosition::of(scene, &state.sliding, leg.direction());
                    state.increments.push(at.tangential);
                    state.take_contact(leg.at, at);
                }
            }
            SlipRegime::Gross if state.sliding.lattice.is_in_place(scene.amplitude_mm) => {
                sliding.wear_in_place(&mut state.sliding, jump)?;
                // The last pass goes from -A to A or back as the amplitude says; so does the one through the neutral position.
                let last = -scene.amplitude_mm.signum();
                let contact = |direction| ContactAtPosition::of(scene, &state.sliding, direction);
                let (neutral, turning) = (contact(last), [-last, last].map(contact));
                (state.neutral, state.turning) = (neutral, turning);
            }
            SlipRegime::Gross => {
                for leg in &legs {
                    let to = state.sliding.lattice.position(leg.to);
                    sliding.pass(&mut state.sliding, to, leg.length(), jump)?;
                    if leg.at.is_some() {
                        let at = ContactAtPosition::of(scene, &state.sliding, leg.direction());
                        state.take_contact(leg.at, at);
                    }
                    if leg.at == Some(Position::Leftmost) {
                        for side in Side::BOTH {
                            state.sliding.surfaces.of_mut(side).turn();
                        }
                    }
                }
                self.remove_skew(state, jump)?;
            }
        }
        let mut sums = WearSums::default();
        for side in Side::BOTH {
            let of_side = state.sliding.surfaces.of_mut(side).end_cycle(jump);
            sums.change += of_side.change;
            sums.total += of_side.total;
            sums.earlier += of_side.earlier;
        }
        Ok(match self.scene.slip {
            SlipRegime::Gross => jump_error(sums),
            SlipRegime::Partial => jump_error(sums) * share_in_wear(sums, state.done),
        })
    }

    /// Replaces the contact at the neutral position by one without the skew of a jump, where one body wears in two equal passes.
    fn remove_skew(&mut self, state: &mut PointState, jump: f64) -> Result<(), PointError> {
        let is_even = self.scene.path == CyclePath::ToAndFro;
        if is_even && self.wears_once() && self.step(state) < UNSKEWED_TO {
            let force_n = state.neutral.force_n;
            let unskewed = self.sliding.unskewed(&state.sliding, jump, force_n)?;
            let last = -self.scene.amplitude_mm.signum();
            state.neutral = ContactAtPosition::of(&self.scene, &unskewed, last);
        }
        Ok(())
    }

    /// Leading-edge step over the indentation that a cycle leaves.
    pub(super) fn step(&self, state: &PointState) -> f64 {
        let lattice = &state.sliding.lattice;
        if lattice.is_in_place(self.scene.amplitude_mm) {
            return 0.0;
        }
        let surfaces = state.sliding.surfaces.as_ref();
        let rates = surfaces.map(Surface::largest_rate);
        self.scene
            .step_over_indentation(rates, state.neutral.half_lengths_mm.0)
    }

    /// Returns `true` if only one body wears: where both do, their surfaces without the compliance of the wear differ by what increments leave, and
    /// the pressure of the pass is the better one.
    fn wears_once(&self) -> bool {
        let wear = self.scene.bodies.as_ref().map(|body| body.wear.is_some());
        wear.slider != wear.receptacle
    }

    /// The scene that the contact is computed from.
    pub(crate) fn scene(&self) -> &PointScene {
        &self.scene
    }

    fn report(
        &self,
        state: &PointState,
        jump: u64,
        jump_error: f64,
        work: (usize, usize),
    ) -> PointCycle {
        let (sliding, neutral) = (&state.sliding, &state.neutral);
        let area = sliding.lattice.cells().area_mm2();
        let depths = Sides::from_fn(|side| sliding.surfaces.of(side).depths_mm());
        let wear = self.scene.bodies.as_ref().map(|body| body.wear);
        let ideal = |work| wear.map(|wear| SurfaceWear::volume_by_work(wear, work));
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

/// Attempts to compute the next cycle of a state.
struct PointAttempts<'a> {
    integrator: &'a mut PointIntegrator,
    state: &'a mut PointState,
    /// Cycles that remain.
    remaining: u64,
}

impl PointAttempts<'_> {
    fn next_jump(&self) -> u64 {
        let (state, accuracy) = (&self.state, &self.integrator.scene.accuracy);
        let step = self.integrator.step(state);
        state
            .control
            .next(accuracy, state.done, self.remaining, step)
    }
}

impl Attempts for PointAttempts<'_> {
    type Saved = State;
    /// The estimated error.
    type Record = f64;
    type Error = PointError;

    fn attempt(&mut self, jump: u64) -> Result<f64, PointError> {
        let done = self.state.done;
        self.integrator
            .pass_all(self.state, real_cycles(jump))
            .map_err(|error| error.at(done))
    }

    fn rejected(&mut self, _: &State, error: &f64, jump: u64) -> Option<u64> {
        let accuracy = &self.integrator.scene.accuracy;
        rejected(accuracy, self.state.done, jump, *error)
    }

    fn save(&self) -> State {
        self.state.sliding.clone()
    }

    fn go_back(&mut self, before: &State) {
        self.state.sliding.go_back(before);
    }

    /// The window has been widened as far as it can be.
    fn remedy(&mut self, _: &PointError) -> Result<Remedy, PointError> {
        Ok(Remedy::Nothing)
    }

    /// In equal shares of what remains.
    fn limit(&mut self, most: u64) -> u64 {
        self.state.control.limit(most);
        self.next_jump()
    }
}
