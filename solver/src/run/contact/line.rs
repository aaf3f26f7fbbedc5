//! The run of a contact along a line: its sections are stations, the reference is the one that touches first.

use super::sections::{Sections, State};
use crate::SolveError;
use crate::along_line::{Ending, SectionsError, StationCycle, StationProfile};
use crate::checkpoint::{CheckpointMismatch, LineRun, Resumable};
use crate::contact::{ContactState, Work};
use crate::cycle::FrictionLoop;
use crate::effects::EffectsPlan;
use crate::fields::{self, LineFields, SectionState};
use crate::record::Checks;
use crate::scene::Scene;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};
use crate::station::{LineIntegrator, LineState, StationError, StationScene};

impl Sections for LineIntegrator {
    type State = LineState;

    fn unworn(scene: &Scene, plan: &EffectsPlan) -> Result<Self, SolveError> {
        Ok(Self::unloaded(&line_of(scene)?, plan)?)
    }

    fn resume(scene: &Scene, plan: &EffectsPlan, state: &LineState) -> Result<Self, SolveError> {
        let line = line_of(scene)?;
        let (found, stations) = (state.last().stations.len(), line.stations);
        if found != stations {
            return Err(CheckpointMismatch::Stations { found, stations }.into());
        }
        Ok(Self::resume(&line, plan, state)?)
    }

    fn load(&mut self) -> Result<LineState, SolveError> {
        Ok(self.load()?)
    }

    fn compute_cycle(&mut self, state: &mut LineState, until: u64) -> Result<(), SolveError> {
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
        let Some(line) = scene.dimension.line() else {
            return Ok(Vec::new());
        };
        let numbers = last.stations.iter().enumerate();
        let sections: Vec<SectionState<'_>> = numbers
            .map(|(number, report)| {
                let (model, condensed, depth) = self.section(number);
                let contacts = self.contacts(number);
                SectionState {
                    at: report.at,
                    model,
                    condensed,
                    depth,
                    contacts: contacts.map(|(at, _, contact)| (at, contact)).collect(),
                }
            })
            .collect();
        Ok(self.within(|| fields::along_line(line.shape, &sections, last.cycle > 0))?)
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

    fn resumable(run: &LineRun) -> Resumable<'_> {
        Resumable::Line(run)
    }
}

impl State for LineState {
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

fn line_of(scene: &Scene) -> Result<StationScene, StationError> {
    StationScene::of(scene).ok_or(StationError::Sections(SectionsError::Motion))
}
