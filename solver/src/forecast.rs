//! Cost model of a run, before anything is solved: the run's own schedule on a scar of closed form.
//!
//! The number of computed cycles depends on the growth of the scar, so the schedule of the run is applied to a
//! surrogate for the solved scar. With the worn area W = (k_s + k_r) P s of both bodies, the contact leaves a
//! segment of the slider's arc, extended by the part c of the stroke that exceeds the contact:
//!
//!   h(x) = (B^2 - max(a, |x| - c)^2) / (2 R),   c = max(0, A - a),
//!
//! R the radius of the relative curvature, a a little more than the Hertz half-width, B from the integral of h over the
//! receptacle = W. Far from the first cycles this is b = (3 R W / 2)^(1/3) for a short stroke and a groove W/(2 A) deep
//! for a long one. Stick takes from the stroke what the bodies shear before they slip.
//!
//! The contact of a short stroke is nearly as wide as the segment; that of a long one rests on the leading-edge step of
//! one pass, sqrt(2 R k P jump) deep into the floor, to which its half-width adds by a share (`scene::Tuning`).

mod blocks;
mod course;
mod edges;
mod implicit;
mod line;
mod point;
mod surrogate;

use crate::change::Change;
use crate::closed_form::expected_wear::expected_end;
use crate::cycle::positions_of_implicit_jumps;
use crate::model::Layout;
use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::{Accuracy, Scene};
use crate::schedule::jump::JumpControl;
use crate::schedule::mission::MissionPosition;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};
use crate::schedule::stops;
use crate::schedule::stroke::Stroke;
use crate::sides::Sides;

use blocks::{Block, WornBlocks};
pub use course::Course;
use edges::Edges;
use implicit::ImplicitStep;
pub use line::{LineForecast, line_forecast};
pub use point::{PointForecast, point_forecast};
use surrogate::Scar;

/// Computed cycles that are forecast one by one; the rest is extrapolated from the last.
const MOST_SEGMENTS: usize = 5_000;
/// With a fixed jump, one in so many of the computed cycles is forecast together with the next.
const BATCHED_FROM: f64 = 100.0;
/// Cycles times the tolerance that are computed one by one where a cycle reshapes the contact of two bodies that wear. Measured at 2 % on bare copper
/// contacts: 110 to 130 cycles.
const RESHAPED: f64 = 2.4;

/// Increments of about one cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Physical cycles done at its end.
    pub cycle: u64,
    /// Contact increments.
    pub increments: f64,
    /// Increments of one cycle.
    pub steps: usize,
    /// Mean half-width of the contact, mm.
    pub half_width_mm: f64,
    /// Nodes in contact, of the body that carries the constraints.
    pub nodes: usize,
    /// Nodes that the cost of an increment depends on.
    pub solved: usize,
}

/// Numbers of a contact of an implicit jump per pair of its nodes: its inverse, its responses and what they have grown by.
const HELD_OF_PAIR: f64 = 4.0;

/// Estimated work of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Forecast {
    /// Computed cycles.
    pub computed_cycles: f64,
    /// Number of condensations of each body.
    pub condensations: Sides<u32>,
    /// Increments, in order.
    pub segments: Vec<Segment>,
    /// Natural logarithm of the cycles at the end over those at which a layer was worn through to one that wears much faster; 0 where none is, or
    /// where all jumps may be implicit, which its edge does not hold back.
    pub fast_layer: f64,
    /// Numbers that an implicit jump holds for the contacts at all of its positions at once, at most.
    pub held_numbers: f64,
}

impl Forecast {
    /// Contact increments of the whole run.
    pub fn increments(&self) -> f64 {
        self.segments.iter().map(|part| part.increments).sum()
    }

    /// Increments over the cycles of the run.
    pub fn course(&self) -> Course {
        let mut course = Course::default();
        for segment in &self.segments {
            course.add(segment.cycle, segment.increments);
        }
        course
    }
}

/// Forecasts a run of a scene from the layout of its meshes.
pub fn forecast(scene: &Scene, layout: &Layout) -> Forecast {
    let mut worn = WornBlocks::new(scene, layout);
    let mut run = Forecast {
        condensations: Sides {
            slider: 1,
            receptacle: 1,
        },
        ..Forecast::default()
    };
    let x = layout.bodies.of(layout.sizes.slave).contact_x();
    let mut position = MissionPosition::first(scene);
    let (mut cycle, mut is_first) = (0, false);
    let mut edges = Edges::new(scene);
    let are_implicit = implicit::of_blocks(scene);
    while !worn.is_done(scene, position.block, cycle) {
        if MOST_SEGMENTS <= run.segments.len() {
            run.extrapolate(cycle, expected_end(scene));
            break;
        }
        let depth = |side, part| worn.depth_of_part(side, part);
        if scene.mission.is_some() && cycle >= position.until {
            position = position.next(scene, worn.mean_progress(cycle), depth);
            is_first = true;
        }
        let now = worn.progress(position.block, cycle);
        let (until, is_reported) = position.next_reported(scene, stops::next(scene, now, depth));
        let is_implicit = are_implicit[position.block];
        let depths = |side| depth(side, 0.0);
        let at_edge = edges.largest_jump(&scene.accuracy, cycle, is_implicit, depths);
        let Block { scar, jump, motion } = &mut worn.blocks[position.block];
        if is_first {
            scar.change_motion();
        }
        let (accuracy, stroke) = (&scene.accuracy, scar.stroke(scene, cycle));
        let range = StepRange {
            done: cycle,
            until,
            at_edge,
            is_implicit,
        };
        let (implicit, mut step) = next_step(jump, scar, accuracy, stroke, range);
        if is_first && stroke.is_groove {
            // Nothing to extrapolate from.
            step = 1;
        }
        let followed = Followed {
            half_width: scar.half_width,
            single: scar.half_width,
            sticks: scar.sticks,
        };
        let is_last = cycle + step == until;
        let detailed = (is_last && is_reported) || scene.has_stops();
        let cycles = Cycles {
            done: cycle,
            jump: if stroke.is_groove { 1 } else { step },
        };
        let plan = CyclePlan::new(*motion, accuracy, followed, stroke, cycles, detailed);
        let together = batch_size(scene, run.computed_cycles, (until - cycle) / step);
        let before = scar.depth.clone();
        scar.wear(step * together);
        let done = step * together;
        let depth = Change {
            before: before.as_slices(),
            after: scar.depth.as_slices(),
        };
        let solved = solved(x, scar);
        if implicit.is_some() {
            let positions = real(positions_of_implicit_jumps(plan.steps));
            let held = HELD_OF_PAIR * positions * real(solved).powi(2);
            run.held_numbers = run.held_numbers.max(held);
        }
        match implicit {
            Some(implicit) => jump.update_implicit(implicit.wear(scar, &before, done), done),
            None => jump.update(scar.widths(), 0.0, depth, done),
        }
        cycle += done;
        run.computed_cycles += real_cycles(together);
        // A quarter of a cycle from the last motion to the neutral position, and another one from there.
        let changed = if is_first {
            0.5 * real(plan.steps)
        } else {
            0.0
        };
        let increments = edges.increments(is_implicit) * real(plan.increments());
        run.segments.push(Segment {
            cycle,
            increments: real_cycles(together) * increments + changed,
            steps: plan.steps,
            half_width_mm: scar.half_width,
            nodes: nodes_within(x, scar.half_width),
            solved,
        });
        is_first = false;
        worn.rebuild(scene, &mut run.condensations);
    }
    if are_implicit.contains(&false) {
        run.fast_layer = edges.course(cycle);
    }
    run
}

/// Bounds of the next computed cycle or jump.
#[derive(Clone, Copy)]
struct StepRange {
    /// Cycles done, and those that must be hit exactly.
    done: u64,
    until: u64,
    /// The largest jump while the edge of a layer moves.
    at_edge: u64,
    /// True if jumps may be implicit.
    is_implicit: bool,
}

/// The next jump, with its implicit form if it has one.
fn next_step(
    jump: &mut JumpControl,
    scar: &Scar,
    accuracy: &Accuracy,
    stroke: Stroke,
    range: StepRange,
) -> (Option<ImplicitStep>, u64) {
    let remaining = range.until - range.done;
    let is_reshaped =
        stroke.reshapes_both() && real_cycles(range.done) < RESHAPED / accuracy.tolerance;
    let implicit = if range.is_implicit && !stroke.is_groove && !is_reshaped {
        ImplicitStep::next(jump, scar, accuracy, stroke, remaining)
    } else {
        None
    };
    let step = match &implicit {
        Some(implicit) => implicit.jump,
        None => jump.next(accuracy, stroke, remaining),
    };
    let step = match accuracy.cycle_jump {
        Some(_) => step,
        None if is_reshaped => 1,
        None => step.min(range.at_edge),
    };
    (implicit, step)
}

/// Number of computed cycles that are forecast at once. A fixed jump needs no control, and a hundredth of the cycles
/// done changes little.
fn batch_size(scene: &Scene, computed: f64, most: u64) -> u64 {
    if scene.accuracy.cycle_jump.is_some() {
        cycles_at_least((computed / BATCHED_FROM).floor()).clamp(1, most.max(1))
    } else {
        1
    }
}

impl Forecast {
    /// Extrapolates the rest of a long run from its last computed cycle.
    fn extrapolate(&mut self, done: u64, end: u64) {
        let (Some(last), Some(before)) = (
            self.segments.last().copied(),
            self.segments.iter().rev().nth(1),
        ) else {
            return;
        };
        let jump = real_cycles((last.cycle - before.cycle).max(1));
        let end = end.max(done);
        let computed = real_cycles(end - done) / jump;
        self.computed_cycles += computed;
        self.segments.push(Segment {
            cycle: end,
            increments: computed * last.increments,
            ..last
        });
    }
}

/// Nodes that the cost of an increment depends on. Measured: in a sliding contact that stays where it is those in contact, in
/// gross sliding half of the candidates, because the contact lies on one side of the leading-edge step; where it may stick, with
/// two tractions a node and statuses that change, all candidates.
fn solved(x: &[f64], scar: &Scar) -> usize {
    let candidates = nodes_within(x, scar.candidate_half_width());
    if scar.sticks {
        candidates
    } else if scar.is_gross() {
        candidates.div_ceil(2)
    } else {
        nodes_within(x, scar.half_width)
    }
}

/// Nodes of a body that a contact of a half-width in its middle covers.
fn nodes_within(x: &[f64], half_width: f64) -> usize {
    let within = x.partition_point(|&x| x <= half_width) - x.partition_point(|&x| x < -half_width);
    within.max(1)
}

#[cfg(test)]
mod tests;
