//! Worn depths in closed form, for estimates.
//!
//! A worn section W = k P s of the receptacle is taken as a parabola of depth h over a scar of half-width A/2 + sqrt(2 R h),
//!   (4/3) h (A/2 + sqrt(2 R h)) = W:
//! for A = 0 the segment of the arc, in gross sliding an empirical mean of parabola and flat floor (`sd_card`: 1.83 um for 1.76 um
//! at A = 0.02 mm). A worn section of the slider is the segment. Each body is taken to
//! wear against an unworn one: where both wear a common scar, neither becomes deeper. By dose the section wears by the mean
//! rate of its deepest point. A part f of the parabola is deeper than d where h = d/(1 - f^2).

use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::number::{cycles_at_least, real_cycles};
use crate::scene::{Criterion, Scene};
use crate::sides::{Side, Sides};

/// Halvings of the interval that holds a depth: far below any indicator's precision.
const HALVINGS: usize = 50;

/// Largest exposed part of a scar of which the depth is estimated: the edges of a parabola are never through.
pub(super) const MOST_EXPOSED: f64 = 0.95;

/// Largest worn depths after so many cycles with this wear of both surfaces, in mm, for a radius of relative curvature in mm and
/// a representative state.
pub(crate) fn after(
    scene: &Scene,
    radius: f64,
    at: LocalState,
    wear: &Sides<Option<SurfaceWear>>,
    cycles: u64,
) -> Sides<f64> {
    let path = scene.load_n_per_mm * scene.motion.distance_per_cycle_mm() * real_cycles(cycles);
    let depth = |wear: Option<SurfaceWear>, amplitude, height: f64| {
        wear.map_or(0.0, |wear| {
            // Where the rate falls without bound from the unworn surface on, the height is the bound.
            let most = match wear {
                SurfaceWear::ByPower { .. } => f64::INFINITY,
                _ => path * wear.largest_rate(height, at),
            };
            let worn = |h| path * wear.mean_rate(h, at);
            let depth = depth(worn, most, height, amplitude, radius);
            depth.min(height)
        })
    };
    let amplitude = scene.motion.equivalent_amplitude_mm();
    Sides {
        slider: depth(wear.slider, 0.0, scene.slider.shape.height_mm),
        receptacle: depth(wear.receptacle, amplitude, scene.receptacle.shape.height_mm),
    }
}

/// Cycles until the run ends: all of them, or fewer where it stops at a criterion.
pub(crate) fn expected_cycles(
    scene: &Scene,
    radius: f64,
    at: LocalState,
    wear: &Sides<Option<SurfaceWear>>,
) -> u64 {
    let path = scene.load_n_per_mm * scene.motion.distance_per_cycle_mm();
    let amplitudes = Sides {
        slider: 0.0,
        receptacle: scene.motion.equivalent_amplitude_mm(),
    };
    let cycles = |side: Side, depth: f64| {
        let rate = wear.of(side).map_or(0.0, |wear| wear.mean_rate(depth, at));
        if rate * path > 0.0 {
            section(depth, *amplitudes.of(side), radius) / (rate * path)
        } else {
            f64::INFINITY
        }
    };
    let stops = scene.stop.iter().map(|criterion| {
        let Criterion { side, depth_mm, .. } = *criterion;
        let part = criterion.part.min(MOST_EXPOSED);
        let deepest = wear.of(side).map_or(depth_mm, SurfaceWear::deepest);
        let depth = depth_mm / (1.0 - part.powi(2));
        cycles(side, depth.min(deepest.max(depth_mm)))
    });
    let first = stops.fold(f64::INFINITY, f64::min);
    cycles_at_least(first).min(scene.cycles)
}

/// Section of a groove of a depth h, mm^2.
fn section(h: f64, amplitude: f64, radius: f64) -> f64 {
    4.0 / 3.0 * h * (0.5 * amplitude + (2.0 * radius * h).sqrt())
}

/// Depth of a groove, mm, whose section, mm^2, depends on its depth and is at most a value, or the depth at most another.
fn depth(worn: impl Fn(f64) -> f64, most: f64, height: f64, amplitude: f64, radius: f64) -> f64 {
    // Without the flat part.
    let segment = (0.75 * most / (2.0 * radius).sqrt()).powf(2.0 / 3.0);
    let (mut low, mut high) = (0.0, if most.is_finite() { segment } else { height });
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if section(middle, amplitude, radius) < worn(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::scene::Layer;

    #[test]
    fn a_groove_holds_its_section() {
        for (amplitude, radius) in [(0.0, 0.4), (1e-3, 0.4), (0.02, 0.05), (1.0, 0.4)] {
            let h = depth(|_| 1e-4, 1e-4, 1.0, amplitude, radius);
            assert!(
                (section(h, amplitude, radius) / 1e-4 - 1.0).abs() < 1e-9,
                "{amplitude} {radius}"
            );
        }
        assert!(depth(|_| 0.0, 0.0, 1.0, 0.02, 0.4) <= 0.0);
    }

    #[test]
    fn a_run_is_expected_to_end_at_the_depth_that_it_stops_at() {
        let mut scene = fuzz_button();
        scene.stop.clear();
        let (radius, at) = (0.0254, LocalState::default());
        let wear = scene.surface_wear();
        assert_eq!(expected_cycles(&scene, radius, at, &wear), scene.cycles);
        let depth = after(&scene, radius, at, &wear, 100).receptacle;
        scene.stop = vec![Criterion::deepest(Side::Receptacle, depth)];
        let expected = expected_cycles(&scene, radius, at, &wear);
        assert!(expected.abs_diff(100) <= 1, "{expected}");
        // The slider does not wear.
        scene.stop = vec![Criterion::deepest(Side::Slider, depth)];
        assert_eq!(expected_cycles(&scene, radius, at, &wear), scene.cycles);
        // A plating of that thickness is through on half the scar later than at its deepest point.
        scene.receptacle.plating = vec![Layer {
            thickness_mm: depth,
            rate_per_mpa: scene.receptacle.outer_rate().unwrap_or(0.0),
        }];
        let at_part = |part| {
            let mut scene = scene.clone();
            scene.stop = vec![Criterion {
                part,
                ..Criterion::deepest(Side::Receptacle, depth)
            }];
            expected_cycles(&scene, radius, at, &scene.surface_wear())
        };
        assert!(at_part(1e-3).abs_diff(100) <= 1);
        assert!(at_part(0.5) > 120 && at_part(0.99) > at_part(0.5));
    }
}
