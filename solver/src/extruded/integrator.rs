//! Computed cycles of extruded bodies: each stands for a jump.

mod plan;
mod report;

use super::bodies::Bodies;
use super::cycle::Contact;
use super::error::ExtrudedError;
use super::scene::ExtrudedScene;
use super::state::{CommonPlaneState, ExtrudedState, Planes};
use crate::along_line::{LineRecord, Sections, SectionsError, slide};
use crate::contact::ContactError;
use crate::cycle::retry::FailedIncrement;
use crate::effects::EffectsPlan;
use crate::model;
use crate::number::real_cycles;
use crate::scene::Scene;
use crate::schedule::attempts::{Attempts, Remedy, in_wide_zones, longest_accepted_jump};
use crate::schedule::increments;
use crate::schedule::plan::Cycles;
use crate::schedule::replay::ReplayPlan;
use crate::schedule::step::Position;

/// Computes the cycles of extruded bodies.
pub(crate) struct ExtrudedIntegrator {
    scene: ExtrudedScene,
    /// The plane section.
    plane: Scene,
    contact: Contact,
    common: CommonPlaneState,
    /// Record of the last computed cycle.
    record: LineRecord,
}

impl ExtrudedIntegrator {
    /// The loaded contact before any wear, by a plan.
    ///
    /// # Errors
    /// A scene that extruded bodies do not describe, a body that cannot be meshed or condensed, a contact without a solution.
    pub(crate) fn start(
        scene: &ExtrudedScene,
        plan: &EffectsPlan,
    ) -> Result<(Self, ExtrudedState), ExtrudedError> {
        let mut run = Self::unloaded(scene, plan)?;
        in_wide_zones(&mut run, |run| {
            let loaded = run.contact.apply_load();
            loaded.map_err(|source| {
                run.failure(FailedIncrement {
                    halvings: 0,
                    source,
                })
            })
        })?;
        run.common.unworn_half_width = run.contact.planes.mean_half_width;
        let positions = vec![run.contact.contacts_at(Position::Neutral)];
        run.take_record(LineRecord {
            positions,
            ..LineRecord::default()
        });
        run.common.last = run.report(0, &run.paths(), 0, 0);
        let state = run.state();
        Ok((run, state))
    }

    /// For a state of a checkpoint, to the same bits as without it.
    ///
    /// # Errors
    /// As [`Self::start`].
    pub(crate) fn resume(
        scene: &ExtrudedScene,
        plan: &EffectsPlan,
        state: &ExtrudedState,
    ) -> Result<Self, ExtrudedError> {
        let mut run = Self::unloaded(scene, plan)?;
        run.enter(state)?;
        Ok(run)
    }

    /// The unworn bodies without load.
    fn unloaded(scene: &ExtrudedScene, plan: &EffectsPlan) -> Result<Self, ExtrudedError> {
        scene.check()?;
        let plane = scene.plane();
        let built = model::build(&plane, plan).map_err(SectionsError::from)?;
        if plane.cycles > 0 {
            scene.check_slip()?;
        }
        Ok(Self {
            scene: scene.clone(),
            plane,
            contact: Contact::new(Bodies::new(scene, built)?),
            common: CommonPlaneState::default(),
            record: LineRecord::default(),
        })
    }

    /// Slides to the turning point where cycles begin, without wear.
    fn initial_quarter(&mut self) -> Result<(), ExtrudedError> {
        let half_width = self.contact.planes.mean_half_width;
        let (motion, accuracy) = (self.plane.motion, &self.plane.accuracy);
        let count = increments::count(motion, accuracy, half_width, false);
        let steps = increments::steps(self.scene.section.motion, count);
        let quarter = increments::initial_quarter(&steps);
        in_wide_zones(self, |run| {
            slide(&mut run.contact, quarter, 0.0, &ReplayPlan::default())
                .map(|_| ())
                .map_err(|failed| run.failure(failed))
        })
    }

    /// Computes the next cycle up to a number of them, with shorter jumps until it has a solution.
    ///
    /// # Errors
    /// A contact without a solution, a body that cannot be meshed or condensed; the state is then as before.
    pub(crate) fn compute_cycle(
        &mut self,
        state: &mut ExtrudedState,
        until: u64,
    ) -> Result<(), ExtrudedError> {
        self.enter(state)?;
        if self.common.computed == 0 {
            self.initial_quarter()?;
        }
        self.follow_wear()?;
        let (paths, (increments, iterations)) = (self.paths(), self.solves());
        let done = self.common.done;
        let first = self.next_jump(until.max(done + 1) - done);
        let (jump, record) = longest_accepted_jump(self, first)?;
        let taken = record.friction_loop.displacement_mm.len();
        self.common.most_increments = self.common.most_increments.max(taken);
        self.common.done += jump;
        self.common.computed += 1;
        self.take_record(record);
        self.common.last = self.report(jump, &paths, increments, iterations);
        *state = self.state();
        Ok(())
    }

    /// Takes a record, with the contacts of its neutral position.
    fn take_record(&mut self, record: LineRecord) {
        let states = self.contact.planes.states.iter_mut();
        for (state, found) in states.zip(record.neutral()) {
            state.neutral = *found;
        }
        self.record = record;
    }

    /// Takes the state that the next cycle begins with.
    fn enter(&mut self, state: &ExtrudedState) -> Result<(), ExtrudedError> {
        self.contact.planes.clone_from(&state.planes);
        self.contact.effort = state.effort;
        self.common.clone_from(&state.common);
        self.contact.bodies.follow(&self.common)
    }

    /// The state after the last cycle.
    fn state(&self) -> ExtrudedState {
        ExtrudedState {
            planes: self.contact.planes.clone(),
            common: self.common.clone(),
            effort: self.contact.effort,
        }
    }

    /// Condenses again what has drifted from the geometry of the operators.
    fn follow_wear(&mut self) -> Result<(), ExtrudedError> {
        let states = &self.contact.planes.states;
        let depths = || states.iter().map(|state| &state.depth);
        if !self
            .contact
            .bodies
            .have_drifted(depths(), &self.plane.accuracy)
        {
            return Ok(());
        }
        self.common.built = depths().cloned().collect();
        self.common.relocations += 1;
        self.contact.bodies.follow(&self.common)
    }

    fn solves(&self) -> (usize, usize) {
        let effort = &self.contact.effort;
        (effort.increments, effort.iterations)
    }

    fn failure(&self, failed: FailedIncrement<ContactError>) -> ExtrudedError {
        let FailedIncrement { halvings, source } = failed;
        ExtrudedError::Sections(SectionsError::Contact {
            cycle: self.common.done,
            section: None,
            halvings,
            source,
        })
    }
}

impl Attempts for ExtrudedIntegrator {
    type Saved = Planes;
    type Record = LineRecord;
    type Error = ExtrudedError;

    fn attempt(&mut self, jump: u64) -> Result<LineRecord, ExtrudedError> {
        let done = self.common.done;
        let plan = self.cycle_plan(Cycles { done, jump });
        let steps = increments::steps(self.scene.section.motion, plan.steps);
        slide(&mut self.contact, &steps, real_cycles(jump), &plan.replays)
            .map_err(|failed| self.failure(failed))
    }

    fn rejected(&mut self, before: &Planes, _: &LineRecord, jump: u64) -> Option<u64> {
        let control = self.common.jump.clone();
        self.measure_jump(before, jump);
        let shorter = self.shorter_jump(jump)?;
        self.common.jump = control;
        Some(shorter)
    }

    fn save(&self) -> Planes {
        self.contact.planes.clone()
    }

    fn go_back(&mut self, before: &Planes) {
        self.contact.planes.clone_from(before);
    }

    fn remedy(&mut self, error: &ExtrudedError) -> Result<Remedy, ExtrudedError> {
        let ExtrudedError::Sections(SectionsError::Contact {
            source: ContactError::WiderThanZone { .. },
            ..
        }) = error
        else {
            return Ok(Remedy::ShorterJump);
        };
        self.common.widenings += 1;
        self.common.relocations += 1;
        self.contact.bodies.follow(&self.common)?;
        Ok(Remedy::WiderZones)
    }

    fn limit(&mut self, most: u64) -> u64 {
        self.common.jump.limit(most);
        most
    }
}
