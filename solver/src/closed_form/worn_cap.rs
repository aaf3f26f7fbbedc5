//! Worn depths of point contacts in closed form, for estimates: of rigid bodies in gross slip.
//!
//! Bodies of the relative radii R_x along and R_z across the sliding direction (mm), under the force F (N) in cycles of the amplitude A
//! (mm). A slider that is worn to the depth h has lost a cap, of which
//!   V(z) = pi sqrt(R_x R_z) (h - z)^2
//! lies deeper than z; a receptacle below a slider that does not wear a groove with the ends of that cap,
//!   V(z) = (8/3) A sqrt(2 R_z) (h - z)^1.5 + pi sqrt(R_x R_z) (h - z)^2.
//! With the specific wear rates k_i (1/MPa) between the depths z_i of the layers, the work of friction over mu is
//!   4 A F N = sum (V(z_i) - V(z_i+1))/k_i.
//! Where both wear, the slider's flat of the half-lengths b along and c across has the shape of a cap in a groove that is as deep as h_r
//! everywhere across, and follows the slider's shape along by the part that it does in sections (`expected_life`),
//!   b^2 = 2 R_x (h_s + min(h_r, h_s exp(-2.3 A/b))),  c^2 = 2 R_z (h_s + h_r),
//! so that the slider's work above has the factor b c/(2 sqrt(R_x R_z) h_s). The flat passes a place of the receptacle twice a cycle with the
//! line load 2 F/(pi c); a stroke that is short beside the flat leaves its dose evenly below it, so that the dose of the deepest
//! place grows by
//!   dD/dN = 4 F/(pi c) A/(A + b).
//!
//! Limiting cases: a cap, and a groove far longer than the contact. Elastic deformation, which makes a life of a memory card's ball 8 %
//! longer, is left out.

use std::f64::consts::PI;

use super::worn_depth::MOST_EXPOSED;
use crate::law::plating::bottoms;
use crate::law::surface::SurfaceWear;
use crate::number::{cycles_at_least, real_cycles};
use crate::scene::{Criterion, Dimension, LineShape, Point, Scene};
use crate::sides::{Side, Sides};

/// Halvings of the interval that holds a depth, and steps of an integral over the slider's depth: far below the forms' precision.
const HALVINGS: usize = 30;
const STEPS: u32 = 200;
/// First depth of the slider in these steps over the one that is sought.
const SMALLEST_PART: f64 = 1e-6;
/// Decay with A/b of the receptacle's depth that follows the slider's shape, as in sections.
const SHARED_DEPTH: f64 = 2.3;

/// A point contact whose surfaces wear by the dose.
#[derive(Clone, Copy)]
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

    /// The cap that a point contact wears, or a crowned line until it touches over all of its width.
    pub(super) fn of_scene(scene: &'a Scene) -> Option<Self> {
        let Dimension::Line(line) = &scene.dimension else {
            return scene.dimension.point().map(|point| Self::of(scene, point));
        };
        let LineShape::Straight {
            crown_radius_mm: Some(radius),
            ..
        } = line.shape
        else {
            return None;
        };
        let point = Point {
            force_n: line.force_n,
            radius_across_mm: Sides {
                slider: Some(radius),
                receptacle: None,
            },
        };
        Some(Self::of(scene, &point))
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
            _ if self.wear.of(side.other()).is_some() => self.both(side, deepest),
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

    /// Cycles until a side has a depth where both wear: steps of the slider's depth in equal ratios, from far below any layer on.
    fn both(&self, side: Side, depth: f64) -> Option<f64> {
        let receptacle = self.wear.receptacle?;
        let rate = receptacle.dose_rate().filter(|rate| *rate > 0.0)?;
        let needed = match side {
            Side::Slider => f64::INFINITY,
            Side::Receptacle if depth > receptacle.deepest() => return None,
            Side::Receptacle => receptacle.equivalent(depth) / rate,
        };
        let least = SMALLEST_PART * depth;
        let ratio = (self.scene.slider.shape.height_mm / least).powf(1.0 / f64::from(STEPS));
        let (mut slider, mut dose) = (least, 0.0);
        let mut before = self.alone(Side::Slider, least)?;
        for _ in 0..STEPS {
            let groove = receptacle.depth(rate * dose);
            let next = slider * ratio;
            let (_, factor) = self.flat(next, groove);
            let (per_cycle, _) = self.flat((slider * next).sqrt(), groove);
            let Some(alone) = self.alone(Side::Slider, next) else {
                // The slider's base does not wear: its flat stays as wide.
                return (side == Side::Receptacle).then(|| before + (needed - dose) / per_cycle);
            };
            let after = (alone * factor).max(before);
            let added = per_cycle * (after - before);
            let part = match side {
                // The cycles go with the square of the depth.
                Side::Slider => (depth.powi(2) - slider.powi(2)) / (next.powi(2) - slider.powi(2)),
                Side::Receptacle => (needed - dose) / added,
            };
            if part <= 1.0 {
                return Some(before + part.max(0.0) * (after - before));
            }
            (slider, dose, before) = (next, dose + added, after);
        }
        None
    }

    /// Dose per cycle of the deepest place below a slider worn to a depth in a groove of another one, mm, MPa mm; and the factor of the
    /// slider's work.
    fn flat(&self, slider: f64, groove: f64) -> (f64, f64) {
        let arc = (2.0 * self.radius_along * slider).sqrt();
        let followed = (slider * (-SHARED_DEPTH * self.amplitude / arc).exp()).min(groove);
        let along = (2.0 * self.radius_along * (slider + followed)).sqrt();
        let across = (2.0 * self.radius_across * (slider + groove)).sqrt();
        let passes = self.amplitude / (self.amplitude + along);
        let alone = 2.0 * (self.radius_along * self.radius_across).sqrt() * slider;
        (
            4.0 * self.force / (PI * across) * passes,
            along * across / alone,
        )
    }
}
