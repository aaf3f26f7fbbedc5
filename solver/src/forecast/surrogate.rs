//! Surrogate for the worn surfaces: a scar of closed form that grows with the worn area.
//!
//! In gross sliding a worn slider carries a flat of half-width b_s = (3 R W_s / 2)^(1/3), its worn area W_s cut off its
//! arc, and the contact is at least as wide; in a shorter stroke both sides share one scar.

use crate::closed_form::{expected_wear, unworn_contact};
use crate::contact::line::CANDIDATE_GAP;
use crate::law::elastic::contact_modulus;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::model::Layout;
use crate::number::{real, real_cycles};
use crate::record::{Exposed, WornSurface};
use crate::scene::{Motion, Scene, Tuning};
use crate::schedule::stroke::{Movement, Stroke};
use crate::sides::{Side, Sides};

/// Points of the surrogate, from the middle to the end.
const PLACES: usize = 240;
/// Positions of the contact in its stroke, over the smearing amplitude.
const PASSES: [f64; 5] = [-0.8, -0.4, 0.0, 0.4, 0.8];
/// Relative precision of the end of the scar, and most Newton steps; few are needed.
const PRECISION: f64 = 1e-9;
const MOST_ITERATIONS: usize = 50;
/// Depth of a scar times 2 R.
fn shape(x: f64, drawn: f64, flat: f64, reach: f64) -> f64 {
    let beyond = (x - drawn).max(flat);
    (reach.powi(2) - beyond.powi(2)).max(0.0)
}

/// Surrogate for the worn surfaces, one half of the symmetric scar.
#[derive(Clone)]
pub(super) struct Scar {
    tuning: Tuning,
    /// True if part of the contact may stick through the whole stroke.
    pub(super) sticks: bool,
    /// Radius of the relative curvature, Hertz half-width, amplitude, mm.
    radius: f64,
    hertz: f64,
    /// a of the surrogate, mm.
    flat: f64,
    pub(super) amplitude: f64,
    /// Approach of the bodies under the load, mm.
    approach: f64,
    /// k_s + k_r, 1/MPa, and E*, MPa.
    wear: f64,
    modulus: f64,
    /// Worn area a cycle, mm^2.
    pub(super) area_per_cycle: f64,
    /// Depth of one full pass, (k_s + k_r) P, mm.
    pass: f64,
    /// Share of each side in the depth.
    shares: Sides<f64>,
    /// True if grooves can be extrapolated, and whether wear is in proportion to the load.
    passes_are_even: bool,
    is_proportional: bool,
    motion: Motion,
    /// Expected cycles of the run.
    cycles: u64,
    /// Rate of the equivalent depths of each side over the mean rate that it wears by.
    pub(super) initial: Sides<f64>,
    pub(super) area: f64,
    /// Worn area since another motion has worn the surfaces, which no longer conform then, mm^2.
    conforming: f64,
    x: Vec<f64>,
    widths: Vec<f64>,
    /// Depth of each body in its own frame, and the largest of each, mm.
    pub(super) depth: Sides<Vec<f64>>,
    pub(super) deepest: Sides<f64>,
    /// Half-width of the contact and of the scar beyond the stroke, mm.
    pub(super) half_width: f64,
    reach: f64,
}

impl Scar {
    /// Scar of a motion under which part of the contact may stick or not.
    pub(super) fn new(scene: &Scene, layout: &Layout, sticks: bool) -> Self {
        let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
        let tuning = scene.accuracy.tuning;
        let hertz = layout.sizes.hertz_half_width;
        let rates = expected_wear::wear_rates(scene, hertz);
        let at = LocalState::mean(scene.load_n_per_mm, hertz, scene.timed_motion().mean());
        let wear = rates.slider + rates.receptacle;
        let approach = unworn_contact::approach(scene, hertz, modulus);
        let amplitude = scene.motion.amplitude_mm();
        let sliding = if let Motion::Periodic { turns, .. } = scene.motion {
            let lost = 2.0 * unworn_contact::gross_slip(scene, hertz);
            let slip = |(from, to): (f64, f64)| ((to - from).abs() - lost).max(0.0);
            turns.strokes().map(slip).sum()
        } else if amplitude > 0.0 {
            4.0 * (amplitude - unworn_contact::gross_slip(scene, hertz)).max(0.0)
        } else {
            scene.motion.distance_per_cycle_mm()
        };
        let half_block = 0.5 * scene.receptacle.shape.length_mm;
        let end = (amplitude + 1.5 * layout.sizes.final_half_width + hertz).min(half_block);
        let width = end / real(PLACES);
        let share = |k: f64| if wear > 0.0 { k / wear } else { 0.0 };
        Self {
            sticks,
            radius: unworn_contact::radius(scene),
            hertz,
            flat: tuning.surrogate_half_width * hertz,
            tuning,
            amplitude,
            approach,
            wear,
            modulus,
            area_per_cycle: wear * scene.load_n_per_mm * sliding,
            pass: wear * scene.load_n_per_mm,
            shares: rates.map(share),
            is_proportional: Side::BOTH.into_iter().all(|side| {
                let wear = *scene.surface_wear().of(side);
                wear.is_none_or(SurfaceWear::is_proportional)
            }),
            passes_are_even: scene
                .surface_wear()
                .receptacle
                .is_none_or(SurfaceWear::is_even),
            motion: scene.motion,
            cycles: expected_wear::expected_cycles(scene, hertz),
            initial: scene.surface_wear().zip(rates).map(|(wear, rate)| {
                let equivalent = wear.and_then(|wear| wear.equivalent_rate(at));
                equivalent.map_or(1.0, |equivalent| equivalent / rate)
            }),
            area: 0.0,
            conforming: 0.0,
            x: (0..PLACES).map(|i| width * (real(i) + 0.5)).collect(),
            widths: vec![width; PLACES],
            depth: Sides::from_fn(|_| vec![0.0; PLACES]),
            deepest: Sides::default(),
            half_width: hertz,
            reach: tuning.surrogate_half_width * hertz,
        }
    }

    /// The stroke after so many cycles.
    pub(super) fn stroke(&self, scene: &Scene, cycle: u64) -> Stroke {
        let mut stroke = Stroke::new(
            &self.tuning,
            self.shares.map(|share| share * self.wear),
            self.modulus,
            Movement {
                amplitude: self.amplitude,
                half_width: self.half_width,
                travel: self.radius / scene.slider.shape.radius_mm,
                sticks: self.sticks,
            },
            self.cycles,
        );
        stroke.is_groove &= self.passes_are_even;
        stroke.limit_change_of_friction(scene, cycle);
        if self.motion.turns_inside() {
            stroke = stroke.turning_inside(self.motion);
        }
        if self.is_proportional {
            stroke
        } else {
            stroke.of_uneven_wear()
        }
    }

    /// Wears so many cycles more.
    pub(super) fn wear(&mut self, cycles: u64) {
        self.area += self.area_per_cycle * real_cycles(cycles);
        self.conforming += self.area_per_cycle * real_cycles(cycles);
        self.grow();
        let drawn = (self.amplitude - self.flat).max(0.0);
        // The rest of the stroke moves the contact over the scar, which smears its growing edges.
        let smearing = self.amplitude.min(self.flat);
        for (depth, x) in self.depth.receptacle.iter_mut().zip(&self.x) {
            let places = PASSES.map(|pass| (x + pass * smearing).abs());
            let sum: f64 = places
                .iter()
                .map(|&x| shape(x, drawn, self.flat, self.reach))
                .sum();
            *depth = self.shares.receptacle * sum / (2.0 * self.radius * real(PASSES.len()));
        }
        self.deepest.receptacle = self.shares.receptacle * self.depth_at(0.0, drawn);
        self.wear_slider();
        self.half_width = self.contact();
    }

    /// Wear of the next cycle, mm.
    pub(super) fn of_cycle(&self) -> Sides<Vec<f64>> {
        let mut next = self.clone();
        next.wear(1);
        next.mean_since(&self.depth, 1)
    }

    /// Mean wear of a cycle since earlier depths, mm.
    pub(super) fn mean_since(&self, before: &Sides<Vec<f64>>, cycles: u64) -> Sides<Vec<f64>> {
        Sides::from_fn(|side| {
            let nodes = self.depth.of(side).iter().zip(before.of(side));
            let worn = nodes.map(|(after, before)| (after - before) / real_cycles(cycles));
            worn.collect()
        })
    }

    /// Takes it that another motion has worn the surfaces.
    pub(super) fn change_motion(&mut self) {
        self.conforming = 0.0;
    }

    /// Half-width of the slider's flat in gross sliding, mm.
    fn slider_flat(&self) -> f64 {
        (1.5 * self.radius * self.shares.slider * self.area).cbrt()
    }

    /// Part of the width of a scar, or flat, that the contact has after another motion: that of the wear since then would be the cube
    /// root of its share in the worn area. Measured: the root of that, on a sprung contact in which both bodies wear
    /// (`verify_mission`).
    fn conformity(&self) -> f64 {
        if self.conforming < self.area {
            (self.conforming / self.area).powf(1.0 / 6.0)
        } else {
            1.0
        }
    }

    fn wear_slider(&mut self) {
        let (half_width, share) = if self.amplitude > self.flat {
            (self.slider_flat(), 1.0)
        } else {
            (self.reach, self.shares.slider)
        };
        let factor = share / (2.0 * self.radius);
        for (depth, x) in self.depth.slider.iter_mut().zip(&self.x) {
            *depth = factor * shape(*x, 0.0, 0.0, half_width);
        }
        self.deepest.slider = factor * half_width.powi(2);
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

    /// Half-width of the contact of a single cycle: between that in gross sliding and the whole segment.
    fn contact(&self) -> f64 {
        let step = 2.0 * self.radius * self.pass;
        let gross = self.hertz.hypot((self.tuning.step_share * step).sqrt());
        let gross = gross.max(self.conformity() * self.slider_flat());
        let share = (self.amplitude / gross - 1.0).clamp(0.0, 1.0);
        let reach = self.conformity() * self.reach;
        gross.powf(share)
            * (reach / self.tuning.surrogate_half_width)
                .max(gross)
                .powf(1.0 - share)
    }

    /// Half-width of the candidate nodes.
    pub(super) fn candidate_half_width(&self) -> f64 {
        let gap = (1.0 + CANDIDATE_GAP) * self.approach;
        let flat = if self.is_gross() {
            self.half_width
        } else {
            self.reach.max(self.slider_flat())
        };
        flat.hypot((2.0 * self.radius * gap).sqrt())
    }

    /// Widths of the points, of both bodies alike.
    pub(super) fn widths(&self) -> Sides<&[f64]> {
        Sides::from_fn(|_| &self.widths[..])
    }

    pub(super) fn is_gross(&self) -> bool {
        self.tuning.is_gross(self.amplitude, self.half_width)
    }

    /// Depth that a part of a side's scar has at least, mm.
    pub(super) fn depth_of_part(&self, side: Side, part: f64) -> f64 {
        if part <= 0.0 {
            return *self.deepest.of(side);
        }
        let worn = WornSurface {
            x: &self.x,
            depth: self.depth.of(side),
        };
        worn.depth_of_part(part)
    }
}
