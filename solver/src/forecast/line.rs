//! Cost model of the run of a contact along a line: the run's schedule on the surrogate scars of a few of its sections.
//!
//! Under a rigid top the line load of a ring is (pi/2) (F/L) cos(theta) where the contact leaves its own width, and about
//! half of the mean where it does not; elsewhere it is the mean. A section wears by the whole path, also along the line.
//!
//! A mission has a scar of its own for each block in each section, whose depths add up (`worn`). Extruded bodies follow one section, whose increments are solved for the nodes of all planes together.

mod worn;

use super::course::Course;
use super::edges::Edges;
use super::solved;
use super::surrogate::Scar;
use crate::closed_form::expected_wear;
use crate::extruded::ExtrudedScene;
use crate::model::Layout;
use crate::number::{real, real_cycles};
use crate::scene::{LineShape, Motion, RingMotion, Scene, Top};
use crate::schedule::mission::MissionPosition;
use crate::schedule::plan::Cycles;
use crate::schedule::stops;
use crate::sides::Sides;
use crate::station::StationScene;
use worn::{Section, WornLine};

/// Computed cycles that are forecast one by one; the rest is extrapolated from the last.
const MOST_CYCLES: usize = 1_000;
/// Angles of the sections of a ring that are followed, degrees.
const ANGLES: [f64; 3] = [0.0, 45.0, 90.0];
/// Line load at 90 degrees of a rigid ring over the mean. Measured on the thesis' ring: 0.3 to 0.7.
const BESIDE: f64 = 0.5;
/// Iterations for the common height of a rigid top, as solves of a section alone. Measured: 3.6 iterations, most of them from the
/// last one's contact.
const RIGID_SOLVES: f64 = 2.2;
/// Iterations for the nodes of all planes, as solves of a plane contact of so many nodes. Measured: 1.8 to 4 iterations.
const EXTRUDED_SOLVES: f64 = 2.0;

/// Estimated work of the run of a contact along a line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LineForecast {
    /// Computed cycles.
    pub computed_cycles: f64,
    /// Most increments of a cycle.
    pub most_increments: usize,
    /// Nodes that sections are solved for, with the number of such solves.
    pub solves: Vec<(usize, f64)>,
    /// Condensations of sections of each body.
    pub condensations: Sides<f64>,
    /// Sections.
    pub stations: usize,
    /// Node planes that are condensed together: 1 of sections that only their forces couple.
    pub planes: usize,
    /// Increments over the cycles of the run.
    pub course: Course,
    /// Natural logarithm of the cycles at the end over those at which a layer was worn through to one that wears much faster; 0 where none is.
    pub fast_layer: f64,
}

/// Counts of solves and condensations, and the nodes that are solved for together.
#[derive(Debug, Clone, Copy)]
struct SolveCounts {
    /// Solves of an increment for each followed section.
    each: f64,
    /// Condensations for each followed section.
    share: f64,
    /// Node planes whose nodes are solved for together.
    planes: usize,
}

/// Forecasts a run of a scene from the layout of its section; `None` for one that is not along a line.
pub fn line_forecast(scene: &Scene, layout: &Layout) -> Option<LineForecast> {
    if let Some(line) = StationScene::of(scene) {
        let scene = &Scene {
            accuracy: line.plane().accuracy,
            ..scene.clone()
        };
        let leading = leading_load(scene, &line);
        let blocks = scene.blocks().into_iter();
        let blocks = blocks.map(|block| followed(&block, &line, layout, leading));
        let worn = WornLine::new(scene, blocks.collect());
        let share = real(touching(scene, &line)) / real(worn.sections());
        let each = match line.top {
            Top::Rigid | Top::Pressure => RIGID_SOLVES,
            Top::Even => 1.0,
        };
        let solves = SolveCounts {
            each: share * each,
            share,
            planes: 1,
        };
        return Some(forecast(scene, layout, worn, line.stations, solves));
    }
    let extruded = ExtrudedScene::of(scene)?;
    let planes = extruded.node_planes();
    let blocks = scene.blocks().into_iter();
    let blocks = blocks.map(|block| vec![Section::new(&block, layout, block.motion, 1.0)]);
    let worn = WornLine::new(scene, blocks.collect());
    let solves = SolveCounts {
        each: EXTRUDED_SOLVES,
        share: 1.0,
        planes,
    };
    Some(forecast(scene, layout, worn, planes, solves))
}

/// Forecasts a run of followed sections, of so many stations.
fn forecast(
    scene: &Scene,
    layout: &Layout,
    mut worn: WornLine,
    stations: usize,
    solves: SolveCounts,
) -> LineForecast {
    let x = layout.bodies.of(layout.sizes.slave).contact_x();
    let mut forecast = LineForecast {
        stations,
        planes: solves.planes,
        condensations: Sides {
            slider: 1.0,
            receptacle: 1.0,
        },
        ..LineForecast::default()
    };
    let mut position = MissionPosition::first(scene);
    let (mut cycle, mut last, mut is_first) = (0, 1, false);
    let mut edges = Edges::new(scene);
    while !worn.is_done(scene, position.block, cycle) {
        if forecast.solves.len() / worn.sections() >= MOST_CYCLES {
            let end = expected_wear::expected_end(scene).max(cycle);
            forecast.extrapolate(cycle, end, last, worn.sections());
            break;
        }
        if scene.mission.is_some() && cycle >= position.until {
            let depth = |side, part| worn.deepest(side, part);
            position = position.next(scene, worn.mean_progress(cycle), depth);
            worn.change_motion(position.block);
            is_first = true;
        }
        let now = worn.progress(position.block, cycle);
        let next = stops::next(scene, now, |side, part| worn.deepest(side, part));
        let (until, _) = position.next_reported(scene, next);
        let mut jump = worn.next_jump(
            scene,
            position.block,
            Cycles {
                done: cycle,
                jump: until - cycle,
            },
        );
        if scene.accuracy.cycle_jump.is_none() {
            let depth = |side| worn.deepest(side, 0.0);
            jump = jump.min(edges.largest_jump(&scene.accuracy, cycle, false, depth));
        }
        let cycles = Cycles { done: cycle, jump };
        let increments = worn.increments(scene, position.block, cycles);
        worn.wear(position.block, jump);
        cycle += jump;
        last = jump;
        // A quarter of a cycle from the last motion to the neutral position, and another one from there.
        let changed = if is_first {
            0.5 * real(increments)
        } else {
            0.0
        };
        is_first = false;
        let taken = real(increments) + changed;
        forecast.computed_cycles += 1.0;
        forecast.course.add(cycle, taken);
        forecast.most_increments = forecast.most_increments.max(increments);
        for scar in worn.scars(position.block) {
            let nodes = solves.planes * solved(x, scar);
            forecast.solves.push((nodes, solves.each * taken));
        }
        worn.rebuild(scene, solves.share, &mut forecast.condensations);
    }
    forecast.fast_layer = edges.course(cycle);
    forecast
}

/// Line load over the mean one of the section that decides on the schedule of a crown, between its contact before and after the run.
fn leading_load(scene: &Scene, line: &StationScene) -> f64 {
    let lengths = expected_wear::crown_half_lengths_mm(scene);
    let length = lengths.map(|(unworn, worn)| (unworn + worn).min(line.line.length_mm()));
    // A load that falls from the middle with the square of the place has 1.5 times its mean there.
    length.map_or(1.0, |length| {
        (1.5 * line.line.length_mm() / length).max(1.0)
    })
}

/// Stations that touch, about, over a run: those of a crown within the mean of its contact before and after it.
fn touching(scene: &Scene, line: &StationScene) -> usize {
    match expected_wear::crown_half_lengths_mm(scene) {
        Some((unworn, worn)) => line.stations_within(0.5 * (unworn + worn)).max(1),
        None => line.stations,
    }
}

/// The followed sections, of which those of a straight line have this load over the mean one.
fn followed(scene: &Scene, line: &StationScene, layout: &Layout, leading: f64) -> Vec<Section> {
    let angles: &[f64] = match line.line {
        LineShape::Ring {
            motion: RingMotion::InPlane,
            ..
        } => &ANGLES,
        LineShape::Ring { .. } => &ANGLES[2..],
        LineShape::Straight { .. } => &ANGLES[..1],
    };
    let is_rigid_ring = angles.len() > 1 && line.top == Top::Rigid;
    let whole = Scar::new(scene, layout, false).area_per_cycle;
    let sections = angles.iter().map(|angle| {
        let (sin, cos) = angle.to_radians().sin_cos();
        let load = match (is_rigid_ring, *angle < 90.0) {
            (false, _) => leading,
            (true, true) => std::f64::consts::FRAC_PI_2 * cos,
            (true, false) => BESIDE,
        };
        let amplitude = scene.motion.amplitude_mm().abs();
        let recedes = match line.line {
            LineShape::Ring {
                radius_mm,
                motion: RingMotion::InPlane,
            } => 0.25 * (amplitude * sin).powi(2) / radius_mm,
            LineShape::Ring { .. } | LineShape::Straight { .. } => 0.0,
        };
        let motion = Motion::Reciprocating {
            amplitude_mm: (amplitude * cos).max(recedes),
            period_s: scene.motion.period_s().unwrap_or(1.0),
        };
        let mut section = Section::new(scene, layout, motion, load);
        section.scar.area_per_cycle = load * whole;
        section
    });
    sections.collect()
}

impl LineForecast {
    /// Extrapolates a long run from the cycles done to its end from its last computed cycle, of a jump.
    fn extrapolate(&mut self, done: u64, end: u64, jump: u64, sections: usize) {
        let computed = real_cycles(end - done) / real_cycles(jump);
        self.computed_cycles += computed;
        let last = self.solves.len().saturating_sub(sections);
        let again: Vec<_> = self.solves[last..].to_vec();
        let increments = again
            .iter()
            .map(|(_, count)| count)
            .fold(0.0, |most, &count| count.max(most));
        self.course.add(end, computed * increments);
        let again = again.into_iter();
        self.solves
            .extend(again.map(|(nodes, count)| (nodes, computed * count)));
    }

    /// Solves of all sections.
    pub fn increments(&self) -> f64 {
        self.solves.iter().map(|(_, count)| count).sum()
    }
}
