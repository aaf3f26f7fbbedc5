//! Facts behind the indicator of an effect.

use super::basis::{Absence, AcrossWidth, Facts, Indicator};
use super::dimension::can_simulate;
use super::indicators::Indicators;
use super::plasticity::Yield;
use crate::law::elastic::contact_modulus;
use crate::scene::{Dimension, Effect, Scene};
use crate::sides::{Side, Sides};

/// The facts behind an indicator of an effect, which the budget may require; why there are none.
pub(super) fn facts(
    scene: &Scene,
    indicators: &Indicators<'_>,
    effect: Effect,
    indicator: Indicator,
    is_beyond_budget: bool,
) -> Result<Facts, Absence> {
    Ok(match effect {
        Effect::Elasticity => Facts::Deformation {
            modulus_mpa: contact_modulus(scene.slider.elastic, scene.receptacle.elastic),
            half_width_mm: indicators.hertz_half_width(),
        },
        Effect::Resistance => Facts::KnownConductor,
        Effect::SkinEffect => Facts::SkinDepth(indicators.skin_depth_mm()),
        Effect::FrictionalHeating => {
            let [mean_k, highest_k] = indicators.frictional_heat_k();
            Facts::FrictionalHeat {
                mean_k,
                highest_k,
                of_one_spot_k: indicators.heat_of_one_spot_k(),
            }
        }
        Effect::JouleHeating => Facts::JouleHeat(indicators.joule_heat_k()),
        Effect::AcrossWidth => Facts::AcrossWidth(across_width(scene, indicators)),
        Effect::SliderWear if scene.friction.follows_wear_of(Side::Slider) => Facts::FrictionByWear,
        Effect::ReceptacleWear if scene.friction.follows_wear_of(Side::Receptacle) => {
            Facts::FrictionByWear
        }
        Effect::Plasticity => {
            let unworn = Yield::of(scene).ok_or(Absence::UnknownHardness)?;
            let layers = scene.plating(unworn.side);
            let Sides { slider, receptacle } = indicators.worn_depth_at_end();
            Facts::Yield {
                unworn,
                layer_mm: layers.first().map(|layer| layer.thickness_mm),
                worn_mm: slider + receptacle,
            }
        }
        _ => Facts::Change {
            is_beyond_budget,
            is_stated_error: indicator.is_beyond_threshold()
                && effect.is_counted()
                && !can_simulate(scene, effect),
        },
    })
}

/// Distribution of the load across the width in the dimension of a scene.
fn across_width(scene: &Scene, indicators: &Indicators<'_>) -> AcrossWidth {
    match scene.dimension {
        Dimension::Point(_) => AcrossWidth::Point {
            half_length_mm: indicators.hertz_half_width(),
        },
        Dimension::Line(_) => AcrossWidth::Sections,
        Dimension::Extruded(_) => AcrossWidth::NodePlanes,
        Dimension::PlaneStrain => {
            let depth = indicators.worn_depth_at_end();
            AcrossWidth::Even {
                depth_mm: indicators.depth_of_life(depth),
                life_over_ball: 1.0 / indicators.life_of_ball(depth),
            }
        }
    }
}
