//! Effects that a contact along a line can be simulated with: all of it slips, and nothing heats it.

use crate::scene::Effect;

/// Returns `true` if an effect can be simulated along a line.
pub(super) fn can_simulate(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::Elasticity
            | Effect::Friction
            | Effect::ReceptacleWear
            | Effect::SliderWear
            | Effect::Plating
            | Effect::ThermalSoftening
            | Effect::Relocation
            | Effect::SpringFading
            | Effect::AcrossWidth
    )
}
