//! The contact of extruded bodies in their node planes: how its load is applied, and the bodies that follow its wear.

mod plan;
mod report;

use std::sync::Arc;

use super::bodies::Bodies;
use super::cycle::{ExtrudedContact, SavedPlanes};
use super::error::ExtrudedError;
use super::scene::{ExtrudedScene, to_the_right};
use super::state::{ExtrudedState, PlanesState};
use crate::along_line::{
    Along, SectionedContact, Sections, SectionsError, SectionsIncrement, SectionsIntegrator,
    WornSection,
};
use crate::contact::ContactError;
use crate::cycle::retry::FailedIncrement;
use crate::cycle::{Checks, Neutral};
use crate::effects::EffectsPlan;
use crate::model::{self, Interface};
use crate::scene::{Motion, Scene};
use crate::schedule::increments;
use crate::schedule::plan::{CyclePlan, Cycles};
use crate::sides::Sides;
use crate::threads::Threads;

/// Computes the cycles of extruded bodies.
pub(crate) type ExtrudedIntegrator = SectionsIntegrator<ExtrudedContact>;

impl ExtrudedIntegrator {
    /// The unworn bodies without load, by a plan.
    ///
    /// # Errors
    /// A scene that extruded bodies do not describe, a body that cannot be meshed or condensed.
    pub(crate) fn unloaded(
        scene: &ExtrudedScene,
        plan: &EffectsPlan,
    ) -> Result<Self, ExtrudedError> {
        Ok(Self::of(ExtrudedContact::unloaded(scene, plan)?))
    }

    /// For a state of a checkpoint, to the same bits as without it.
    ///
    /// # Errors
    /// As [`Self::unloaded`].
    pub(crate) fn resume(
        scene: &ExtrudedScene,
        plan: &EffectsPlan,
        state: &ExtrudedState,
    ) -> Result<Self, ExtrudedError> {
        Self::resumed(ExtrudedContact::unloaded(scene, plan)?, state)
    }
}

impl ExtrudedContact {
    /// The unworn bodies without load.
    fn unloaded(scene: &ExtrudedScene, plan: &EffectsPlan) -> Result<Self, ExtrudedError> {
        scene.check()?;
        let plane = scene.plane();
        let built = model::build(&plane, plan).map_err(SectionsError::from)?;
        if plane.cycles > 0 {
            scene.check_slip()?;
        }
        Ok(Self::new(scene, plane, Bodies::new(scene, built)?))
    }
}

impl SectionedContact for ExtrudedContact {
    type State = PlanesState;
    type Error = ExtrudedError;

    fn plane(&self) -> &Scene {
        &self.plane
    }

    fn interface(&self) -> &Interface {
        &self.interface
    }

    fn motion(&self) -> Motion {
        self.scene.section.motion
    }

    fn force_n(&self) -> f64 {
        self.scene.force_n()
    }

    fn threads(&self) -> Option<Arc<Threads>> {
        None
    }

    fn apply_load(&mut self) -> Result<(), ExtrudedError> {
        self.update_surfaces(Cycles { done: 0, jump: 0 });
        let loaded = self.advance(SectionsIncrement::new(0.0, 0.0));
        loaded.map_err(|source| {
            let halvings = 0;
            self.failure(0, FailedIncrement { halvings, source })
        })?;
        for contact in &mut self.planes.contacts {
            contact.reference_height = Some(contact.height);
        }
        self.planes.mean_half_width = self.half_width();
        self.common.unworn_half_width = self.planes.mean_half_width;
        Ok(())
    }

    fn increments_of(&self, motion: Motion) -> usize {
        let half_width = self.planes.mean_half_width;
        increments::count(
            to_the_right(motion),
            &self.plane.accuracy,
            half_width,
            false,
        )
    }

    fn take_motion(&mut self, block: &Scene) {
        self.scene.section.take_motion(block);
        self.plane.take_motion(block);
        self.plane.motion = to_the_right(block.motion);
    }

    fn follow_wear(&mut self) -> Result<u64, ExtrudedError> {
        let (bodies, states) = (&self.bodies, &self.planes.states);
        let depths = || states.iter().map(|state| &state.depth);
        if !bodies.have_drifted(depths(), &self.plane.accuracy) {
            return Ok(0);
        }
        self.common.built = depths().cloned().collect();
        self.bodies.follow(&self.common)?;
        Ok(1)
    }

    fn widen(&mut self, error: &ExtrudedError) -> Result<bool, ExtrudedError> {
        let ExtrudedError::Sections(SectionsError::Contact {
            source: ContactError::WiderThanZone { .. },
            ..
        }) = error
        else {
            return Ok(false);
        };
        self.common.widenings += 1;
        self.bodies.follow(&self.common)?;
        Ok(true)
    }

    fn failure(&self, cycle: u64, failed: FailedIncrement<ContactError>) -> ExtrudedError {
        let FailedIncrement { halvings, source } = failed;
        ExtrudedError::Sections(SectionsError::Contact {
            cycle,
            halvings,
            source,
        })
    }

    fn state(&self) -> PlanesState {
        PlanesState {
            planes: self.planes.clone(),
            common: self.common.clone(),
            effort: self.effort,
        }
    }

    fn enter(&mut self, state: &PlanesState) -> Result<(), ExtrudedError> {
        self.planes.clone_from(&state.planes);
        self.effort = state.effort;
        self.common.clone_from(&state.common);
        self.bodies.follow(&self.common)
    }

    fn take_neutral(&mut self, found: &[Neutral]) {
        for (state, found) in self.planes.states.iter_mut().zip(found) {
            state.neutral = *found;
        }
    }

    fn next_jump(&mut self, most: Cycles) -> u64 {
        let stroke = self.followed().stroke_after(most.done);
        self.common
            .jump
            .next(&self.plane.accuracy, stroke, most.jump)
    }

    fn cycle_plan(&self, cycles: Cycles) -> CyclePlan {
        self.followed().plan(cycles)
    }

    fn rejected(&mut self, before: &SavedPlanes, jump: u64) -> Option<u64> {
        let control = self.common.jump.clone();
        self.measure_jump(&before.planes, jump);
        let shorter = self.followed().shorter_jump(&self.common.jump, jump)?;
        self.common.jump = control;
        Some(shorter)
    }

    fn limit(&mut self, most: u64) {
        self.common.jump.limit(most);
    }

    fn jump_error(&self) -> f64 {
        self.common.jump.error
    }

    fn solves(&self) -> (usize, usize) {
        let effort = &self.effort;
        (effort.increments, effort.iterations)
    }

    fn checks(&self) -> Checks {
        self.effort.checks
    }

    fn worn(&self) -> Vec<WornSection<'_>> {
        let bodies = &self.bodies;
        let sections = bodies.operators.sections.as_ref();
        let rates = self.common.jump.rates();
        let width = self.scene.width_mm;
        let states = self.planes.states.iter().enumerate();
        let places = bodies.planes.z().iter().zip(&bodies.shares);
        let planes = states.zip(places);
        planes
            .map(|((plane, state), (z, share))| WornSection {
                at: Along::DistanceMm(0.5 * width - z),
                weight_mm: share * width,
                x_mm: sections.map(|section| &section.x[..]),
                widths_mm: sections.map(|section| &section.widths[..]),
                depth: &state.depth,
                rates: Sides::from_fn(|side| {
                    let nodes = state.depth.of(side).len();
                    let own = rates.of(side).get(plane * nodes..(plane + 1) * nodes);
                    own.unwrap_or_default()
                }),
                worn_area: state.worn_area,
                path: state.path,
                energy: state.energy,
                neutral: state.neutral,
                spines: &self.spines,
            })
            .collect()
    }
}
