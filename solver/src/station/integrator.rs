//! Computed cycles of a line: each stands for a jump, which the worst station decides.

mod plan;
mod report;

use std::sync::Arc;

use super::coupling::Coupling;
use super::cycle::{Line, SavedLine};
use super::error::StationError;
use super::height::Height;
use super::meshed::Section;
use super::place::places;
use super::scene::{StationScene, intervals_within};
use super::section::Station;
use super::side_by_side::for_each;
use super::state::{CommonLineState, LineState, StationState};
use super::top::{Carrier, Unsolved};
use crate::along_line::{LineRecord, Sections, SectionsError, SectionsIncrement, slide};
use crate::contact::{ContactError, ContactState};
use crate::cycle::retry::FailedIncrement;
use crate::effects::EffectsPlan;
use crate::model;
use crate::number::real_cycles;
use crate::scene::{Scene, Top};
use crate::schedule::attempts::{Attempts, Remedy, in_wide_zones, longest_accepted_jump};
use crate::schedule::increments;
use crate::schedule::plan::Cycles;
use crate::schedule::replay::ReplayPlan;
use crate::schedule::step::Position;
use crate::threads::Threads;

/// Computes the cycles of a contact along a line.
pub(crate) struct LineIntegrator {
    scene: StationScene,
    /// The plane section under the mean line load.
    plane: Scene,
    amplitude_mm: f64,
    unworn: Arc<Section>,
    line: Line,
    /// Record of the last computed cycle.
    record: LineRecord,
    threads: Arc<Threads>,
}

impl LineIntegrator {
    /// The loaded contact before any wear, by a plan.
    ///
    /// # Errors
    /// A scene that stations do not describe, a section that cannot be meshed, a contact without a solution.
    pub(crate) fn start(
        scene: &StationScene,
        plan: &EffectsPlan,
    ) -> Result<(Self, LineState), StationError> {
        let mut integrator = Self::unloaded(scene, plan)?;
        let threads = Arc::clone(&integrator.threads);
        threads.within(|| integrator.apply_load())?;
        integrator.record.positions = vec![integrator.line.contacts_at(Position::Neutral)];
        integrator.line.common.last = integrator.report(0, &integrator.paths(), 0, 0);
        let state = integrator.state();
        Ok((integrator, state))
    }

    /// For a state of a checkpoint, to the same bits as without it.
    ///
    /// # Errors
    /// As [`Self::start`].
    pub(crate) fn resume(
        scene: &StationScene,
        plan: &EffectsPlan,
        state: &LineState,
    ) -> Result<Self, StationError> {
        let mut integrator = Self::unloaded(scene, plan)?;
        debug_assert_eq!(
            state.stations.len(),
            integrator.line.stations.len(),
            "the state is one of this scene"
        );
        let threads = Arc::clone(&integrator.threads);
        threads.within(|| integrator.enter(state))?;
        Ok(integrator)
    }

    /// The unworn sections without load.
    fn unloaded(scene: &StationScene, plan: &EffectsPlan) -> Result<Self, StationError> {
        let amplitude_mm = scene.check()?;
        let plane = scene.plane();
        let built = model::build(&plane, plan).map_err(SectionsError::from)?;
        scene.check_slip(&plane)?;
        let (spring, slave) = (built.interface.spring, built.interface.slave);
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
            line: Line {
                carrier: Carrier {
                    top: scene.top,
                    coupling,
                    force_n: scene.force_n,
                    spring_n_per_mm: spring * scene.line.length_mm(),
                },
                stations: stations.collect(),
                common: CommonLineState::default(),
            },
            scene: scene.clone(),
            plane,
            amplitude_mm,
            unworn,
            record: LineRecord::default(),
            threads: Arc::new(Threads::new(scene.section.threads.min(scene.stations))),
        })
    }

    /// Applies the load, with wider zones where the contact of a section needs them.
    fn apply_load(&mut self) -> Result<(), StationError> {
        in_wide_zones(self, |integrator| {
            integrator.line.stations.iter_mut().for_each(Station::hold);
            let loaded = integrator.apply_load_once();
            integrator
                .line
                .stations
                .iter_mut()
                .for_each(Station::release);
            loaded
        })
    }

    /// Applies the load without sliding: friction holds the sections together, which locks in shear between unlike bodies. The height under the mean line load is the first one of a rigid top.
    fn apply_load_once(&mut self) -> Result<(), StationError> {
        // At the neutral position.
        let first_load = SectionsIncrement {
            lemke: true,
            ..SectionsIncrement::new(0.0, 0.0)
        };
        let line = &mut self.line;
        if self.scene.top != Top::Even {
            let first = &mut line.stations[0];
            first
                .solve(first_load, None, None)
                .map_err(|source| SectionsError::Contact {
                    cycle: 0,
                    section: Some(0),
                    halvings: 0,
                    source,
                })?;
            line.common.height = Height::at(first.attempted_height());
        }
        line.carrier
            .advance(&mut line.stations, &mut line.common.height, first_load)
            .map_err(|source| {
                self.failure(FailedIncrement {
                    halvings: 0,
                    source,
                })
            })?;
        self.line.common.height.loaded();
        for station in &mut self.line.stations {
            station.loaded();
        }
        Ok(())
    }

    /// Slides to the turning point where cycles begin, without wear.
    fn initial_quarter(&mut self) -> Result<(), StationError> {
        let count = self.largest(|run, j| {
            let half_width = run.line.stations[j].state.mean_half_width;
            increments::count(run.motion(j), &run.plane.accuracy, half_width, false)
        });
        let steps = increments::steps(self.plane.motion, count);
        let quarter = increments::initial_quarter(&steps);
        in_wide_zones(self, |integrator| {
            slide(&mut integrator.line, quarter, 0.0, &ReplayPlan::default())
                .map(|_| ())
                .map_err(|failed| integrator.failure(failed))
        })
    }

    /// Computes the next cycle up to a number of them, with shorter jumps until it has a solution.
    ///
    /// # Errors
    /// A contact without a solution, a section that cannot be meshed; the state is then as before.
    pub(crate) fn compute_cycle(
        &mut self,
        state: &mut LineState,
        until: u64,
    ) -> Result<(), StationError> {
        let threads = Arc::clone(&self.threads);
        threads.within(|| self.compute_cycle_within(state, until))
    }

    fn compute_cycle_within(
        &mut self,
        state: &mut LineState,
        until: u64,
    ) -> Result<(), StationError> {
        self.enter(state)?;
        if self.line.common.computed == 0 {
            self.initial_quarter()?;
        }
        self.follow_wear()?;
        let paths = self.paths();
        let (increments, iterations) = (self.line.common.increments, self.line.common.iterations);
        let done = self.line.common.done;
        let first = self.next_jump(until.max(done + 1) - done);
        let (jump, record) = longest_accepted_jump(self, first)?;
        let common = &mut self.line.common;
        let taken = record.friction_loop.displacement_mm.len();
        common.most_increments = common.most_increments.max(taken);
        common.done += jump;
        common.computed += 1;
        self.take_record(record);
        self.line.common.last = self.report(jump, &paths, increments, iterations);
        *state = self.state();
        Ok(())
    }

    /// Takes the record of a cycle, with the contacts of its neutral position.
    fn take_record(&mut self, record: LineRecord) {
        for (station, found) in self.line.stations.iter_mut().zip(record.neutral()) {
            station.state.neutral = *found;
        }
        self.record = record;
    }

    /// Takes the state that the next cycle begins with.
    fn enter(&mut self, state: &LineState) -> Result<(), SectionsError> {
        for (station, state) in self.line.stations.iter_mut().zip(&state.stations) {
            station.state = state.clone();
        }
        self.line.common = state.common.clone();
        self.build()
    }

    /// The state after the last cycle.
    fn state(&self) -> LineState {
        let stations = self.line.stations.iter();
        LineState {
            stations: stations.map(|station| station.state.clone()).collect(),
            common: self.line.common.clone(),
        }
    }

    /// Condenses sections again that have drifted from the geometry of their operators.
    fn follow_wear(&mut self) -> Result<(), SectionsError> {
        for station in &mut self.line.stations {
            self.line.common.relocations += u64::from(station.drifts(&self.plane.accuracy));
        }
        self.build()
    }

    /// Builds the sections of the present states.
    fn build(&mut self) -> Result<(), SectionsError> {
        let unworn = &self.unworn;
        for_each(&mut self.line.stations, |_, station| {
            station.follow_state(unworn)
        })
        .map_err(|(_, error)| error)
    }

    fn failure(&self, failed: FailedIncrement<Unsolved>) -> StationError {
        let FailedIncrement { halvings, source } = failed;
        let cycle = self.line.common.done;
        match source {
            Unsolved::Section { station, source } => SectionsError::Contact {
                cycle,
                section: Some(station),
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
}

impl Attempts for LineIntegrator {
    type Saved = SavedLine;
    type Record = LineRecord;
    type Error = StationError;

    fn attempt(&mut self, jump: u64) -> Result<LineRecord, StationError> {
        let done = self.line.common.done;
        let plan = self.cycle_plan(Cycles { done, jump });
        let steps = increments::steps(self.plane.motion, plan.steps);
        slide(&mut self.line, &steps, real_cycles(jump), &plan.replays)
            .map_err(|failed| self.failure(failed))
    }

    /// That of the worst station whose rate depends on its depth.
    fn rejected(&mut self, before: &SavedLine, _: &LineRecord, jump: u64) -> Option<u64> {
        self.measure_jump(&before.stations, jump);
        let shorter = self.shorter_jump(jump)?;
        for (station, state) in self.line.stations.iter_mut().zip(&before.stations) {
            station.state.jump = state.jump.clone();
        }
        Some(shorter)
    }

    fn save(&self) -> SavedLine {
        self.line.save()
    }

    fn go_back(&mut self, before: &SavedLine) {
        self.line.restore(before);
    }

    fn remedy(&mut self, error: &StationError) -> Result<Remedy, StationError> {
        let StationError::Sections(SectionsError::Contact {
            section: Some(station),
            source: ContactError::WiderThanZone { .. },
            ..
        }) = *error
        else {
            return Ok(Remedy::ShorterJump);
        };
        self.line.stations[station].widen();
        self.line.common.relocations += 1;
        self.build()?;
        Ok(Remedy::WiderZones)
    }

    fn limit(&mut self, most: u64) -> u64 {
        for station in &mut self.line.stations {
            station.state.jump.limit(most);
        }
        most
    }
}
