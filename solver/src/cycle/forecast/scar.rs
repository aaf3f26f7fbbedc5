//! The stand-in for the worn surfaces: a scar of closed form that grows with the worn area.

use super::super::RUNS_FROM;
use super::super::jump::Stroke;
use crate::contact::WATCHED;
use crate::material::contact_modulus;
use crate::model::{Layout, resolution};
use crate::number::{cycles_at_least, real, real_cycles};
use crate::scene::{Scene, StopCondition};
use crate::{ale, friction, wear};

/// Places of the stand-in, from the middle to the end.
const PLACES: usize = 240;
/// Places of the contact in its stroke, over the carried amplitude.
const PASSES: [f64; 5] = [-0.8, -0.4, 0.0, 0.4, 0.8];
/// The end of the scar is found to this part of it, in so many steps at most; few are needed.
const PRECISION: f64 = 1e-9;
const MOST_ITERATIONS: usize = 50;
/// What the stand-in's a is of the Hertz half-width: elastic pressures change more slowly than those of a rigid segment.
/// Measured on `mccoll.json` and `cylinder_on_flat`: with 1.3 the error of a jump agrees within a fifth from the 50th cycle
/// on, with 1 it is two and a half times too large at first.
const ELASTIC: f64 = 1.3;
/// Share of the squared front of a pass in the squared half-width of a contact that runs. Measured on all systems at
/// tolerances of 10 and 2 %, jumps of 1 to 300 cycles: 0.27 to 0.47.
const FRONT_SHARE: f64 = 0.42;

/// Depth of a scar times 2 R.
fn shape(x: f64, drawn: f64, flat: f64, reach: f64) -> f64 {
    let beyond = (x - drawn).max(flat);
    (reach.powi(2) - beyond.powi(2)).max(0.0)
}

/// The stand-in for the worn surfaces, half of it: it is symmetric.
pub(super) struct Scar {
    /// Radius of the relative curvature, Hertz half-width, amplitude, mm.
    radius: f64,
    hertz: f64,
    /// a of the stand-in, mm.
    flat: f64,
    pub(super) amplitude: f64,
    /// Approach of the bodies under the load, mm.
    approach: f64,
    /// (k_s + k_r) E*, -, and worn area a cycle, mm^2.
    stiff_wear: f64,
    pub(super) area_per_cycle: f64,
    /// (k_s + k_r) P, mm: what one full pass digs.
    pass: f64,
    /// What part of the depth is the slider's and the receptacle's.
    shares: [f64; 2],
    /// Heights of the slider and the receptacle when their operators were built, and at the beginning, mm.
    built: [f64; 2],
    heights: [f64; 2],
    pub(super) area: f64,
    x: Vec<f64>,
    pub(super) widths: Vec<f64>,
    /// Depth of the receptacle, and the largest one of both bodies together, mm.
    pub(super) depth: Vec<f64>,
    deepest: f64,
    /// Half-width of the contact and of the scar beyond the stroke, mm.
    pub(super) half_width: f64,
    reach: f64,
}

impl Scar {
    pub(super) fn new(scene: &Scene, layout: &Layout) -> Self {
        let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
        let slider = wear::coefficient(scene.slider.wear);
        let receptacle = wear::coefficient(scene.receptacle.wear);
        let wear = slider + receptacle;
        let hertz = layout.sizes.hertz_half_width;
        let approach = resolution::approach(scene, hertz, modulus);
        let amplitude = scene.motion.amplitude_mm();
        let sliding = if amplitude > 0.0 {
            let sheared = friction::coefficient(scene.friction) * approach;
            4.0 * (amplitude - sheared).max(0.0)
        } else {
            scene.motion.distance_per_cycle_mm()
        };
        let half_block = 0.5 * scene.receptacle.shape.length_mm;
        let end = (amplitude + 1.5 * layout.sizes.final_half_width + hertz).min(half_block);
        let width = end / real(PLACES);
        let share = |k: f64| if wear > 0.0 { k / wear } else { 0.0 };
        let heights = [
            scene.slider.shape.height_mm,
            scene.receptacle.shape.height_mm,
        ];
        Self {
            radius: resolution::radius(scene),
            hertz,
            flat: ELASTIC * hertz,
            amplitude,
            approach,
            stiff_wear: wear * modulus,
            area_per_cycle: wear * scene.load_n_per_mm * sliding,
            pass: wear * scene.load_n_per_mm,
            shares: [share(slider), share(receptacle)],
            built: heights,
            heights,
            area: 0.0,
            x: (0..PLACES).map(|i| width * (real(i) + 0.5)).collect(),
            widths: vec![width; PLACES],
            depth: vec![0.0; PLACES],
            deepest: 0.0,
            half_width: hertz,
            reach: ELASTIC * hertz,
        }
    }

    pub(super) fn stroke(&self, scene: &Scene) -> Stroke {
        Stroke {
            runs: self.stroke_runs(),
            lean: self.stiff_wear * 2.0 * self.amplitude / self.half_width,
            cycles: scene.cycles,
        }
    }

    /// Wears `jump` cycles more, so many times.
    pub(super) fn wear(&mut self, jump: u64, times: u64) {
        self.area += self.area_per_cycle * real_cycles(jump * times);
        self.grow();
        let drawn = (self.amplitude - self.flat).max(0.0);
        // The rest of the stroke carries the contact to and fro over the scar, which smears its growing edges.
        let carried = self.amplitude.min(self.flat);
        for (depth, x) in self.depth.iter_mut().zip(&self.x) {
            let places = PASSES.map(|pass| (x + pass * carried).abs());
            let sum: f64 = places
                .iter()
                .map(|&x| shape(x, drawn, self.flat, self.reach))
                .sum();
            *depth = self.shares[1] * sum / (2.0 * self.radius * real(PASSES.len()));
        }
        self.deepest = self.depth_at(0.0, drawn);
        self.half_width = self.contact(jump);
    }

    /// Depth of both bodies together, not smeared.
    fn depth_at(&self, x: f64, drawn: f64) -> f64 {
        shape(x, drawn, self.flat, self.reach) / (2.0 * self.radius)
    }

    /// Moves the end of the scar to where it holds the worn area: Newton's method on a convex function.
    fn grow(&mut self) {
        let drawn = (self.amplitude - self.flat).max(0.0);
        for _ in 0..MOST_ITERATIONS {
            let (mut held, mut places) = (0.0, 0.0);
            for depth in self.x.iter().map(|&x| self.depth_at(x, drawn)) {
                held += depth;
                places += f64::from(u8::from(depth > 0.0));
            }
            let width = 2.0 * self.widths[0];
            let slope = width * f64::max(places, 1.0) * self.reach / self.radius;
            let step = (self.area - width * held) / slope;
            self.reach += step;
            if step.abs() <= PRECISION * self.reach {
                break;
            }
        }
    }

    /// Half-width of the contact after a jump: between that of a running one and all of the segment.
    pub(super) fn contact(&self, jump: u64) -> f64 {
        let front = 2.0 * self.radius * self.pass * real_cycles(jump);
        let running = self.hertz.hypot((FRONT_SHARE * front).sqrt());
        let runs = (self.amplitude / running - 1.0).clamp(0.0, 1.0);
        running.powf(runs) * (self.reach / ELASTIC).max(running).powf(1.0 - runs)
    }

    /// Half-width within which the gap is below what `contact::range` watches.
    pub(super) fn watched(&self) -> f64 {
        let gap = (1.0 + WATCHED) * self.approach;
        let flat = if self.stroke_runs() {
            self.half_width
        } else {
            self.reach
        };
        flat.hypot((2.0 * self.radius * gap).sqrt())
    }

    pub(super) fn stroke_runs(&self) -> bool {
        self.amplitude > RUNS_FROM * self.half_width
    }

    /// The next cycle that the run stops at: `run::next_stop` on the stand-in.
    pub(super) fn next_stop(&self, scene: &Scene, cycle: u64, rate: f64) -> u64 {
        let snapshots = &scene.output.snapshots_at_cycles;
        let next = snapshots.iter().copied().find(|&at| at > cycle);
        let worn = self.shares[0].max(self.shares[1]) * self.deepest;
        let left = (0..2).map(|side| self.heights[side] - self.shares[side] * self.deepest);
        let limits = scene
            .stop
            .iter()
            .map(|StopCondition::WornDepth(limit)| limit - worn);
        let left = left.chain(limits).fold(f64::INFINITY, f64::min);
        let reach = cycles_at_least((left / rate.max(f64::MIN_POSITIVE)).floor());
        next.unwrap_or(scene.cycles)
            .min(scene.cycles)
            .min(cycle.saturating_add(reach))
    }

    /// Whether a stop condition holds or a body is worn through.
    pub(super) fn ends(&self, scene: &Scene) -> bool {
        let depths = self.shares.map(|share| share * self.deepest);
        let mut stop = scene.stop.iter();
        let stopped = stop.any(|StopCondition::WornDepth(limit)| depths.iter().any(|d| d >= limit));
        let through =
            |side: usize| 1.0 - depths[side] / self.heights[side] < ale::WORN_THROUGH_SHARE;
        stopped || through(0) || through(1)
    }

    /// Counts a condensation of the bodies that have changed where one has drifted.
    pub(super) fn rebuild(&mut self, scene: &Scene, condensations: &mut [u32; 2]) {
        let now = [0, 1].map(|side| self.heights[side] - self.shares[side] * self.deepest);
        let share = ale::drift_share(scene.accuracy.tolerance);
        let drifted = |side: usize| self.built[side] - now[side] > share * self.built[side];
        if drifted(0) || drifted(1) {
            for (count, (now, built)) in condensations.iter_mut().zip(now.iter().zip(&self.built)) {
                *count += u32::from(now < built);
            }
            self.built = now;
        }
    }
}
