//! The cycles of extruded bodies: each computed one stands for a jump.

mod report;

use std::ops::ControlFlow;

use super::bodies::Bodies;
use super::cycle::{Contact, Work};
use super::error::ExtrudedError;
use super::record::{ExtrudedCycle, ExtrudedOutcome, ExtrudedSummary};
use super::scene::ExtrudedScene;
use crate::contact::ContactError;
use crate::law::surface::SurfaceWear;
use crate::model::resolution;
use crate::number::real_cycles;
use crate::scene::Scene;
use crate::schedule::increments;
use crate::schedule::jump::{JumpControl, Stroke};
use crate::schedule::plan::{CyclePlan, Cycles, Followed};
use crate::sides::{Side, Sides};
use crate::{effects, model};

/// A run between two computed cycles.
struct Run<'a> {
    scene: &'a ExtrudedScene,
    plane: Scene,
    bodies: Bodies,
    contact: Contact,
    jump: JumpControl,
    /// Wear rates of both sides, 1/MPa.
    rates: Sides<f64>,
    /// Half-width of the unworn contact, mm.
    single: f64,
    done: u64,
    computed: usize,
    relocations: usize,
}

/// Simulates extruded bodies. Cycles are delivered as they are computed; `Break` ends the run after that cycle.
///
/// # Errors
/// A scene that extruded bodies do not describe, a body that cannot be meshed or condensed, a contact without a solution.
pub fn run(
    scene: &ExtrudedScene,
    mut on_cycle: impl FnMut(&ExtrudedCycle) -> ControlFlow<()>,
) -> Result<ExtrudedSummary, ExtrudedError> {
    scene.check()?;
    let mut run = Run::start(scene)?;
    let initial = run.report(0, &run.paths(), Work::default());
    let mut last = initial.clone();
    let mut outcome = ExtrudedOutcome::Completed;
    if scene.section.cycles > 0 {
        run.initial_quarter()?;
    }
    while run.done < scene.section.cycles {
        last = run.compute_cycle()?;
        if on_cycle(&last).is_break() {
            outcome = ExtrudedOutcome::Stopped;
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
    fn start(scene: &'a ExtrudedScene) -> Result<Self, ExtrudedError> {
        let plane = scene.plane();
        let built = model::build(&plane, &effects::plan(&plane))?;
        if plane.cycles > 0 {
            check_slip(scene, &plane, built.sizes.hertz_half_width)?;
        }
        let interface = built.interface;
        let rate = |wear: Option<SurfaceWear>| wear.and_then(SurfaceWear::uniform).unwrap_or(0.0);
        let bodies = Bodies::new(scene, built)?;
        let mut run = Self {
            scene,
            plane,
            contact: Contact::new(&bodies, &interface),
            bodies,
            jump: JumpControl::default(),
            rates: interface.wear.map(rate),
            single: 0.0,
            done: 0,
            computed: 0,
            relocations: 0,
        };
        run.contact
            .apply_load(&run.bodies)
            .map_err(|source| run.failure(0, source))?;
        run.single = run.contact.mean_half_width;
        Ok(run)
    }

    /// Slides to the turning point where cycles begin, without wear.
    fn initial_quarter(&mut self) -> Result<(), ExtrudedError> {
        let contact = (self.contact.mean_half_width, false);
        let count = increments::count(self.plane.motion, &self.plane.accuracy, contact);
        let steps = increments::steps(self.scene.section.motion, count);
        self.contact
            .slide(&self.bodies, increments::initial_quarter(&steps), 0.0)
            .map_err(|(halvings, error)| self.failure(halvings, error))
    }

    /// Computes the next cycle, with shorter jumps until it has a solution.
    fn compute_cycle(&mut self) -> Result<ExtrudedCycle, ExtrudedError> {
        let remaining = self.plane.cycles - self.done;
        let stroke = self.stroke();
        let mut jump = self.jump.next(&self.plane.accuracy, stroke, remaining);
        let before = self.contact.snapshot();
        let (paths, work) = (self.paths(), self.contact.work);
        loop {
            let cycles = Cycles {
                done: self.done,
                jump,
            };
            let steps =
                increments::steps(self.scene.section.motion, self.increments(stroke, cycles));
            let slid = self.contact.slide(&self.bodies, &steps, real_cycles(jump));
            let Err((halvings, error)) = slid else {
                break;
            };
            self.contact.restore(&before);
            if error.needs_wider_zones() {
                self.bodies.widen()?;
                self.relocations += 1;
                continue;
            }
            let shorter = self.jump.cut(jump);
            jump = shorter.ok_or_else(|| self.failure(halvings, error))?;
        }
        self.done += jump;
        self.computed += 1;
        self.update_jump(&before.0, jump);
        Ok(self.report(jump, &paths, work))
    }

    /// The jump's error is that of the volume: nodes weigh by their width and by the length of their plane.
    fn update_jump(&mut self, before: &[super::cycle::PlaneState], jump: u64) {
        let widths = Sides::from_fn(|side: Side| {
            let widths = &self.bodies.operators.sections.of(side).widths;
            let shares = self.bodies.shares.iter();
            let planes = shares.flat_map(|share| widths.iter().map(move |width| share * width));
            planes.collect::<Vec<f64>>()
        });
        let depths = |states: &[super::cycle::PlaneState]| {
            Sides::from_fn(|side: Side| {
                let planes = states.iter().flat_map(|state| state.depth.of(side));
                planes.copied().collect::<Vec<f64>>()
            })
        };
        let (before, after) = (depths(before), depths(&self.contact.states));
        let depths = (before.as_slices(), after.as_slices());
        self.jump.update((widths.as_slices(), 0.0), depths, jump);
    }

    /// Limits of the jump besides its error. Every jump wears in the increments of one cycle: nothing is extrapolated in a groove.
    fn stroke(&self) -> Stroke {
        let amplitude = self.plane.motion.amplitude_mm().abs();
        let mut stroke = Stroke::new(
            &self.plane.accuracy.tuning,
            self.rates,
            self.contact.interface.modulus,
            (amplitude, self.contact.mean_half_width.max(self.single)),
            (1.0, false),
            self.plane.cycles,
        );
        stroke.is_groove = false;
        stroke
    }

    /// Number of increments of a cycle.
    fn increments(&self, stroke: Stroke, cycles: Cycles) -> usize {
        let followed = Followed {
            half_width: self.contact.mean_half_width,
            single: self.single,
            sticks: false,
        };
        let run = (self.plane.motion, &self.plane.accuracy);
        CyclePlan::new(run, followed, (stroke, cycles), false).steps
    }

    /// Why the run ends after this cycle, if it does.
    fn end(&self) -> Option<ExtrudedOutcome> {
        for (plane, state) in self.contact.states.iter().enumerate() {
            if self.contact.is_worn_through(plane) {
                return Some(ExtrudedOutcome::WornThrough { plane });
            }
            let depth = &state.depth.receptacle;
            let rim = depth.first().zip(depth.last());
            let rim = rim.map_or(0.0, |(first, last)| first.min(*last));
            let largest = state.depth.largest_of_each();
            if largest.receptacle - rim >= self.plane.slider.shape.radius_mm {
                return Some(ExtrudedOutcome::DeeperThanRadius { plane });
            }
            let stop = self.scene.stop_depth_mm;
            if stop.is_some_and(|stop| largest.slider.max(largest.receptacle) >= stop) {
                return Some(ExtrudedOutcome::StopDepth);
            }
        }
        None
    }

    fn follow_wear(&mut self) -> Result<(), ExtrudedError> {
        let depths: Vec<_> = self
            .contact
            .states
            .iter()
            .map(|state| &state.depth)
            .collect();
        let has_moved = self.bodies.follow_wear(&depths, &self.plane.accuracy)?;
        self.relocations += usize::from(has_moved);
        Ok(())
    }

    fn failure(&self, halvings: u32, source: ContactError) -> ExtrudedError {
        ExtrudedError::Contact {
            cycle: self.done,
            halvings,
            source,
        }
    }
}

/// Checks that all of the contact slips in each stroke.
fn check_slip(scene: &ExtrudedScene, plane: &Scene, half_width: f64) -> Result<(), ExtrudedError> {
    let free = Scene {
        effects: scene.section.effects.clone(),
        ..plane.clone()
    };
    if resolution::sticks(&free, half_width) {
        return Err(ExtrudedError::Sticks {
            amplitude_mm: plane.motion.amplitude_mm().abs(),
            least_mm: 2.0 * resolution::gross_slip(&free, half_width),
        });
    }
    Ok(())
}
