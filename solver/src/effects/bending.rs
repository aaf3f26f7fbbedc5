//! Skew of the pressure by the bending of a slider under friction.
//!
//! The shear mu P on the end of a cantilever of height H, thickness 2 w and modulus E' = E/(1 - nu^2), all a unit of width, rotates it by
//! theta = mu P H^2/(2 E' I), I = (2 w)^3/12 (Euler-Bernoulli). Where the surfaces conform over 2 a, a rotation adds the pressure of a tilted
//! punch, E* theta x/(2 sqrt(a^2 - x^2)) (Johnson 1985, section 2.8), whose slope over the mean pressure P/(2 a) is E* theta a/P: (3/4) mu
//! (E*/E') H^2 a/w^3. Between round surfaces the rotation only moves the contact.
//!
//! Measured by a straight line through the pressure over 0.8 a: 4.3 and 7.9 % on flats of 0.071 and 0.110 mm of a worn ZIF tip, whose round
//! end is stiffer than the cantilever of this formula, 7.6 and 11.7 %; a peak 0.85 above the mean, 0.88 by the formula, on a flat of
//! 2.2 um of a slender slider, H/w = 2.4, at mu = 1.17.

use crate::law::elastic::{contact_modulus, plane_strain_compliance};
use crate::scene::{Drive, PRESSURE_TOLERANCES, Scene};
use crate::sides::Sides;

/// Skew of the pressure over the wider tolerance of pressures, of a coefficient of friction and a radius of relative curvature, mm, at
/// these worn depths, mm.
pub(super) fn indicator(scene: &Scene, friction: f64, radius: f64, depth: Sides<f64>) -> f64 {
    let amplitude = scene.motion.amplitude_mm().abs();
    let half_width = conforming_half_width(radius, amplitude, depth);
    skew(scene, friction, half_width) / PRESSURE_TOLERANCES
}

/// Slope of the pressure times the half-width a of conforming surfaces over their mean pressure, of a coefficient of friction.
fn skew(scene: &Scene, friction: f64, half_width: f64) -> f64 {
    // Driven as a whole, it does not bend.
    if scene.drive == Drive::WholeBody {
        return 0.0;
    }
    let shape = scene.slider.shape;
    let (height, thick) = (shape.height_mm, shape.half_width_mm);
    let share = contact_modulus(scene.slider.elastic, scene.receptacle.elastic)
        * plane_strain_compliance(scene.slider.elastic);
    0.75 * friction * share * height.powi(2) * half_width.min(thick) / thick.powi(3)
}

/// Half-width over which worn surfaces conform, mm: the slider's flat, sqrt(2 R h), and all of a scar that the stroke does not leave.
fn conforming_half_width(radius: f64, amplitude: f64, depth: Sides<f64>) -> f64 {
    let chord = |worn: f64| (2.0 * radius * worn).sqrt();
    let scar = chord(depth.slider + depth.receptacle);
    if amplitude <= scar {
        scar
    } else {
        chord(depth.slider)
    }
}
