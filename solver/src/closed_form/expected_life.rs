//! Cycles until a surface is worn to a depth, through all of its layers: for plans, before anything is solved.
//!
//! A place that has received the dose D = int p |ds| (MPa mm) has the depth G(D), piecewise linear over the layers
//! (`law::plating`). Over a path s (mm) under the load P' (N/mm) the doses of all places of a rider add up to P' s. A worn section
//! of half-width w (mm) and largest depth h (mm) is taken as a parabola, of which F(z) = (4/3) w (h - z)^1.5/h^0.5 (mm^2) lies deeper
//! than z, so that with the specific wear rate k_i (1/MPa) between the depths z_i and z_i+1
//!   P' s = sum (F(z_i) - F(z_i+1))/k_i,
//! for one layer the section over the rate, (4/3) w h/k. R is the radius of relative curvature (mm), A the amplitude (mm).
//!
//! * Rider on a surface that does not wear: w = sqrt(2 R h), the arc of height h (exact for a rigid arc).
//! * Groove under a rider that does not wear: a floor that is passed twice a cycle, N = sum t_i/(2 k_i P'), and once the rider's arc reaches
//!   as far as the stroke, w = A/2 + sqrt(2 R h), the empirical mean of `worn_depth`; at sqrt(2 R h) = A it is the floor.
//! * Both wear: the deepest place of the receptacle has the part q of the rider's largest dose D, and the part p of its depth follows the
//!   rider's shape, so that w^2 = 2 R h, h = G_s(D) + p G_r(q D). For short strokes both bodies have one scar, q = p = 1; on a long one a
//!   floor has the dose P' s/(2 A), and p = 0. Between them q = 1/(1 + 2 A D/(P' s)), which for one layer is 1/(1 + 1.5 A/w), and
//!   p = exp(-2.3 A/w)/q. The receptacle's own life is that of a groove as long as 2 A + (4/3) w.
//! * Blocks of a mission: each stroke takes its part f_i of the path, and the parts of dose and depth above are the means of those of the
//!   strokes, q = sum f_i q_i, p q = sum f_i p_i q_i. Where one side wears alone, 1/(P' s) = sum f_i/(P' s)_i. A mission of matings
//!   and vibration has 16 % more cycles than its run at the tip, 26 % fewer at a depth of 0.44 um of the pad.
//!
//! The forms, and 2.3, are fitted to rigid bodies (SD card, 10 % tolerance). Equal rates of one layer, R of 0.1 and 0.4 mm, A/w from 0.03
//! to 4: the rider's cycles are met within 3 %, the receptacle's within 6 %. Gold over nickel on both (`tests/cases/plated_presets.rs`):
//! the rider's within 5 %; the receptacle's, which are later, within 2 and 12 % for first exposure and base metal, but 28 and 46 % too
//! few where A/w is 0.1, because its layers are through where the rider's flat changes fastest.
//!
//! Range: laws whose rate is the same in every state, a load that does not change, gross slip (a place that sticks wears later), no
//! movement of the contact over a crown. Limiting case: one layer, Archard's law.

use super::worn_cap::WornCap;
use super::{unworn_contact, worn_depth};
use crate::law::plating::bottoms;
use crate::law::surface::SurfaceWear;
use crate::number::real_cycles;
use crate::scene::{Criterion, Motion, Scene};
use crate::sides::{Side, Sides};

/// A point of the depth over the dose.
#[derive(Debug, Clone, Copy)]
struct Point {
    /// MPa mm.
    dose: f64,
    /// mm.
    depth: f64,
}

/// A contact whose surfaces have rates that are the same in every state.
struct Contact<'a> {
    scene: &'a Scene,
    wear: Sides<Option<SurfaceWear>>,
    radius: f64,
    strokes: Vec<Stroke>,
}

/// A motion of the path.
#[derive(Debug, Clone, Copy)]
struct Stroke {
    /// mm.
    amplitude: f64,
    /// Part of the path, -.
    share: f64,
}

/// Decay with A/w of the receptacle's depth that follows the rider's shape, -. Fitted, see above: 2.0 and 2.6 are off by 4 %.
const SHARED_DEPTH: f64 = 2.3;
/// Halvings of an interval that holds a width or a dose: far below the precision of the forms.
const HALVINGS: usize = 40;
/// Sum of the doses over a flat of which every place has the largest one, over that and the half-width: of a base that does not
/// wear.
const UNIFORM: f64 = 2.0;
/// Depth of the rider from which its depth at the life of a receptacle is sought, over the radius. Arbitrary: far below any layer.
const SMALLEST_DEPTH: f64 = 1e-9;

/// Cycles of the scene's motion until a criterion is reached, as if its run did not end before; `None` where the side never wears so
/// deep, or wears by a law of state.
pub fn cycles(scene: &Scene, criterion: Criterion) -> Option<f64> {
    let of_cap = WornCap::of_scene(scene).map(|cap| cap.cycles(criterion));
    if let (Some(cycles), Some(_)) = (of_cap, scene.dimension.point()) {
        return cycles;
    }
    let path = scene.load_n_per_mm * scene.motion.distance_per_cycle_mm();
    let contact = Contact {
        scene,
        wear: scene.surface_wear(),
        radius: unworn_contact::radius(scene),
        strokes: strokes(scene),
    };
    let of_section = contact.load_path(criterion).filter(|_| path > 0.0);
    let of_section = of_section.map(|load_path| load_path / path);
    // A crown is worn sooner, until it touches over all of its width.
    let lives = of_cap.flatten().into_iter().chain(of_section);
    lives.reduce(f64::min)
}

/// The motion of a scene, or those of the blocks of its mission that move the contact.
fn strokes(scene: &Scene) -> Vec<Stroke> {
    let of_motion = |motion: Motion, path: f64| Stroke {
        amplitude: motion.equivalent_amplitude_mm(),
        share: path,
    };
    let Some(mission) = &scene.mission else {
        return vec![of_motion(scene.motion, 1.0)];
    };
    let paths = mission.blocks.iter().map(|block| {
        let path = real_cycles(block.cycles) * block.motion.distance_per_cycle_mm().abs();
        (block.motion, path)
    });
    let all: f64 = paths.clone().map(|(_, path)| path).sum();
    let moving = paths.filter(|(_, path)| *path > 0.0);
    moving
        .map(|(motion, path)| of_motion(motion, path / all))
        .collect()
}

/// Quantities of a rider and a receptacle that both wear.
#[derive(Debug, Clone, Copy)]
struct WearPartition {
    /// Half-width of the rider's flat, mm.
    half_width: f64,
    /// Largest dose of the receptacle over that of the rider.
    dose: f64,
    /// Part of the receptacle's depth that follows the rider's shape.
    depth: f64,
}

impl Contact<'_> {
    /// P' s until a criterion is reached, N.
    fn load_path(&self, criterion: Criterion) -> Option<f64> {
        let Criterion {
            side,
            part,
            depth_mm,
        } = criterion;
        // The part of a parabola that is deeper than d has (1 - d/h)^0.5 of its width.
        let depth = depth_mm / (1.0 - part.min(worn_depth::MOST_EXPOSED).powi(2));
        let dose = self.dose(side, depth)?;
        let other_wears = self.wear.of(side.other()).is_some();
        match side {
            Side::Slider if other_wears => self.both(dose),
            Side::Slider => self.section(&[(side, 1.0, 1.0)], dose, self.arc(depth)),
            Side::Receptacle if other_wears => self.groove(dose),
            Side::Receptacle => self.alone(side, depth, depth_mm),
        }
    }

    /// P' s at which a receptacle whose rider does not wear has a depth at its deepest place, or at the edge of the part that a criterion
    /// is about, mm.
    fn alone(&self, side: Side, deepest: f64, depth: f64) -> Option<f64> {
        let (dose, arc) = (self.dose(side, deepest)?, self.arc(deepest));
        let floor = self.dose(side, depth)?;
        let inverse = self.strokes.iter().map(|Stroke { amplitude, share }| {
            let load_path = if *amplitude > 0.0 && arc <= *amplitude {
                // Every place of the floor receives 2 P' in a cycle, of the path 4 A.
                2.0 * amplitude * floor
            } else {
                self.section(&[(side, 1.0, 1.0)], dose, 0.5 * amplitude + arc)?
            };
            Some(share / load_path)
        });
        inverse.sum::<Option<f64>>().map(f64::recip)
    }

    /// Half-width of an arc of a height, mm.
    fn arc(&self, height: f64) -> f64 {
        (2.0 * self.radius * height).sqrt()
    }

    /// P' s at which the rider of two bodies that wear has a dose at its deepest place.
    fn both(&self, dose: f64) -> Option<f64> {
        let partition = self.partition(dose);
        let sides = [
            (Side::Slider, 1.0, 1.0),
            (Side::Receptacle, partition.dose, partition.depth),
        ];
        self.section(&sides, dose, partition.half_width)
    }

    /// Width of the rider's flat that has a dose at its deepest place, and what it shares with the receptacle.
    fn partition(&self, dose: f64) -> WearPartition {
        // Doses of all places of the flat, over the largest one and the half-width.
        let sum = self.section(&[(Side::Slider, 1.0, 1.0)], dose, 1.0);
        let sum = sum.map_or(UNIFORM, |sum| sum / dose);
        let at = |half_width: f64| {
            let mean = |of: fn(f64, f64) -> f64| -> f64 {
                let strokes = self.strokes.iter();
                strokes
                    .map(|stroke| stroke.share * of(stroke.amplitude / half_width, sum))
                    .sum()
            };
            let dose = mean(|strokes, sum| 1.0 / (1.0 + 2.0 * strokes / sum));
            WearPartition {
                half_width,
                dose,
                depth: mean(|strokes, _| (-SHARED_DEPTH * strokes).exp()) / dose,
            }
        };
        let slider = self.depth(Side::Slider, dose);
        let width_of = |partition: WearPartition| {
            let receptacle = self.depth(Side::Receptacle, partition.dose * dose);
            self.arc(slider + partition.depth * receptacle)
        };
        let (mut low, mut high) = (
            self.arc(slider),
            self.arc(slider + self.depth(Side::Receptacle, dose)),
        );
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if width_of(at(middle)) > middle {
                low = middle;
            } else {
                high = middle;
            }
        }
        // A slider that is worn over all of its width is a flat of that width.
        at(high.min(self.scene.slider.shape.half_width_mm))
    }

    /// P' s at which the deepest place of the receptacle below a rider that wears has a dose.
    fn groove(&self, dose: f64) -> Option<f64> {
        // Path over the dose of the deepest place.
        let length = |half_width: f64| {
            let of_strokes = self.strokes.iter().map(|Stroke { amplitude, share }| {
                share / (2.0 * amplitude + 4.0 / 3.0 * half_width)
            });
            of_strokes.sum::<f64>().recip()
        };
        let at = |depth: f64| {
            let rider = self.dose(Side::Slider, depth)?;
            Some((self.both(rider)?, self.partition(rider).half_width))
        };
        let least = SMALLEST_DEPTH * self.radius;
        let mut high = least;
        while let Some((load_path, half_width)) = at(high)
            && load_path < dose * length(half_width)
        {
            high *= 2.0;
        }
        if at(high).is_none() {
            // The base of the rider does not wear: its flat stays as wide as where the layers end.
            let deepest = self.wear.slider.map_or(0.0, SurfaceWear::deepest);
            return deepest
                .is_finite()
                .then(|| dose * length(self.arc(deepest)));
        }
        let mut low = 0.5 * high;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if at(middle)
                .is_some_and(|(load_path, half_width)| load_path < dose * length(half_width))
            {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(at(high)?.0)
    }

    /// P' s of a section of a half-width whose deepest place has a dose; sides with their parts of the dose and of their depths.
    fn section(&self, sides: &[(Side, f64, f64)], dose: f64, half_width: f64) -> Option<f64> {
        let points = self.depth_over_dose(sides, dose);
        let deepest = points.last()?.depth;
        let deeper_than =
            |z: f64| 4.0 / 3.0 * half_width * (deepest - z).max(0.0).powf(1.5) / deepest.sqrt();
        let layers = points.windows(2).map(|ends| {
            let (top, bottom) = (ends[0], ends[1]);
            let inverse_rate = (bottom.dose - top.dose) / (bottom.depth - top.depth);
            (deeper_than(top.depth) - deeper_than(bottom.depth)) * inverse_rate
        });
        let load_path: f64 = layers.sum();
        load_path.is_finite().then_some(load_path)
    }

    /// The depth that these sides have together, at the interfaces of their layers up to a dose.
    fn depth_over_dose(&self, sides: &[(Side, f64, f64)], most: f64) -> Vec<Point> {
        let interfaces = sides.iter().flat_map(|(side, share, _)| {
            let bottoms = bottoms(self.scene.plating(*side));
            bottoms.filter_map(move |bottom| Some(self.dose(*side, bottom)? / share))
        });
        let within = interfaces.filter(|dose| *dose < most);
        let mut doses: Vec<f64> = [0.0, most].into_iter().chain(within).collect();
        doses.sort_by(f64::total_cmp);
        doses.dedup();
        let point = |dose| Point {
            dose,
            depth: sides
                .iter()
                .map(|(side, share, part)| part * self.depth(*side, share * dose))
                .sum(),
        };
        doses.into_iter().map(point).collect()
    }

    /// Dose of a depth of a side, MPa mm; `None` for a depth that it never has, and for a law of state.
    fn dose(&self, side: Side, depth: f64) -> Option<f64> {
        let wear = (*self.wear.of(side))?;
        let rate = outer_rate(wear).filter(|rate| *rate > 0.0)?;
        (depth <= wear.deepest()).then(|| wear.equivalent(depth) / rate)
    }

    /// Depth of a side that has a dose, mm.
    fn depth(&self, side: Side, dose: f64) -> f64 {
        let depth = |wear: SurfaceWear| Some(wear.depth(dose * outer_rate(wear)?));
        self.wear.of(side).and_then(depth).unwrap_or(0.0)
    }
}

/// Specific wear rate of the outermost layer, or the initial one by the dose, 1/MPa, if it is the same in every state.
fn outer_rate(wear: SurfaceWear) -> Option<f64> {
    let by_dose = || wear.dose_curve().map(|curve| curve.initial_rate());
    wear.uniform().or_else(by_dose)
}

#[cfg(test)]
mod tests;
