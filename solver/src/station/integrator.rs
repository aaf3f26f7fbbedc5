//! The contact of stations under their top: how its load is applied, and the sections that follow its wear.

mod plan;
mod report;

use std::sync::Arc;

use super::coupling::Coupling;
use super::cycle::{LineContact, SavedLine};
use super::error::StationError;
use super::height::Height;
use super::meshed::Section;
use super::place::places;
use super::scene::{StationScene, intervals_within};
use super::section::Station;
use super::side_by_side::for_each;
use super::state::{CommonLineState, LineState, StationState, StationsState};
use super::top::{Carrier, Unsolved};
use crate::along_line::{
    SectionedContact, Sections, SectionsError, SectionsIncrement, SectionsIntegrator, WornSection,
};
use crate::contact::{ContactError, ContactState};
use crate::cycle::retry::FailedIncrement;
use crate::cycle::{Checks, Neutral};
use crate::effects::EffectsPlan;
use crate::model::{self, BodyModel, Interface};
use crate::scene::{Motion, Scene, Top};
use crate::schedule::plan::{CyclePlan, Cycles};
use crate::threads::Threads;

/// Computes the cycles of a contact along a line.
pub(crate) type LineIntegrator = SectionsIntegrator<LineContact>;

impl LineIntegrator {
    /// The unworn sections without load, by a plan.
    ///
    /// # Errors
    /// A scene that stations do not describe, a section that cannot be meshed.
    pub(crate) fn unloaded(scene: &StationScene, plan: &EffectsPlan) -> Result<Self, StationError> {
        Ok(Self::of(LineContact::unloaded(scene, plan)?))
    }

    /// For a state of a checkpoint, to the same bits as without it.
    ///
    /// # Errors
    /// As [`Self::unloaded`].
    pub(crate) fn resume(
        scene: &StationScene,
        plan: &EffectsPlan,
        state: &LineState,
    ) -> Result<Self, StationError> {
        Self::resumed(LineContact::unloaded(scene, plan)?, state)
    }
}

impl LineContact {
    /// The unworn sections without load.
    fn unloaded(scene: &StationScene, plan: &EffectsPlan) -> Result<Self, StationError> {
        scene.check()?;
        let plane = scene.plane();
        let built = model::build(&plane, plan).map_err(SectionsError::from)?;
        scene.check_slip(&plane)?;
        let (spring, slave) = (built.interface.spring, built.interface.slave);
        let friction = plane.contact_friction(&built.interface.wear, built.surface.plating);
        let unworn = Arc::new(Section::unworn(built)?);
        let untouched = ContactState::untouched(&unworn.condensed.operators, slave);
        let within = intervals_within(&scene.section.accuracy);
        let places = places(scene.line, scene.stations, scene.touch(), within);
        let coupling = Coupling::of(scene, &plane, plan, &places)?;
        let stations = places.into_iter().map(|place| {
            let state = StationState::unworn(untouched.clone(), &unworn.model);
            Station::new(place, &unworn, state)
        });
        Ok(Self {
            carrier: Carrier {
                top: scene.top,
                coupling,
                force_n: scene.force_n,
                spring_n_per_mm: spring * scene.line.length_mm(),
            },
            stations: stations.collect(),
            common: CommonLineState::default(),
            friction,
            scene: scene.clone(),
            plane,
            unworn,
            threads: Arc::new(Threads::new(scene.section.threads.min(scene.stations))),
        })
    }

    /// Applies the load without sliding: friction holds the sections together, which locks in shear between unlike bodies. The height under the mean line load is the first one of a rigid top.
    fn apply_load_once(&mut self) -> Result<(), StationError> {
        // At the neutral position.
        let first_load = SectionsIncrement {
            lemke: true,
            ..SectionsIncrement::new(0.0, 0.0)
        };
        if self.scene.top != Top::Even {
            let first = &mut self.stations[0];
            first
                .solve(first_load, None, None)
                .map_err(|source| SectionsError::Station {
                    cycle: 0,
                    station: 0,
                    halvings: 0,
                    source,
                })?;
            self.common.height = Height::at(first.attempted_height());
        }
        self.carrier
            .advance(&mut self.stations, &mut self.common.height, first_load)
            .map_err(|source| {
                self.failure(
                    0,
                    FailedIncrement {
                        halvings: 0,
                        source,
                    },
                )
            })?;
        self.common.height.loaded();
        for station in &mut self.stations {
            station.loaded();
        }
        Ok(())
    }

    /// Builds the sections of the present states.
    fn build(&mut self) -> Result<(), SectionsError> {
        let unworn = &self.unworn;
        for_each(&mut self.stations, |_, station| {
            station.follow_state(unworn)
        })
        .map_err(|(_, error)| error)
    }
}

impl SectionedContact for LineContact {
    type State = StationsState;
    type Error = StationError;

    fn plane(&self) -> &Scene {
        &self.plane
    }

    fn interface(&self) -> &Interface {
        &self.unworn.model.interface
    }

    fn motion(&self) -> Motion {
        self.plane.motion
    }

    fn force_n(&self) -> f64 {
        self.scene.force_n
    }

    fn threads(&self) -> Option<Arc<Threads>> {
        Some(Arc::clone(&self.threads))
    }

    fn apply_load(&mut self) -> Result<(), StationError> {
        self.update_surfaces(Cycles { done: 0, jump: 0 });
        self.stations.iter_mut().for_each(Station::hold);
        let loaded = self.apply_load_once();
        self.stations.iter_mut().for_each(Station::release);
        loaded
    }

    fn increments_of(&self, motion: Motion) -> usize {
        self.most_increments(motion)
    }

    fn take_motion(&mut self, block: &Scene) {
        self.plane.take_motion(block);
    }

    fn follow_wear(&mut self) -> Result<u64, StationError> {
        let mut drifted = 0;
        for station in &mut self.stations {
            drifted += u64::from(station.drifts(&self.plane.accuracy));
        }
        self.build()?;
        Ok(drifted)
    }

    /// The zones of the station that needs it, with all others as they are.
    fn widen(&mut self, error: &StationError) -> Result<bool, StationError> {
        let StationError::Sections(SectionsError::Station {
            station,
            source: ContactError::WiderThanZone { .. },
            ..
        }) = *error
        else {
            return Ok(false);
        };
        self.stations[station].widen();
        self.build()?;
        Ok(true)
    }

    fn failure(&self, cycle: u64, failed: FailedIncrement<Unsolved>) -> StationError {
        let FailedIncrement { halvings, source } = failed;
        match source {
            Unsolved::Section { station, source } => SectionsError::Station {
                cycle,
                station,
                halvings,
                source,
            }
            .into(),
            Unsolved::Height {
                found_n,
                iterations,
            } => StationError::Height {
                cycle,
                found_n,
                force_n: self.scene.force_n,
                iterations,
                halvings,
            },
        }
    }

    fn state(&self) -> StationsState {
        let stations = self.stations.iter();
        StationsState {
            stations: stations.map(|station| station.state.clone()).collect(),
            common: self.common.clone(),
        }
    }

    fn enter(&mut self, state: &StationsState) -> Result<(), StationError> {
        let stations = &mut self.stations;
        debug_assert_eq!(
            state.stations.len(),
            stations.len(),
            "the state is one of this scene"
        );
        for (station, state) in stations.iter_mut().zip(&state.stations) {
            station.state = state.clone();
        }
        self.common = state.common.clone();
        Ok(self.build()?)
    }

    fn take_neutral(&mut self, found: &[Neutral]) {
        for (station, found) in self.stations.iter_mut().zip(found) {
            station.state.neutral = *found;
        }
    }

    fn next_jump(&mut self, most: Cycles) -> u64 {
        self.jump_of_leading(most)
    }

    fn cycle_plan(&self, cycles: Cycles) -> CyclePlan {
        self.plan_of_leading(cycles)
    }

    fn rejected(&mut self, before: &SavedLine, jump: u64) -> Option<u64> {
        self.measure_jump(&before.stations, jump);
        let shorter = self.shorter_jump(jump)?;
        for (station, state) in self.stations.iter_mut().zip(&before.stations) {
            station.state.jump = state.jump.clone();
        }
        Some(shorter)
    }

    fn limit(&mut self, most: u64) {
        for station in &mut self.stations {
            station.state.jump.limit(most);
        }
    }

    fn jump_error(&self) -> f64 {
        let stations = self.stations.iter();
        let errors = stations.map(|station| station.state.jump.error);
        errors.fold(0.0, f64::max)
    }

    fn solves(&self) -> (usize, usize) {
        (self.common.increments, self.common.iterations)
    }

    fn checks(&self) -> Checks {
        let own = Checks {
            force_balance: self.common.height.imbalance,
            force_balance_present_normals: self.common.imbalance,
            ..Checks::default()
        };
        let stations = self.stations.iter();
        stations.fold(own, |worst, station| {
            Checks::worse_of(worst, station.state.checks)
        })
    }

    fn worn(&self) -> Vec<WornSection<'_>> {
        let bodies = self.unworn.model.bodies.as_ref();
        let x_mm = bodies.map(BodyModel::contact_x);
        let stations = self.stations.iter();
        stations.map(|station| station.worn(x_mm)).collect()
    }
}
