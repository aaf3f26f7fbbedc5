//! The run of a contact along a line: its reference section is the one that touches first.

use super::Contact;
use super::sections::{self, Sections};
use crate::SolveError;
use crate::along_line::StationProfile;
use crate::checkpoint::{LineRun, Misfit, Resumable};
use crate::contact::ContactState;
use crate::cycle::FrictionLoop;
use crate::effects::EffectsPlan;
use crate::electrical::{AreaContact, ContactResistance};
use crate::record::{Checks, CycleReport, Outcome, Resolution, Snapshot, WornArea};
use crate::scene::Scene;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};
use crate::station::{Ending, LineIntegrator, LineState, StationError, StationScene};

impl Sections for LineIntegrator {
    fn profile(&self, section: usize) -> StationProfile {
        self.profile(section)
    }

    fn contacts(&self, section: usize) -> impl Iterator<Item = (Position, f64, &ContactState)> {
        self.contacts(section)
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
}

impl Contact for LineIntegrator {
    type State = LineState;
    type Worn = Vec<StationProfile>;
    type Scar = WornArea;

    fn start(scene: &Scene, plan: &EffectsPlan) -> Result<(Self, LineState), SolveError> {
        Ok(Self::start(&line_of(scene)?, plan)?)
    }

    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut LineState,
    ) -> Result<Self, SolveError> {
        let line = line_of(scene)?;
        let (found, stations) = (state.last().stations.len(), line.stations);
        if found != stations {
            return Err(Misfit::Stations { found, stations }.into());
        }
        Ok(Self::resume(&line, plan, state)?)
    }

    fn compute_cycle(&mut self, state: &mut LineState, until: u64) -> Result<(), SolveError> {
        Ok(self.compute_cycle(state, until)?)
    }

    fn cycle(state: &LineState) -> u64 {
        state.cycle()
    }

    fn max_depth_mm(state: &LineState) -> Sides<f64> {
        state.last().max_depth_mm()
    }

    fn fastest_rate(state: &LineState) -> Sides<f64> {
        state.fastest_rate()
    }

    fn cycles_left(&self) -> (f64, bool) {
        let worn_through = matches!(self.ending(), Some(Ending::WornThrough(_)));
        (self.cycles_left(), worn_through)
    }

    fn ending(&self) -> Option<Outcome> {
        self.ending().map(|ending| match ending {
            Ending::WornThrough(_) => Outcome::WornThrough,
            Ending::DeeperThanRadius(_) => Outcome::DeeperThanRadius,
        })
    }

    fn area(_: &LineState, _: f64) -> Option<AreaContact> {
        None
    }

    fn worn(&self, state: &LineState) -> Vec<StationProfile> {
        sections::worn(self, state.last().stations.len())
    }

    fn scars(worn: &Vec<StationProfile>) -> Sides<WornArea> {
        sections::scars(worn)
    }

    fn report(
        &self,
        scene: &Scene,
        state: &LineState,
        worn: &Vec<StationProfile>,
        _: Option<&ContactResistance>,
    ) -> CycleReport {
        sections::report(self, scene, (state.last(), worn))
    }

    fn snapshot(&self, _: &Scene, state: &LineState, worn: Vec<StationProfile>) -> Snapshot {
        sections::snapshot(self, state.last(), worn)
    }

    fn resolution(&self, state: &LineState) -> Resolution {
        let (dofs, contact_elements, contact_element_mm) = self.size();
        let (computed_cycles, most_increments) = state.computed();
        Resolution {
            contact_element_mm,
            contact_elements,
            increments_per_cycle: u32::try_from(most_increments).unwrap_or(u32::MAX),
            computed_cycles,
            work: state.work(),
            dofs,
            relocations: state.relocations(),
            estimated_relative_error: state.mean_jump_error(),
        }
    }

    fn checks(&self, _: &LineState) -> Checks {
        self.residuals()
    }

    fn resumable(run: &LineRun) -> Resumable<'_> {
        Resumable::Line(run)
    }
}

fn line_of(scene: &Scene) -> Result<StationScene, StationError> {
    StationScene::of(scene).ok_or(StationError::Motion)
}
