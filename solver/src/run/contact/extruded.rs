//! The run of extruded bodies: its sections are the node planes of half the width, the reference is the one in the middle.

use super::sections::{Sections, State};
use crate::SolveError;
use crate::along_line::{Ending, SectionsError, StationCycle, StationProfile};
use crate::checkpoint::{CheckpointMismatch, ExtrudedRun, Resumable};
use crate::contact::{ContactState, Work};
use crate::cycle::FrictionLoop;
use crate::effects::EffectsPlan;
use crate::extruded::{ExtrudedError, ExtrudedIntegrator, ExtrudedScene, ExtrudedState};
use crate::fields::{self, ExtrudedSections, LineFields};
use crate::record::Checks;
use crate::scene::Scene;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};

impl Sections for ExtrudedIntegrator {
    type State = ExtrudedState;

    fn unworn(scene: &Scene, plan: &EffectsPlan) -> Result<Self, SolveError> {
        Ok(Self::unloaded(&bodies_of(scene)?, plan)?)
    }

    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &ExtrudedState,
    ) -> Result<Self, SolveError> {
        let bodies = bodies_of(scene)?;
        let (found, stations) = (state.last().stations.len(), bodies.node_planes());
        if found != stations {
            return Err(CheckpointMismatch::Stations { found, stations }.into());
        }
        Ok(Self::resume(&bodies, plan, state)?)
    }

    fn load(&mut self) -> Result<ExtrudedState, SolveError> {
        Ok(self.load()?)
    }

    fn compute_cycle(&mut self, state: &mut ExtrudedState, until: u64) -> Result<(), SolveError> {
        Ok(self.compute_cycle(state, until)?)
    }

    fn cycles_left(&self) -> f64 {
        self.cycles_left()
    }

    fn ending(&self) -> Option<Ending> {
        self.ending()
    }

    fn profile(&self, section: usize) -> StationProfile {
        self.profile(section)
    }

    fn contacts(&self, section: usize) -> impl Iterator<Item = (Position, f64, &ContactState)> {
        self.contacts(section)
    }

    fn fields(&self, scene: &Scene, last: &StationCycle) -> Result<Vec<LineFields>, SolveError> {
        let Some(shape) = scene.dimension.extruded() else {
            return Ok(Vec::new());
        };
        let (planes, models, operators) = self.condensed();
        Ok(fields::extruded(&ExtrudedSections {
            shape: *shape,
            planes,
            models,
            operators,
            at: last.stations.iter().map(|plane| plane.at).collect(),
            depths: self.depths().collect(),
            contacts: self.contacts_at_positions().collect(),
        })?)
    }

    fn slave(&self) -> Side {
        self.slave()
    }

    fn reference(&self) -> usize {
        self.reference()
    }

    fn friction_loop(&self) -> &FrictionLoop {
        self.friction_loop()
    }

    fn residuals(&self) -> Checks {
        self.residuals()
    }

    fn size(&self) -> (usize, usize, f64) {
        self.size()
    }

    fn resumable(run: &ExtrudedRun) -> Resumable<'_> {
        Resumable::Extruded(run)
    }
}

impl State for ExtrudedState {
    fn last(&self) -> &StationCycle {
        self.last()
    }

    fn fastest_rate(&self) -> Sides<f64> {
        self.fastest_rate()
    }

    fn computed(&self) -> (u64, usize) {
        self.computed()
    }

    fn work(&self) -> Work {
        self.work()
    }

    fn relocations(&self) -> u64 {
        self.relocations()
    }

    fn mean_jump_error(&self) -> f64 {
        self.mean_jump_error()
    }
}

fn bodies_of(scene: &Scene) -> Result<ExtrudedScene, ExtrudedError> {
    ExtrudedScene::of(scene).ok_or(ExtrudedError::Sections(SectionsError::Motion))
}
