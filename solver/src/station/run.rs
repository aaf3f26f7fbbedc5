//! The cycles of a line: each computed one stands for a jump, which the worst station decides.

mod plan;
mod report;

use std::ops::ControlFlow;
use std::sync::Arc;

use super::cycle::{Line, Work};
use super::error::StationError;
use super::place::places;
use super::record::{StationCycle, StationOutcome, StationSummary};
use super::scene::{StationScene, Top};
use super::section::{Increment, Section, Station, StationState};
use super::top::{Carrier, Height, Unsolved};
use crate::law::surface::SurfaceWear;
use crate::model::resolution;
use crate::number::real_cycles;
use crate::scene::Scene;
use crate::schedule::increments;
use crate::schedule::plan::Cycles;
use crate::sides::Sides;
use crate::{condensation, effects, model};

/// The load at the neutral position, without sliding.
const FIRST_LOAD: Increment = Increment {
    from: 0.0,
    to: 0.0,
    cycles: 0.0,
    lemke: true,
    like: None,
};

/// A run between two computed cycles.
struct Run<'a> {
    scene: &'a StationScene,
    plane: Scene,
    amplitude_mm: f64,
    line: Line,
    /// Wear rates of both sides, 1/MPa.
    rates: Sides<f64>,
    /// Half-width of each unworn contact, mm.
    single: Vec<f64>,
    done: u64,
    computed: usize,
    relocations: usize,
}

/// Simulates a contact along a line. Its cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that stations do not describe, a section that cannot be meshed, a contact without a solution.
pub fn run(
    scene: &StationScene,
    mut on_cycle: impl FnMut(&StationCycle) -> ControlFlow<()>,
) -> Result<StationSummary, StationError> {
    scene.check()?;
    let mut run = Run::start(scene)?;
    let initial = run.report(0, &run.paths(), Work::default());
    run.initial_quarter()?;
    let mut last = initial.clone();
    let mut outcome = StationOutcome::Completed;
    while run.done < scene.section.cycles {
        last = run.compute_cycle()?;
        if on_cycle(&last).is_break() {
            outcome = StationOutcome::Stopped;
            break;
        }
        if let Some(end) = run.end() {
            outcome = end;
            break;
        }
        run.follow_wear()?;
    }
    Ok(run.finish(outcome, initial, last))
}

impl<'a> Run<'a> {
    /// Applies the load.
    fn start(scene: &'a StationScene) -> Result<Self, StationError> {
        let plane = scene.plane();
        let amplitude_mm = scene.amplitude_mm().ok_or(StationError::Motion)?;
        let built = model::build(&plane, &effects::plan(&plane))?;
        check_slip(scene, &plane, built.sizes.hertz_half_width)?;
        let rate = |wear: Option<SurfaceWear>| wear.and_then(SurfaceWear::uniform).unwrap_or(0.0);
        let rates = built.interface.wear.map(rate);
        let condensed = condensation::condense(&built)?;
        let section = Arc::new(Section {
            model: built,
            condensed,
        });
        let places = places(scene.line, scene.stations);
        let stations = places
            .iter()
            .map(|place| Station::new(*place, &section))
            .collect();
        let line = Line {
            carrier: Carrier {
                top: scene.top,
                force_n: scene.force_n,
                threads: scene.threads,
            },
            stations,
            height: Height::default(),
            slider_x: 0.0,
            work: Work::default(),
        };
        let mut run = Self {
            scene,
            plane,
            amplitude_mm,
            line,
            rates,
            single: Vec::new(),
            done: 0,
            computed: 0,
            relocations: 0,
        };
        run.apply_load()?;
        Ok(run)
    }

    /// Applies the load without sliding. The height under the mean line load is the first one of a rigid top.
    fn apply_load(&mut self) -> Result<(), StationError> {
        let line = &mut self.line;
        if self.scene.top == Top::Rigid {
            let first = &mut line.stations[0];
            first
                .solve(FIRST_LOAD, None, None)
                .map_err(|source| StationError::Contact {
                    cycle: 0,
                    station: 0,
                    halvings: 0,
                    source,
                })?;
            line.height = Height::at(first.attempted_height());
        }
        line.carrier
            .advance(&mut line.stations, &mut line.height, FIRST_LOAD)
            .map_err(|error| self.failure(0, error))?;
        for station in &mut self.line.stations {
            station.loaded();
        }
        let stations = self.line.stations.iter();
        self.single = stations.map(Station::half_width).collect();
        Ok(())
    }

    /// Slides to the turning point where cycles begin, without wear.
    fn initial_quarter(&mut self) -> Result<(), StationError> {
        let count = self.largest(|run, j| {
            let contact = (run.line.stations[j].state.mean_half_width, false);
            increments::count(run.motion(j), &run.plane.accuracy, contact)
        });
        let steps = increments::steps(self.plane.motion, count);
        self.line
            .slide(increments::initial_quarter(&steps), 0.0)
            .map_err(|(halvings, error)| self.failure(halvings, error))
    }

    /// Computes the next cycle, with shorter jumps until it has a solution.
    fn compute_cycle(&mut self) -> Result<StationCycle, StationError> {
        let remaining = self.plane.cycles - self.done;
        let mut jump = remaining;
        for j in 0..self.line.stations.len() {
            let stroke = self.stroke(j);
            let control = &mut self.line.stations[j].state.jump;
            jump = jump.min(control.next(&self.plane.accuracy, stroke, remaining));
        }
        let before = self.snapshot();
        let (paths, work) = (self.paths(), self.line.work);
        loop {
            let cycles = Cycles {
                done: self.done,
                jump,
            };
            let count = self.largest(|run, j| run.increments(j, cycles));
            let steps = increments::steps(self.plane.motion, count);
            let Err((halvings, error)) = self.line.slide(&steps, real_cycles(jump)) else {
                break;
            };
            self.restore(&before);
            if let Some(station) = error.station_to_widen() {
                self.line.stations[station].widen()?;
                self.relocations += 1;
                continue;
            }
            let mut shorter = None;
            for station in &mut self.line.stations {
                shorter = station.state.jump.cut(jump);
            }
            jump = shorter.ok_or_else(|| self.failure(halvings, error))?;
        }
        self.done += jump;
        self.computed += 1;
        for (station, before) in self.line.stations.iter_mut().zip(&before.0) {
            let widths = station.section.condensed.operators.as_ref();
            let widths = widths.map(|body| &body.widths[..]);
            let depths = (before.depth.as_slices(), station.state.depth.as_slices());
            station.state.jump.share(jump);
            station.state.jump.update((widths, 0.0), depths, jump);
        }
        Ok(self.report(jump, &paths, work))
    }

    fn snapshot(&self) -> (Vec<StationState>, Height, f64) {
        let states = self.line.stations.iter();
        let states = states.map(|station| station.state.clone()).collect();
        (states, self.line.height, self.line.slider_x)
    }

    fn restore(&mut self, before: &(Vec<StationState>, Height, f64)) {
        for (station, state) in self.line.stations.iter_mut().zip(&before.0) {
            let jump = std::mem::take(&mut station.state.jump);
            station.state = StationState {
                jump,
                ..state.clone()
            };
        }
        (self.line.height, self.line.slider_x) = (before.1, before.2);
    }

    /// Why the run ends after this cycle, if it does.
    fn end(&self) -> Option<StationOutcome> {
        let stations = self.line.stations.iter().enumerate();
        for (number, station) in stations {
            let depth = station.state.depth.largest_of_each();
            if station.is_worn_through() {
                return Some(StationOutcome::WornThrough { station: number });
            }
            if station.groove_mm() >= self.plane.slider.shape.radius_mm {
                return Some(StationOutcome::DeeperThanRadius { station: number });
            }
            let stop = self.scene.stop_depth_mm;
            if stop.is_some_and(|stop| depth.slider.max(depth.receptacle) >= stop) {
                return Some(StationOutcome::StopDepth);
            }
        }
        None
    }

    fn follow_wear(&mut self) -> Result<(), StationError> {
        for station in &mut self.line.stations {
            let before = Arc::clone(&station.section);
            station.follow_wear(&self.plane.accuracy)?;
            self.relocations += usize::from(!Arc::ptr_eq(&before, &station.section));
        }
        Ok(())
    }

    fn failure(&self, halvings: u32, error: Unsolved) -> StationError {
        let cycle = self.done;
        match error {
            Unsolved::Section { station, source } => StationError::Contact {
                cycle,
                station,
                halvings,
                source,
            },
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

/// Checks that all of the contact slips in each stroke.
fn check_slip(scene: &StationScene, plane: &Scene, half_width: f64) -> Result<(), StationError> {
    let free = Scene {
        effects: scene.section.effects.clone(),
        ..plane.clone()
    };
    if resolution::sticks(&free, half_width) {
        return Err(StationError::Sticks {
            amplitude_mm: plane.motion.amplitude_mm().abs(),
            least_mm: 2.0 * resolution::gross_slip(&free, half_width),
        });
    }
    Ok(())
}
