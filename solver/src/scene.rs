//! The scene: everything the engine needs to know about a contact system, in engine units.
//!
//! Units: mm, N, MPa. In two dimensions forces are per mm of depth (N/mm). x runs along the sliding
//! direction with its origin at the neutral position, y points up. A scene is plain data, validated
//! where it is created; the engine does not check it again.

mod accuracy;
mod body;
mod criterion;
mod dimension;
mod effect;
mod electrical;
mod heat;
mod missing_input;
mod mission;
mod motion;
mod series;
mod switches;
mod timing;
mod tuning;
mod turning_points;

pub(crate) use accuracy::PRESSURE_TOLERANCES;
pub use accuracy::{Accuracy, Refinement};
pub use body::{BlockShape, Body, SliderShape, SurfaceEffects};
pub use criterion::Criterion;
pub use dimension::{Dimension, Ends, Extruded, Line, LineShape, Point, RingMotion, Top};
pub use effect::Effect;
pub(crate) use electrical::MOST_METALS;
pub use electrical::{Conduction, Electrical, Metal, Spots};
pub(crate) use heat::ContactHeat;
pub use missing_input::{MissingInput, MissingProperty};
pub use mission::{Block, Mission, Order};
pub use motion::Motion;
pub use series::{HIGHEST_ORDER, Series, Term};
pub use switches::Switches;
pub use timing::Timing;
pub(crate) use timing::{Spread, TimedMotion};
pub use tuning::{Power, Tuning};
pub use turning_points::{MOST_TURNS, TurningPoints};

use std::borrow::Cow;

use crate::law::friction::contact::ContactFriction;
use crate::law::pace::Pace;
use crate::law::surface::SurfaceWear;
use crate::sides::{Side, Sides};

pub use crate::law::elastic::Elastic;
pub use crate::law::friction::{Friction, Table};
pub use crate::law::heating::sliding::Conductor;
pub use crate::law::plating::{Layer, MOST_LAYERS};
pub use crate::law::softening::Softening;
pub use crate::law::temperature::Temperature;
pub use crate::law::wear::WearLaw;
pub use crate::law::wear::barwell::{Barwell, Course};
pub use crate::law::wear::load_repetition::LoadRepetition;
pub use crate::law::wear::mechanism::Mechanism;
pub use crate::law::wear::mild_oxidation::MildOxidation;
pub use crate::law::wear::power::PowerLaw;
pub use crate::law::wear::quinn::Quinn;
pub use crate::law::wear::rhee::Rhee;
pub use crate::law::wear::severe_oxidation::SevereOxidation;
pub use crate::law::wear::speed::SpeedLaw;
pub use crate::law::wear::strain_hardening::StrainHardening;
pub use crate::law::wear::surface_state::SurfaceState;

/// A contact system with its loads, motion and numerical settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Which dimensions of the contact are simulated.
    pub dimension: Dimension,
    /// The sprung or vibrating part, above.
    pub slider: Body<SliderShape>,
    /// The fixed part, below.
    pub receptacle: Body<BlockShape>,
    /// Friction between both; a table by cycle ends with the run.
    pub friction: Friction,
    /// Temperature of the surroundings, °C.
    pub temperature_c: f64,
    /// Normal load on the unworn contact, N per mm of depth; of a point contact that of its middle section, along a line the mean.
    pub load_n_per_mm: f64,
    /// Stiffness of the spring that applies the load, which decreases as the slider sinks, N/mm per mm of depth; 0 for
    /// a dead load.
    pub spring_n_per_mm2: f64,
    /// Boundary conditions of the slider.
    pub drive: Drive,
    /// The imposed relative motion (slider minus receptacle); of a mission its mean cycle, for estimates.
    pub motion: Motion,
    /// Course in time.
    pub timing: Timing,
    /// Number of physical cycles, of all blocks of a mission.
    pub cycles: u64,
    /// Blocks of different motions, if there are several.
    pub mission: Option<Mission>,
    /// Of the scene of a block of a mission: cycles until another block follows.
    pub cycles_at_a_time: Option<u64>,
    /// Mesh and integration settings.
    pub accuracy: Accuracy,
    /// Recorded output.
    pub output: Output,
    /// Criteria that end the run.
    pub stop: Vec<Criterion>,
    /// Criteria whose life is recorded.
    pub life: Vec<Criterion>,
    /// The contact as an electrical conductor.
    pub conduction: Conduction,
    /// Effects that are switched on or off.
    pub effects: Switches,
    /// The scene with other wear coefficients, whose lives are compared with those of this one on coarse settings: where they do not go
    /// with the inverse of the coefficients.
    pub scattered: Vec<Scene>,
    /// Threads that the solve is to keep busy; results do not depend on it.
    pub threads: usize,
}

impl Scene {
    /// Returns `true` if there is friction between the bodies.
    pub(crate) fn has_friction(&self) -> bool {
        self.largest_friction() > 0.0
    }

    /// Largest coefficient of friction that the run can meet, -.
    pub fn largest_friction(&self) -> f64 {
        self.friction.largest()
    }

    /// The scene of each block of its mission, with the motion of that block and as many cycles as it has in the whole mission;
    /// itself without a mission.
    pub(crate) fn blocks(&self) -> Vec<Cow<'_, Self>> {
        let Some(mission) = &self.mission else {
            return vec![Cow::Borrowed(self)];
        };
        let blocks = mission.blocks.iter().map(|block| {
            Cow::Owned(Self {
                motion: block.motion,
                timing: block.timing.clone(),
                cycles: block.cycles.saturating_mul(mission.repeat),
                mission: None,
                cycles_at_a_time: Some(mission.cycles_at_a_time(block)),
                ..self.clone()
            })
        });
        blocks.collect()
    }

    /// Takes the motion of a block of its mission.
    pub(crate) fn take_motion(&mut self, block: &Self) {
        self.motion = block.motion;
        self.timing = block.timing.clone();
        self.cycles = block.cycles;
        self.mission.clone_from(&block.mission);
        self.cycles_at_a_time = block.cycles_at_a_time;
    }

    /// Imposed sliding distance, mm, and time, s, after a number of physical cycles; no time of a continuous motion.
    pub fn elapsed(&self, cycles: f64) -> (f64, Option<f64>) {
        match &self.mission {
            Some(mission) => {
                let (distance, time) = mission.elapsed(cycles);
                (distance, Some(time))
            }
            None => (
                cycles * self.motion.distance_per_cycle_mm(),
                self.motion.period_s().map(|period| cycles * period),
            ),
        }
    }

    /// Largest amplitude of the contact's motion over the receptacle, mm.
    pub fn largest_amplitude_mm(&self) -> f64 {
        let blocks = self.mission.iter().flat_map(|mission| &mission.blocks);
        let amplitudes = blocks.map(|block| block.motion.amplitude_mm().abs());
        amplitudes.fold(self.motion.amplitude_mm(), f64::max)
    }

    /// Mean speed of the imposed motion, mm/s.
    pub fn mean_speed_mm_s(&self) -> f64 {
        self.timed_motion().mean().speed()
    }

    /// Largest speed, mm/s.
    pub fn fastest_speed_mm_s(&self) -> f64 {
        self.timed_motion().fastest().speed()
    }

    /// The motion with its course in time.
    pub(crate) fn timed_motion(&self) -> TimedMotion {
        TimedMotion::new(self.motion, &self.timing)
    }

    /// Returns `true` if a run may end before its last cycle by a condition of the user.
    pub(crate) fn has_stops(&self) -> bool {
        let conduction = self.conduction.known();
        let limited = conduction.is_some_and(|electrical| !electrical.stop_mohm.is_empty());
        limited || !self.stop.is_empty()
    }

    /// Layers of a side, from the surface down.
    pub fn plating(&self, side: Side) -> &[Layer] {
        match side {
            Side::Slider => &self.slider.plating,
            Side::Receptacle => &self.receptacle.plating,
        }
    }

    /// Friction of the contact whose surfaces wear in this way, through the layers of their platings or by the outermost one alone.
    pub(crate) fn contact_friction(
        &self,
        wear: &Sides<Option<SurfaceWear>>,
        layered: bool,
    ) -> ContactFriction {
        let platings = Sides::from_fn(|side| self.plating(side));
        ContactFriction::new(&self.friction, wear, layered.then_some(platings))
    }

    /// Wear of both surfaces over a cycle with the effects that are switched off left out: a law of speed as its mean rate.
    pub fn surface_wear(&self) -> Sides<Option<SurfaceWear>> {
        let motion = self.timed_motion();
        let wear = self.surface_wear_at(motion.constant());
        wear.map(|wear| wear.map(|wear| motion.mean_wear(wear)))
    }

    /// The same for a contact that wears by the dose in all of its motions: a law of speed has another rate in each block of a mission.
    pub fn surface_wear_of_all_motions(&self) -> Sides<Option<SurfaceWear>> {
        if self.mission.is_some() {
            self.surface_wear_at(None)
        } else {
            self.surface_wear()
        }
    }

    /// Wear of both surfaces with the effects that are switched off left out, at a pace if one is given.
    pub(crate) fn surface_wear_at(&self, pace: Option<Pace>) -> Sides<Option<SurfaceWear>> {
        let is_on = |effect| self.effects.of(effect) != Some(false);
        let on = SurfaceEffects {
            plating: is_on(Effect::Plating),
            softening: is_on(Effect::ThermalSoftening),
        };
        let (slider, receptacle) = (&self.slider, &self.receptacle);
        Sides {
            slider: slider
                .surface_wear(on, pace)
                .filter(|_| is_on(Effect::SliderWear)),
            receptacle: receptacle
                .surface_wear(on, pace)
                .filter(|_| is_on(Effect::ReceptacleWear)),
        }
    }
}

/// Boundary conditions of the slider: load and motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// The top face is rigid: it does not rotate, the load acts on it, and it moves relative to the block. Which of the
    /// two is fixed makes no difference to the quasi-static contact.
    Handle,
    /// The thesis' drive: `u_x` of every slider node prescribed, `u_y` free, pressure on the top face.
    WholeBody,
}

/// Recorded output.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Positions on the receptacle whose worn depth is recorded, mm.
    pub stations_mm: Vec<f64>,
    /// Cycles at which profile, pressure and loop are recorded, ascending.
    pub snapshots_at_cycles: Vec<u64>,
    /// True if snapshots hold displacement and stress inside the bodies.
    pub fields: bool,
}
