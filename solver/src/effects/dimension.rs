//! Effects by the dimension of a scene: indicators that differ from those of a section, and the effects that can be simulated.

use super::{line, point};
use crate::scene::Effect;
use crate::scene::{Dimension, Scene};

/// The indicator of an effect where it differs from that of a section.
pub(super) fn value(scene: &Scene, effect: Effect) -> Option<f64> {
    match scene.dimension {
        Dimension::PlaneStrain => None,
        Dimension::Point(_) => point::value(scene, effect),
        Dimension::Line(_) | Dimension::Extruded(_) => {
            (effect == Effect::AcrossWidth).then_some(1.0)
        }
    }
}

/// Returns `true` if an effect can be simulated in a scene.
pub(super) fn can_simulate(scene: &Scene, effect: Effect) -> bool {
    match scene.dimension {
        Dimension::PlaneStrain => effect.is_available(),
        Dimension::Point(_) => point::can_simulate(scene, effect),
        Dimension::Line(_) | Dimension::Extruded(_) => line::can_simulate(effect),
    }
}
