//! The run of extruded bodies: its sections are the node planes of half the width, the reference is the one in the middle.

use super::sections::ReportedSections;
use crate::SolveError;
use crate::along_line::{SectionsError, StationCycle};
use crate::checkpoint::{CheckpointMismatch, ExtrudedRun, Resumable};
use crate::contact::Work;
use crate::effects::EffectsPlan;
use crate::extruded::{
    ExtrudedContact, ExtrudedError, ExtrudedHistory, ExtrudedIntegrator, ExtrudedScene,
    ExtrudedState,
};
use crate::fields::{self, ExtrudedSections, LineFields};
use crate::scene::Scene;
use crate::sides::Sides;

impl ReportedSections for ExtrudedContact {
    type History = ExtrudedHistory;

    fn unworn(scene: &Scene, plan: &EffectsPlan) -> Result<ExtrudedIntegrator, SolveError> {
        Ok(ExtrudedIntegrator::unloaded(&bodies_of(scene)?, plan)?)
    }

    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &ExtrudedState,
    ) -> Result<ExtrudedIntegrator, SolveError> {
        let bodies = bodies_of(scene)?;
        let (found, stations) = (state.last().stations.len(), bodies.node_planes());
        if found != stations {
            return Err(CheckpointMismatch::Stations { found, stations }.into());
        }
        Ok(ExtrudedIntegrator::resume(&bodies, plan, state)?)
    }

    fn fields(
        integrator: &ExtrudedIntegrator,
        scene: &Scene,
        last: &StationCycle,
    ) -> Result<Vec<LineFields>, SolveError> {
        let Some(shape) = scene.dimension.extruded() else {
            return Ok(Vec::new());
        };
        let (planes, models, operators) = integrator.condensed();
        Ok(fields::extruded(&ExtrudedSections {
            shape: *shape,
            planes,
            models,
            operators,
            at: last.stations.iter().map(|plane| plane.at).collect(),
            depths: integrator.depths().collect(),
            contacts: integrator.contacts_at_positions().collect(),
        })?)
    }

    fn reference(integrator: &ExtrudedIntegrator) -> usize {
        integrator.reference()
    }

    fn size(integrator: &ExtrudedIntegrator) -> (usize, usize, f64) {
        integrator.size()
    }

    fn take_history(state: &mut ExtrudedState) -> ExtrudedHistory {
        state.take_motion_history()
    }

    fn continue_motion(state: &mut ExtrudedState, history: ExtrudedHistory) {
        state.continue_motion(history);
    }

    fn fastest_rate(state: &ExtrudedState) -> Sides<f64> {
        state.fastest_rate()
    }

    fn work(state: &ExtrudedState) -> Work {
        state.work()
    }

    fn mean_jump_error(state: &ExtrudedState, histories: &[&ExtrudedHistory]) -> f64 {
        state.mean_jump_error(histories)
    }

    fn resumable(run: &ExtrudedRun) -> Resumable<'_> {
        Resumable::Extruded(run)
    }
}

fn bodies_of(scene: &Scene) -> Result<ExtrudedScene, ExtrudedError> {
    ExtrudedScene::of(scene).ok_or(ExtrudedError::Sections(SectionsError::Motion))
}
