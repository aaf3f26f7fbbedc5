//! Computed cycles of a point contact: each stands for a jump, whose wear both of its passes do at once.

mod computed_cycle;
mod implicit;

use super::error::PointError;
use super::friction::change_in_cycle;
use super::jump::{JumpBounds, JumpControl, jump_error, share_in_wear};
use super::lattice::Lattice;
use super::legs::legs;
use super::motions::PointMotions;
use super::point_state::PointState;
use super::record::PointCycle;
use super::sliding::Sliding;
use super::state::State;
use super::surface::{Surface, WearSums};
use crate::closed_form::{CyclePath, PointScene, SlipRegime};
use crate::law::friction::contact::ContactFriction;
use crate::law::surface::SurfaceWear;
use crate::number::real_cycles;
use crate::schedule::plan::Cycles;
use crate::schedule::step::Position;
use crate::schedule::stroke::even_friction;
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
            sliding: Sliding::new(
                &scene,
                motions.friction.clone(),
                &State::unworn(&scene, unworn),
            ),
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
        sliding.begin(&mut state, Cycles { done: 0, jump: 0 });
        sliding.load(&mut state)?;
        if scene.slip == SlipRegime::Partial {
            // To the turning point where the first pass begins, without wear.
            sliding.slip_partly(&mut state, -scene.amplitude_mm, 0.0)?;
        }
        // Without wear there is no skew.
        let at_neutral = sliding.unskewed(&state, 1.0, scene.force_n)?;
        let neutral = sliding.contact(&at_neutral, 0.0);
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
            sliding: Sliding::new(&scene, motions.friction.clone(), &state.sliding),
            slip: motions.slip,
            scene,
            unworn: motions.lattice(),
            is_mission: motions.is_mission,
            pressures: None,
        }
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
    fn pass_all(&mut self, state: &mut PointState, jump: u64) -> Result<f64, PointError> {
        let (scene, sliding) = (&self.scene, &mut self.sliding);
        let done = state.done;
        sliding.begin(&mut state.sliding, Cycles { done, jump });
        let jump = real_cycles(jump);
        let legs = legs(scene);
        match scene.slip {
            SlipRegime::Partial => {
                state.increments.clear();
                // Under the same pressure one increment a pass would do: slip grows with the displacement without turning.
                for leg in &legs {
                    sliding.slip_partly(&mut state.sliding, leg.to - leg.from, jump)?;
                    let at = sliding.contact(&state.sliding, leg.direction());
                    state.increments.push(at.tangential);
                    state.take_contact(leg.at, at);
                }
            }
            SlipRegime::Gross if state.sliding.lattice.is_in_place(scene.amplitude_mm) => {
                sliding.wear_in_place(&mut state.sliding, jump)?;
                // The last pass goes from -A to A or back as the amplitude says; so does the one through the neutral position.
                let last = -scene.amplitude_mm.signum();
                let contact = |direction| sliding.contact(&state.sliding, direction);
                let (neutral, turning) = (contact(last), [-last, last].map(contact));
                (state.neutral, state.turning) = (neutral, turning);
            }
            SlipRegime::Gross => {
                for leg in &legs {
                    let to = state.sliding.lattice.position(leg.to);
                    sliding.pass(&mut state.sliding, to, leg.length(), jump)?;
                    if leg.at.is_some() {
                        let at = sliding.contact(&state.sliding, leg.direction());
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
        let of_wear = match self.scene.slip {
            SlipRegime::Gross => jump_error(sums),
            SlipRegime::Partial => jump_error(sums) * share_in_wear(sums, done),
        };
        Ok(of_wear + change_in_cycle(self.sliding.friction(), &state.sliding))
    }

    /// Replaces the contact at the neutral position by one without the skew of a jump, where one body wears in two equal passes.
    fn remove_skew(&mut self, state: &mut PointState, jump: f64) -> Result<(), PointError> {
        let is_even = self.scene.path == CyclePath::ToAndFro;
        if is_even && self.wears_once() && self.step(state) < UNSKEWED_TO {
            let force_n = state.neutral.force_n;
            let unskewed = self.sliding.unskewed(&state.sliding, jump, force_n)?;
            let last = -self.scene.amplitude_mm.signum();
            state.neutral = self.sliding.contact(&unskewed, last);
        }
        Ok(())
    }

    /// Bounds of the next jump besides its error.
    pub(super) fn jump_bounds(&self, state: &PointState) -> JumpBounds {
        let by_cycle = self.sliding.friction().by_cycle();
        JumpBounds {
            step: self.step(state),
            even_friction: even_friction(by_cycle, self.scene.accuracy.tolerance, state.done),
        }
    }

    /// Leading-edge step over the indentation that a cycle leaves.
    fn step(&self, state: &PointState) -> f64 {
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

    /// Friction of the contact.
    pub(crate) fn friction(&self) -> &ContactFriction {
        self.sliding.friction()
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
            dissipated_energy_mj: sliding.energy.whole.sum(),
            dissipated_energy_mj_per_mm: sliding.energy.section.sum(),
            friction_coefficient: neutral.friction,
            jump_error,
            increments: sliding.work.0 - work.0,
            iterations: sliding.work.1 - work.1,
        }
    }
}
