//! Indicators of a point contact where they differ from those of a section, and the effects that it can be simulated with.
//!
//! A gross slip that reverses loses the displacement in which the contact slips only in part. The loop of friction of Mindlin and
//! Deresiewicz (1953) at the onset A_c of gross slip has a sixth of (9/10) (2 - nu) (mu F)^2/(G a), a tenth of the 4 mu F A_c that a
//! rigid contact has, so that 0.9 A_c of each amplitude A are lost.

use crate::closed_form::{PointScene, SlipRegime};
use crate::law::elastic::dundurs_beta;
use crate::scene::Effect;
use crate::scene::Scene;

/// Part of the displacement at the onset of gross slip that is lost at each reversal.
const LOST: f64 = 0.9;

/// The indicator of an effect of a point contact that differs from that of a section.
pub(super) fn value(scene: &Scene, effect: Effect) -> Option<f64> {
    scene.dimension.point()?;
    match effect {
        // Shear changes the pressure of unlike bodies, as in a section.
        Effect::Friction => {
            let beta = dundurs_beta(scene.slider.elastic, scene.receptacle.elastic, [false; 2]);
            Some((scene.largest_friction() * beta).powi(2))
        }
        Effect::StickMemory => {
            let contact = PointScene::of(scene, SlipRegime::Gross)?;
            let amplitude = contact.mean_amplitude_mm();
            Some(if amplitude > 0.0 {
                LOST * contact.onset_of_gross_slip_mm() / amplitude
            } else {
                0.0
            })
        }
        Effect::AcrossWidth => Some(1.0),
        Effect::Relocation => Some(0.0),
        _ => None,
    }
}

/// Returns `true` if an effect can be simulated in a point contact.
pub(super) fn can_simulate(scene: &Scene, effect: Effect) -> bool {
    match effect {
        Effect::Elasticity
        | Effect::ReceptacleWear
        | Effect::SliderWear
        | Effect::Plating
        | Effect::ThermalSoftening
        | Effect::SpringFading
        | Effect::Resistance
        | Effect::AcrossWidth => true,
        // Surfaces that stick in part wear in place: where a motion of a mission is too long for that, all of the contact slips in it.
        Effect::StickMemory => scene.blocks().iter().any(|block| {
            let contact = PointScene::of(block, SlipRegime::Partial);
            contact.is_some_and(|contact| contact.may_stick())
        }),
        _ => false,
    }
}
