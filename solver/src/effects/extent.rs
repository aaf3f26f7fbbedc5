//! The dimension that a contact of finite width requires.
//!
//! A slider of the width w whose surface recedes by a crown of the radius R_z, or by a tilt, touches all of its width once the wear h is
//! large against the height g = (w/2)^2/(2 R_z) + |tilt| w that recedes: its sections are then alike, and plane strain describes it
//! where g is below a fifth of the tolerance times h.
//!
//! A crown whose contact stays within the width is a point contact of half-spaces: sections along the width have the same wear where it is
//! long (depths within 1.4 % at half-lengths c/a = 8, 3.3 % at 2.8), at thirty times the cost. A contact that grows to the ends of the width,
//! sqrt(c^2 + 2 R_z h) > w/2, which half-spaces do not have, is a line of sections; so is a tilted one.
//!
//! a, c: Hertz' half-lengths along and across the sliding direction.

use crate::closed_form::expected_wear::{expected_cycles, worn_depth_after};
use crate::closed_form::half_lengths_mm;
use crate::closed_form::unworn_contact::hertz_half_width;
use crate::scene::Scene;

/// Largest height that recedes over the worn depth and the tolerance.
const SHARE: f64 = 0.2;

/// Extent of a slider across the sliding direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Width w, mm.
    pub width_mm: f64,
    /// Radius R_z of its crown, mm; none of a straight one.
    pub crown_radius_mm: Option<f64>,
    /// Tilt, mrad.
    pub tilt_mrad: f64,
}

/// Dimensions to choose from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// One section.
    PlaneStrain,
    /// Sections along a line.
    Line,
    /// A point contact of half-spaces.
    Point,
}

/// The dimension for a scene under its mean line load, which is also given as a point contact if it has a crown, with the reason.
pub fn choose(plane: &Scene, as_point: Option<&Scene>, extent: Extent) -> (Choice, String) {
    let Extent {
        width_mm,
        crown_radius_mm,
        tilt_mrad,
    } = extent;
    let half = 0.5 * width_mm;
    let crown = crown_radius_mm.map_or(0.0, |radius| half * half / (2.0 * radius));
    let recedes = crown + 1e-3 * tilt_mrad.abs() * width_mm;
    if recedes <= 0.0 {
        let reason = "neither a crown nor a tilt: all sections across the width are alike";
        return (Choice::PlaneStrain, reason.to_owned());
    }
    let depth = |scene: &Scene| {
        let hertz = hertz_half_width(scene);
        let cycles = expected_cycles(scene, hertz);
        let worn = worn_depth_after(scene, hertz, &scene.surface_wear(), cycles);
        worn.slider.max(worn.receptacle)
    };
    let limit = SHARE * plane.accuracy.tolerance * depth(plane);
    if recedes <= limit {
        let reason = format!(
            "crown and tilt recede by {recedes:.2e} mm over the width, below the limit of {limit:.2e} mm for the expected wear: all sections \
             wear alike"
        );
        return (Choice::PlaneStrain, reason);
    }
    let round = as_point.and_then(|scene| Some((scene, half_lengths_mm(scene)?)));
    let (Some((scene, (along, across))), Some(radius)) = (round, crown_radius_mm) else {
        let reason = format!(
            "the tilt recedes by {recedes:.2e} mm over the width, above the limit of {limit:.2e} mm for the expected wear: sections wear \
             unlike"
        );
        return (Choice::Line, reason);
    };
    let aspect = across / along;
    let worn = (across * across + 2.0 * radius * depth(scene)).sqrt();
    if tilt_mrad != 0.0 {
        let reason = "sections across a tilted width touch one after the other";
        (Choice::Line, reason.to_owned())
    } else if worn > half {
        let reason = format!(
            "the contact is expected to grow to {worn:.2e} mm to either side, beyond the ends of the width at {half:.2e} mm, which half-spaces \
             do not have"
        );
        (Choice::Line, reason)
    } else {
        let reason = format!(
            "the contact, {aspect:.1} times as long across the sliding direction as along it before any wear, is expected to stay within the width \
             ({worn:.2e} of {half:.2e} mm to either side): it is one of half-spaces"
        );
        (Choice::Point, reason)
    }
}
