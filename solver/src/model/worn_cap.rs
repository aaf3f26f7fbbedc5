//! Worn depths of point contacts in closed form, for estimates: of rigid bodies in gross slip.
//!
//! Bodies of the relative radii R_x along and R_z across the sliding direction (mm), under the force F (N) in cycles of the amplitude A
//! (mm). A slider that is worn to the depth h has lost a cap, of which
//!   V(z) = pi sqrt(R_x R_z) (h - z)^2
//! lies deeper than z; a receptacle below a slider that does not wear a groove with the ends of that cap,
//!   V(z) = (8/3) A sqrt(2 R_z) (h - z)^1.5 + pi sqrt(R_x R_z) (h - z)^2.
//! With the specific wear rates k_i (1/MPa) between the depths z_i of the layers, the work of friction over mu is
//!   4 A F N = sum (V(z_i) - V(z_i+1))/k_i.
//! Where the slider wears too, its flat of the half-length b = sqrt(2 R_x h_s) passes a place of the receptacle twice a cycle with the line
//! load 2 F/(pi b); a stroke that is short beside the flat leaves its dose evenly below it, so that the dose of the deepest place
//! grows by
//!   dD/dN = 4 F/(pi b) A/(A + b).
//!
//! Limiting cases: a cap, and a groove far longer than the contact. The receptacle's wear is left out of the slider's.

use std::f64::consts::PI;

use super::worn_depth::MOST_EXPOSED;
use crate::law::plating::bottoms;
use crate::law::surface::SurfaceWear;
use crate::number::{cycles_at_least, real_cycles};
use crate::scene::{Criterion, Point, Scene};
use crate::sides::{Side, Sides};

/// Halvings of the interval that holds a depth, and steps of an integral over the slider's depth: far below the forms' precision.
const HALVINGS: usize = 50;
const STEPS: u32 = 200;

/// A point contact whose surfaces wear by the dose.
pub(crate) struct WornCap<'a> {
    scene: &'a Scene,
    wear: Sides<Option<SurfaceWear>>,
    force: f64,
    amplitude: f64,
    /// R_x and R_z, mm.
    radius_along: f64,
    radius_across: f64,
}

impl<'a> WornCap<'a> {
    /// Of a scene of a point contact.
    pub(crate) fn of(scene: &'a Scene, point: &Point) -> Self {
        let across = point.radius_across_mm;
        let curvature = |radius: Option<f64>| radius.map_or(0.0, f64::recip);
        let (slider, block) = (&scene.slider.shape, &scene.receptacle.shape);
        let along = curvature(Some(slider.radius_mm)) + curvature(block.crown_radius_mm);
        Self {
            wear: scene.surface_wear(),
            force: point.force_n,
            amplitude: scene.motion.equivalent_amplitude_mm().abs(),
            radius_along: along.recip(),
            radius_across: (curvature(across.slider) + curvature(across.receptacle)).recip(),
            scene,
        }
    }

    /// Largest worn depths after so many cycles, mm, each against an unworn body.
    pub(crate) fn depth_after(&self, cycles: u64) -> Sides<f64> {
        Sides::from_fn(|side| {
            let height = match side {
                Side::Slider => self.scene.slider.shape.height_mm,
                Side::Receptacle => self.scene.receptacle.shape.height_mm,
            };
            let (mut low, mut high) = (0.0, height);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                let needed = self.alone(side, middle).unwrap_or(f64::INFINITY);
                if needed < real_cycles(cycles) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            low
        })
    }

    /// Cycles until a criterion is reached; `None` where the side never wears so deep.
    pub(crate) fn cycles(&self, criterion: Criterion) -> Option<f64> {
        let Criterion {
            side,
            part,
            depth_mm,
        } = criterion;
        // The part of a paraboloid that is deeper than d has the share 1 - d/h of its area.
        let deepest = depth_mm / (1.0 - part.min(MOST_EXPOSED));
        match side {
            Side::Receptacle if self.wear.slider.is_some() => self.below_worn_slider(deepest),
            _ => self.alone(side, deepest),
        }
    }

    /// Cycles until the run ends: all of them, or fewer where it stops at a criterion.
    pub(crate) fn expected_cycles(&self) -> u64 {
        let stops = self.scene.stop.iter();
        let stops = stops.filter_map(|criterion| self.cycles(*criterion));
        let first = stops.fold(f64::INFINITY, f64::min);
        cycles_at_least(first).min(self.scene.cycles)
    }

    /// Cycles until a side has a depth beside a body that does not wear.
    fn alone(&self, side: Side, depth: f64) -> Option<f64> {
        let wear = (*self.wear.of(side))?;
        let rate = wear.dose_rate().filter(|rate| *rate > 0.0)?;
        if depth > wear.deepest() || self.amplitude <= 0.0 {
            return None;
        }
        let groove = match side {
            Side::Slider => 0.0,
            Side::Receptacle => 8.0 / 3.0 * self.amplitude * (2.0 * self.radius_across).sqrt(),
        };
        let cap = PI * (self.radius_along * self.radius_across).sqrt();
        let deeper_than = |z: f64| groove * (depth - z).powf(1.5) + cap * (depth - z).powi(2);
        let interfaces = bottoms(self.scene.plating(side)).filter(|bottom| *bottom < depth);
        let places: Vec<f64> = [0.0].into_iter().chain(interfaces).chain([depth]).collect();
        let work = places.windows(2).map(|layer| {
            let (top, bottom) = (layer[0], layer[1]);
            let dose = (wear.equivalent(bottom) - wear.equivalent(top)) / rate;
            (deeper_than(top) - deeper_than(bottom)) * dose / (bottom - top)
        });
        Some(work.sum::<f64>() / (4.0 * self.amplitude * self.force))
    }

    /// Cycles until the receptacle has a depth below a slider that wears.
    fn below_worn_slider(&self, depth: f64) -> Option<f64> {
        let wear = self.wear.receptacle?;
        let rate = wear.dose_rate().filter(|rate| *rate > 0.0)?;
        let needed = (depth <= wear.deepest()).then(|| wear.equivalent(depth) / rate)?;
        let dose_per_cycle = |slider: f64| {
            let flat = (2.0 * self.radius_along * slider).sqrt();
            4.0 * self.force / (PI * flat) * self.amplitude / (self.amplitude + flat)
        };
        // Equal ratios of the slider's depth, from far below any layer on.
        let least = 1e-6 * depth;
        let ratio = (self.scene.slider.shape.height_mm / least).powf(1.0 / f64::from(STEPS));
        let (mut slider, mut before) = (least, self.alone(Side::Slider, least)?);
        let mut dose = dose_per_cycle(slider) * before;
        for _ in 0..STEPS {
            let next = slider * ratio;
            let Some(after) = self.alone(Side::Slider, next) else {
                // The slider's base does not wear: its flat stays as wide.
                return Some(before + (needed - dose).max(0.0) / dose_per_cycle(slider));
            };
            let added = dose_per_cycle((slider * next).sqrt()) * (after - before);
            if dose + added >= needed {
                return Some(before + (needed - dose).max(0.0) / added * (after - before));
            }
            (dose, slider, before) = (dose + added, next, after);
        }
        None
    }
}
