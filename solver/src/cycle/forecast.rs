//! What a run will take, before anything is solved: the integrator's own rules on a scar of closed form.
//!
//! How many cycles are computed depends on how the scar grows, so the jump control and the rule of the increments are
//! run on a stand-in for the solved scar. With the worn area W = (k_s + k_r) P s of both bodies, the contact leaves a
//! segment of the slider's arc behind, drawn along by the part c of the stroke that exceeds the contact:
//!
//!   h(x) = (B^2 - max(a, |x| - c)^2) / (2 R),   c = max(0, A - a),
//!
//! R the radius of the relative curvature, a a little more than the Hertz half-width, B from the integral of h over the receptacle = W. Far
//! from the first cycles this is b = (3 R W / 2)^(1/3) for a short stroke and a groove W/(2 A) deep for a long one.
//! Stick takes from the stroke what the bodies shear before they slip.
//!
//! The contact of a short stroke is nearly as wide as the segment; that of a long one carries the step that one pass digs in
//! front of it, sqrt(2 R k P jump) deep into the floor, to which its half-width adds by a measured share.

mod scar;

use super::jump::JumpControl;
use super::path;
use super::probe::Probes;
use crate::model::Layout;
use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::Scene;

use scar::Scar;

/// Computed cycles that are followed one by one; the rest goes on like the last of them.
const MOST_FOLLOWED: usize = 5_000;
/// Of so many computed cycles with a fixed jump the next one is like the last.
const ALIKE: f64 = 100.0;

/// Increments of about one kind.
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
    /// Nodes of the receptacle in contact.
    pub nodes: usize,
    /// Nodes of the receptacle that are watched because they might touch.
    pub watched: usize,
}

/// What a run will take.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Forecast {
    /// Computed cycles.
    pub computed_cycles: f64,
    /// How often each body is condensed: slider, receptacle.
    pub condensations: [u32; 2],
    /// Its increments, in order.
    pub segments: Vec<Segment>,
}

impl Forecast {
    /// Contact increments of the whole run.
    pub fn increments(&self) -> f64 {
        self.segments.iter().map(|part| part.increments).sum()
    }
}

/// Forecasts a run of a scene from the layout of its meshes.
pub fn forecast(scene: &Scene, layout: &Layout) -> Forecast {
    let mut scar = Scar::new(scene, layout);
    let mut run = Forecast {
        condensations: [1, 1],
        ..Forecast::default()
    };
    let mut jump = JumpControl::default();
    let mut cycle = 0;
    while cycle < scene.cycles && !scar.ends(scene) {
        if MOST_FOLLOWED <= run.segments.len() {
            run.go_on(cycle, scene.cycles);
            break;
        }
        let until = scar.next_stop(scene, cycle, jump.fastest_rate());
        let step = jump.next(&scene.accuracy, scar.stroke(scene), until - cycle);
        let followed = path::followed(scar.half_width, scar.contact(1));
        let steps = path::count(scene.motion, &scene.accuracy, followed);
        let probes = if scar.stroke_runs() && step > 1 {
            let length = 4.0 * scar.amplitude / real(steps);
            let (tolerance, single) = (scene.accuracy.tolerance, scar.contact(1));
            Probes::of((steps, length), tolerance, scar.half_width, single).increments()
        } else {
            0
        };
        let together = alike(scene, run.computed_cycles, (until - cycle) / step);
        let before = scar.depth.clone();
        scar.wear(step, together);
        let done = step * together;
        jump.learn(&scar.widths, &before, &scar.depth, done);
        cycle += done;
        run.computed_cycles += real_cycles(together);
        run.segments.push(Segment {
            cycle,
            increments: real_cycles(together) * real(steps + probes),
            steps,
            half_width_mm: scar.half_width,
            nodes: nodes_within(layout, scar.half_width),
            watched: nodes_within(layout, scar.watched()),
        });
        scar.rebuild(scene, &mut run.condensations);
    }
    run
}

/// How many computed cycles are foreseen at once. A fixed jump needs no control, and a hundredth of what was computed
/// changes little.
fn alike(scene: &Scene, computed: f64, most: u64) -> u64 {
    if scene.accuracy.cycle_jump.is_some() {
        cycles_at_least((computed / ALIKE).floor()).clamp(1, most.max(1))
    } else {
        1
    }
}

impl Forecast {
    /// The rest of a long run goes on like its last computed cycle.
    fn go_on(&mut self, done: u64, cycles: u64) {
        let (Some(last), Some(before)) = (
            self.segments.last().copied(),
            self.segments.iter().rev().nth(1),
        ) else {
            return;
        };
        let jump = real_cycles((last.cycle - before.cycle).max(1));
        let computed = real_cycles(cycles - done) / jump;
        self.computed_cycles += computed;
        self.segments.push(Segment {
            cycle: cycles,
            increments: computed * last.increments,
            ..last
        });
    }
}

/// Nodes of the receptacle that a contact of a half-width covers.
fn nodes_within(layout: &Layout, half_width: f64) -> usize {
    let x = layout.receptacle.contact_x();
    let within = x.partition_point(|&x| x <= half_width) - x.partition_point(|&x| x < -half_width);
    within.max(1)
}

#[cfg(test)]
mod tests;
