//! Expected wear of a run by closed forms: its rates, its cycles, the depths and the contact at its end.

use super::line_contact;
use super::unworn_contact::{hertz_half_width, radius};
use super::worn_cap::WornCap;
use super::worn_depth;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::scene::{LineShape, Scene};
use crate::sides::Sides;

/// Specific wear rates in a contact of a half-width, 1/MPa; of laws whose rate depends on the depth the mean rate down to the estimated depth at the
/// end.
pub(crate) fn wear_rates(scene: &Scene, half_width: f64) -> Sides<f64> {
    let wear = scene.surface_wear();
    let at = LocalState::mean(scene.load_n_per_mm, half_width, scene.timed_motion().mean());
    let by_depth = |wear: Option<SurfaceWear>| wear.is_some_and(SurfaceWear::depends_on_depth);
    let depth = if by_depth(wear.slider) || by_depth(wear.receptacle) {
        let cycles = expected_cycles(scene, half_width);
        worn_depth_after(scene, half_width, &wear, cycles)
    } else {
        Sides::default()
    };
    wear.zip(depth)
        .map(|(wear, depth)| wear.map_or(0.0, |wear| wear.mean_rate(depth, at)))
}

/// Estimated cycles until the end of a run: all of them, or fewer where it stops at a criterion.
pub fn expected_end(scene: &Scene) -> u64 {
    expected_cycles(scene, hertz_half_width(scene))
}

/// The same for a Hertz half-width, mm.
pub(crate) fn expected_cycles(scene: &Scene, half_width: f64) -> u64 {
    let of_cap = WornCap::of_scene(scene).map(|cap| cap.expected_cycles());
    if let (Some(cycles), Some(_)) = (of_cap, scene.dimension.point()) {
        return cycles;
    }
    let at = LocalState::mean(scene.load_n_per_mm, half_width, scene.timed_motion().mean());
    let of_section = worn_depth::expected_cycles(scene, radius(scene), at, &scene.surface_wear());
    of_cap.map_or(of_section, |cycles| cycles.min(of_section))
}

/// Estimated largest worn depths after so many cycles, mm, in a contact of a half-width with this wear of both surfaces.
pub(crate) fn worn_depth_after(
    scene: &Scene,
    half_width: f64,
    wear: &Sides<Option<SurfaceWear>>,
    cycles: u64,
) -> Sides<f64> {
    let of_cap = WornCap::of_scene(scene).map(|cap| cap.depth_after(cycles));
    if let (Some(depth), Some(_)) = (of_cap, scene.dimension.point()) {
        return depth;
    }
    let at = LocalState::mean(scene.load_n_per_mm, half_width, scene.timed_motion().mean());
    let of_section = worn_depth::after(scene, radius(scene), at, wear, cycles);
    // A cap is deeper until it reaches the ends of the width.
    of_cap.map_or(of_section, |depth| {
        depth
            .zip(of_section)
            .map(|(of_cap, of_section)| of_cap.max(of_section))
    })
}

/// Estimated half-length of a contact along the sliding direction at the end of its run, mm: the arc that has worn off, or Hertz'.
pub fn worn_contact_half_length_mm(scene: &Scene) -> f64 {
    let hertz = hertz_half_width(scene);
    let cycles = expected_cycles(scene, hertz);
    let depth = worn_depth_after(scene, hertz, &scene.surface_wear(), cycles);
    let arc = 2.0 * radius(scene) * depth.slider.max(depth.receptacle);
    arc.sqrt().max(hertz)
}

/// Half-lengths of the contact of a crowned line, unworn and at the estimated end, mm: the arc that has worn off; `None` of another contact.
pub fn crown_half_lengths_mm(scene: &Scene) -> Option<(f64, f64)> {
    let line = scene.dimension.line()?;
    let LineShape::Straight {
        crown_radius_mm: Some(radius),
        ..
    } = line.shape
    else {
        return None;
    };
    let unworn = line_contact::touch_of(scene, line).length_mm;
    let hertz = hertz_half_width(scene);
    let cycles = expected_cycles(scene, hertz);
    let depth = worn_depth_after(scene, hertz, &scene.surface_wear(), cycles);
    let arc = 2.0 * radius * (depth.slider + depth.receptacle);
    Some((unworn, (unworn * unworn + arc).sqrt()))
}
