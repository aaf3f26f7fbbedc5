//! The unworn contact by closed forms: its half-width, peak pressure and approach, and the displacement at which it slips.
//!
//! Hertz' half-width is a = sqrt(4 P R / (pi E*)) with 1/R = 1/R_slider + 1/R_crown (Johnson 1985, eq. 4.43).

use std::f64::consts::PI;

use super::line_contact;
use crate::closed_form::{PointScene, SlipRegime};
use crate::law::elastic::contact_modulus;
use crate::scene::Effect;
use crate::scene::{Drive, Elastic, Motion, Scene, SliderShape};

/// Half-width of the unworn contact, mm: Hertz' of a section, the half-length along the sliding direction of a point contact.
pub fn hertz_half_width(scene: &Scene) -> f64 {
    if let Some(contact) = PointScene::of(scene, SlipRegime::Gross) {
        return contact.half_lengths_mm().0;
    }
    let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
    (4.0 * scene.load_n_per_mm * radius(scene) / (PI * modulus)).sqrt()
}

/// Hertz' half-width of the most loaded section along a line, mm.
pub fn largest_half_width(scene: &Scene) -> f64 {
    hertz_half_width(scene) * root_of_largest_load(scene)
}

/// Half-width and pressure of the most loaded section over those under the mean load: both go with the root of the load.
fn root_of_largest_load(scene: &Scene) -> f64 {
    (line_contact::largest_line_load(scene) / scene.load_n_per_mm).sqrt()
}

/// Hertz' peak pressure of the unworn contact, MPa: 2 P/(pi a) of a section, and of the most loaded one along a line; 3 F/(2 pi a b) of a
/// point contact.
pub fn hertz_peak_pressure(scene: &Scene) -> f64 {
    if let Some(contact) = PointScene::of(scene, SlipRegime::Gross) {
        let (along, across) = contact.half_lengths_mm();
        return 1.5 * contact.force_n / (PI * along * across);
    }
    let mean = 2.0 * scene.load_n_per_mm / (PI * hertz_half_width(scene));
    mean * root_of_largest_load(scene)
}

/// Radius R of the relative curvature of both bodies, mm.
pub(crate) fn radius(scene: &Scene) -> f64 {
    let crown = scene.receptacle.shape.crown_radius_mm;
    1.0 / (1.0 / scene.slider.shape.radius_mm + crown.map_or(0.0, |crown| 1.0 / crown))
}

/// Approach of the bodies under the load, mm:  P / (pi E*) (2 ln(4 H/a) - 1)  with the lower body height H (Johnson
/// 1985, section 5.6, for a strip under a line load).
pub(crate) fn approach(scene: &Scene, half_width: f64, modulus: f64) -> f64 {
    let height = scene
        .slider
        .shape
        .height_mm
        .min(scene.receptacle.shape.height_mm);
    scene.load_n_per_mm / (PI * modulus) * strip(height, half_width)
}

/// 2 ln(4 H/a) - 1, or 0 where the strip is no higher than the contact is wide.
fn strip(height: f64, half_width: f64) -> f64 {
    (2.0 * (4.0 * height / half_width).ln() - 1.0).max(0.0)
}

/// Imposed displacement at which all of the contact slips, mm: the largest mu P of the run times the compliance of both bodies
/// to a tangential force on their surfaces. Near the contact it is the normal one, of a strip; a body of height H and half-width w
/// besides shears and bends like a beam that is held at its far face (Timoshenko), with G = E/(2 (1 + nu)) and E' =
/// E/(1 - nu^2):
///   E' delta / Q = (2 ln(4 min(H, w)/a) - 1) / pi + H^3 / (2 w^3) + 1.2 H / (w (1 - nu)).
/// A slider whose nodes are all displaced does not deform along x.
pub(crate) fn gross_slip(scene: &Scene, half_width: f64) -> f64 {
    let compliance = |elastic: Elastic, height: f64, half: f64| {
        let Elastic {
            youngs_modulus_mpa,
            poisson_ratio,
        } = elastic;
        let slender = height / half;
        let beam = 0.5 * slender.powi(3) + 1.2 * slender / (1.0 - poisson_ratio);
        (1.0 - poisson_ratio * poisson_ratio) / youngs_modulus_mpa
            * (strip(height.min(half), half_width) / PI + beam)
    };
    let (slider, block) = (&scene.slider, &scene.receptacle);
    let upper = match scene.drive {
        Drive::Handle => {
            let SliderShape {
                half_width_mm,
                height_mm,
                ..
            } = slider.shape;
            compliance(slider.elastic, height_mm, half_width_mm)
        }
        Drive::WholeBody => 0.0,
    };
    let half_block = 0.5 * block.shape.length_mm;
    let lower = compliance(block.elastic, block.shape.height_mm, half_block);
    scene.largest_friction() * scene.load_n_per_mm * (upper + lower)
}

/// Returns `true` if part of the contact may stick through the whole stroke: the amplitude is below twice the displacement of
/// gross slip.
pub(crate) fn sticks(scene: &Scene, half_width: f64) -> bool {
    let amplitude_mm = match scene.motion {
        Motion::Reciprocating { amplitude_mm, .. } => amplitude_mm,
        Motion::Periodic { turns, .. } => 0.5 * turns.shortest_mm(),
        Motion::Continuous { .. } => return false,
    };
    let is_off = |effect| scene.effects.of(effect) == Some(false);
    if is_off(Effect::Friction) || is_off(Effect::StickMemory) {
        return false;
    }
    amplitude_mm < 2.0 * gross_slip(scene, half_width)
}
