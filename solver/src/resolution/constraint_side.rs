//! The body whose nodes carry the contact constraints.
//!
//! A nearly rigid body is not chosen: only the other one would deform under a pressure that alternates from node to
//! node, and between its own nodes not even that. Wear levels such a pressure as soon as it removes as much in an
//! increment as the other body deforms; a receptacle is worn by many cycles in each increment, at most by all of them.

use crate::scene::Scene;
use crate::sides::{Side, Sides};

/// Chooses the body for specific wear rates in 1/MPa, elements of a size, increments of a slip, and a path of all cycles, mm.
pub(super) fn choose(
    scene: &Scene,
    rates: Sides<f64>,
    gross: bool,
    element: f64,
    slip: f64,
    sliding: f64,
) -> Side {
    let tuning = &scene.accuracy.tuning;
    let moduli = Sides {
        slider: scene.slider.elastic.youngs_modulus_mpa,
        receptacle: scene.receptacle.elastic.youngs_modulus_mpa,
    };
    let is_rigid = |side: Side, slip: f64| {
        let softer = *moduli.of(side.other());
        softer < tuning.rigid_body * moduli.of(side) && rates.of(side) * slip < element / softer
    };
    let wears = if gross {
        rates.slider >= tuning.slider_constraints_gross * rates.receptacle
    } else {
        rates.slider > tuning.slider_constraints * rates.receptacle
    };
    if wears && rates.slider > 0.0 {
        if is_rigid(Side::Slider, slip) {
            Side::Receptacle
        } else {
            Side::Slider
        }
    } else if is_rigid(Side::Receptacle, sliding) {
        Side::Slider
    } else {
        Side::Receptacle
    }
}
