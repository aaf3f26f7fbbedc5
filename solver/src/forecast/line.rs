//! Cost model of the run of a contact along a line: the run's schedule on the surrogate scars of a few of its sections.
//!
//! Under a rigid top the line load of a ring is (pi/2) (F/L) cos(theta) where the contact leaves its own width, and about
//! half of the mean where it does not; elsewhere it is the mean. A section wears by the whole path, also along the line.
//!
//! Extruded bodies follow one section, whose increments are solved for the nodes of all planes together.

use super::course::Course;
use super::edges::Edges;
use super::solved;
use super::surrogate::Scar;
use crate::change::Change;
use crate::closed_form::expected_wear;
use crate::extruded::ExtrudedScene;
use crate::model::Layout;
use crate::number::{real, real_cycles};
use crate::scene::{Dimension, LineShape, Motion, RingMotion, Scene, Top};
use crate::schedule::jump::JumpControl;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};
use crate::schedule::stops::{self, StopQuantities};
use crate::sides::{Side, Sides};
use crate::station::StationScene;

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

/// A followed section.
struct Section {
    scar: Scar,
    jump: JumpControl,
    motion: Motion,
    /// Depths at which its operators were built, mm.
    built: Sides<f64>,
    heights: Sides<f64>,
}

/// Forecasts a run of a scene from the layout of its section; `None` for one that is not along a line.
pub fn line_forecast(scene: &Scene, layout: &Layout) -> Option<LineForecast> {
    if let Some(line) = StationScene::of(scene) {
        let scene = &Scene {
            accuracy: line.plane().accuracy,
            ..scene.clone()
        };
        let sections = followed(scene, &line, layout);
        let share = real(touching(scene, &line)) / real(sections.len());
        let each = match line.top {
            Top::Rigid | Top::Pressure => RIGID_SOLVES,
            Top::Even => 1.0,
        };
        let solves = SolveCounts {
            each: share * each,
            share,
            planes: 1,
        };
        return Some(forecast(scene, layout, sections, line.stations, solves));
    }
    let extruded = ExtrudedScene::of(scene)?;
    let planes = extruded.node_planes();
    let section = Section::new(scene, layout, scene.motion, 1.0);
    let solves = SolveCounts {
        each: EXTRUDED_SOLVES,
        share: 1.0,
        planes,
    };
    Some(forecast(scene, layout, vec![section], planes, solves))
}

/// Forecasts a run of followed sections, of so many stations.
fn forecast(
    scene: &Scene,
    layout: &Layout,
    mut sections: Vec<Section>,
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
    let (mut cycle, mut last) = (0, 1);
    let mut edges = Edges::new(scene);
    while stops::end(scene, progress(&sections, cycle), |side, part| {
        deepest(&sections, side, part)
    })
    .is_none()
        && !is_too_deep(scene, &sections)
    {
        if forecast.solves.len() / sections.len() >= MOST_CYCLES {
            let end = expected_wear::expected_end(scene).max(cycle);
            forecast.extrapolate(cycle, end, last, sections.len());
            break;
        }
        let now = progress(&sections, cycle);
        let until = stops::next(scene, now, |side, part| deepest(&sections, side, part));
        let mut jump = until - cycle;
        for section in &mut sections {
            let mut stroke = section.scar.stroke(scene, cycle);
            stroke.is_groove = false;
            let next = section.jump.next(&scene.accuracy, stroke, until - cycle);
            jump = jump.min(next);
        }
        if scene.accuracy.cycle_jump.is_none() {
            let depth = |side| deepest(&sections, side, 0.0);
            jump = jump.min(edges.largest_jump(&scene.accuracy, cycle, depth));
        }
        let cycles = Cycles { done: cycle, jump };
        let increments = increments(scene, &sections, cycles);
        for section in &mut sections {
            section.wear(jump);
        }
        cycle += jump;
        last = jump;
        forecast.computed_cycles += 1.0;
        forecast.course.add(cycle, real(increments));
        forecast.most_increments = forecast.most_increments.max(increments);
        for section in &mut sections {
            let nodes = solves.planes * solved(x, &section.scar);
            forecast
                .solves
                .push((nodes, solves.each * real(increments)));
            section.rebuild(scene, solves.share, &mut forecast.condensations);
        }
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

/// The followed sections.
fn followed(scene: &Scene, line: &StationScene, layout: &Layout) -> Vec<Section> {
    let angles: &[f64] = match line.line {
        LineShape::Ring {
            motion: RingMotion::InPlane,
            ..
        } => &ANGLES,
        LineShape::Ring { .. } => &ANGLES[2..],
        LineShape::Straight { .. } => &ANGLES[..1],
    };
    let is_rigid_ring = angles.len() > 1 && line.top == Top::Rigid;
    let leading = leading_load(scene, line);
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

impl Section {
    /// A section in a motion under its line load over the mean one.
    fn new(scene: &Scene, layout: &Layout, motion: Motion, load: f64) -> Self {
        let own = Scene {
            dimension: Dimension::PlaneStrain,
            load_n_per_mm: load * scene.load_n_per_mm,
            motion,
            ..scene.clone()
        };
        Self {
            scar: Scar::new(&own, layout, false),
            jump: JumpControl::default(),
            motion,
            built: Sides::default(),
            heights: Sides {
                slider: scene.slider.shape.height_mm,
                receptacle: scene.receptacle.shape.height_mm,
            },
        }
    }

    fn wear(&mut self, jump: u64) {
        let before = self.scar.depth.clone();
        self.scar.wear(jump);
        let depth = Change {
            before: before.as_slices(),
            after: self.scar.depth.as_slices(),
        };
        self.jump.share(jump);
        self.jump.update(self.scar.widths(), 0.0, depth, jump);
    }

    /// Counts a condensation of the bodies that have changed where one has drifted, for so many sections.
    fn rebuild(&mut self, scene: &Scene, share: f64, condensations: &mut Sides<f64>) {
        let drift = scene.accuracy.drift_share();
        let drifted = |side: Side| {
            let (now, built) = (self.scar.deepest.of(side), self.built.of(side));
            now - built > drift * (self.heights.of(side) - built)
        };
        if Side::BOTH.into_iter().any(drifted) {
            self.built = self.scar.deepest;
            for side in Side::BOTH {
                *condensations.of_mut(side) += share;
            }
        }
    }
}

/// Increments of a cycle: those of the section that needs most.
fn increments(scene: &Scene, sections: &[Section], cycles: Cycles) -> usize {
    let of_section = |section: &Section| {
        let mut stroke = section.scar.stroke(scene, cycles.done);
        stroke.is_groove = false;
        let followed = Followed {
            half_width: section.scar.half_width,
            single: section.scar.half_width,
            sticks: false,
        };
        let (motion, accuracy) = (section.motion, &scene.accuracy);
        CyclePlan::new(motion, accuracy, followed, stroke, cycles, false).increments()
    };
    sections.iter().map(of_section).fold(1, usize::max)
}

/// Depth that a part of the scar has at least, of the deepest section, mm.
fn deepest(sections: &[Section], side: Side, part: f64) -> f64 {
    let depths = sections
        .iter()
        .map(|section| section.scar.depth_of_part(side, part));
    depths.fold(0.0, f64::max)
}

/// Returns `true` if the groove of a section is as deep as the slider's radius.
fn is_too_deep(scene: &Scene, sections: &[Section]) -> bool {
    deepest(sections, Side::Receptacle, 0.0) >= scene.slider.shape.radius_mm
}

fn progress(sections: &[Section], cycle: u64) -> StopQuantities {
    let rates = sections.iter().map(|section| section.jump.fastest_rate());
    let fastest_rate = rates.fold(Sides::default(), |most: Sides<f64>, rate| {
        most.zip(rate).map(|(most, rate)| most.max(rate))
    });
    StopQuantities {
        cycle,
        cycles_left: f64::INFINITY,
        fastest_rate,
        worn_through: false,
        exceeds_resistance: false,
    }
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
