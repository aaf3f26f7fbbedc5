//! Reasons of decisions, in words with their numbers.

use super::decision::{Indicator, Verdict};
use super::dimension::can_simulate;
use super::indicators::Indicators;
use super::plasticity::Yield;
use crate::scene::Effect;

use crate::law::elastic::contact_modulus;
use crate::scene::{Dimension, Scene};
use crate::sides::{Side, Sides};

/// Basis of a decision about an effect.
#[derive(Debug, Clone, Copy)]
pub(super) enum DecisionBasis {
    /// There is nothing to simulate.
    Nothing(&'static str),
    /// The specification lacks an input.
    Missing(&'static str),
    /// An indicator.
    Indicator(Indicator),
}

impl DecisionBasis {
    /// The indicator.
    pub(super) fn indicator(self) -> Option<Indicator> {
        match self {
            Self::Nothing(_) | Self::Missing(_) => None,
            Self::Indicator(indicator) => Some(indicator),
        }
    }
}

/// A decision, and what it is based on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Decided {
    pub(super) verdict: Verdict,
    pub(super) basis: DecisionBasis,
    /// True if the run or the budget requires the effect.
    pub(super) is_required: bool,
}

/// The reason of a decision.
pub(super) fn reason(
    scene: &Scene,
    indicators: &Indicators<'_>,
    effect: Effect,
    decided: Decided,
) -> String {
    let Decided {
        verdict,
        basis,
        is_required,
    } = decided;
    let indicator = match basis {
        DecisionBasis::Nothing(words) | DecisionBasis::Missing(words) => return words.to_owned(),
        DecisionBasis::Indicator(indicator) => indicator,
    };
    if effect == Effect::Elasticity {
        let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
        let half_width = indicators.hertz_half_width();
        return format!(
            "contact modulus {modulus:.0} MPa, unworn Hertz half-width {half_width:.3e} mm"
        );
    }
    if effect == Effect::Resistance {
        let switch = if verdict == Verdict::ForcedOn {
            "switched on; "
        } else {
            ""
        };
        return if verdict.is_on() {
            format!(
                "{switch}force, resistivities and hardnesses are known; the wear does not depend on it"
            )
        } else {
            "switched off".to_owned()
        };
    }
    let Indicator {
        unworn,
        worn,
        threshold,
    } = indicator;
    let switch = match verdict {
        Verdict::ForcedOn => "switched on; ",
        Verdict::ForcedOff => "switched off; ",
        Verdict::Simulated | Verdict::Skipped | Verdict::InputMissing => "",
    };
    if effect == Effect::SkinEffect {
        let Sides { slider, receptacle } = indicators.skin_depth_mm();
        return format!(
            "{switch}the current enters the slider by {slider:.2e} mm and the receptacle by {receptacle:.2e} mm: {} more resistance, \
             limit {}: {}",
            percent(unworn),
            percent(threshold),
            consequence(effect, false)
        );
    }
    if matches!(effect, Effect::FrictionalHeating | Effect::JouleHeating) {
        let heat = match effect {
            Effect::JouleHeating => format!(
                "the current heats the unworn contact by {:.2e} K at most",
                indicators.joule_heat_k()
            ),
            _ => frictional_heat(indicators),
        };
        return format!(
            "{switch}{heat}, which changes a wear rate by {}, limit {}: {}",
            percent(unworn),
            percent(threshold),
            consequence(effect, verdict.is_on())
        );
    }
    if effect == Effect::AcrossWidth {
        return format!("{switch}{}", across_width(scene, indicators));
    }
    if effect == Effect::Plasticity {
        return format!("{switch}{}", plasticity(scene, indicators, threshold));
    }
    let result = consequence(effect, verdict.is_on());
    if follows_friction(scene, effect) {
        return format!(
            "{switch}the coefficient of friction follows from its worn depth: {result}"
        );
    }
    let is_missed = effect.is_counted() && !can_simulate(scene, effect);
    let unavailable = if indicator.value() > threshold && is_missed {
        "; it cannot be simulated here, and its change is part of the stated errors"
    } else {
        ""
    };
    let together = if is_required && verdict == Verdict::Simulated {
        ", and more than half of the tolerance together with all that is left out"
    } else {
        ""
    };
    format!(
        "{switch}{} unworn, {} at the estimated end, limit {}{together}: {result}{unavailable}",
        percent(unworn),
        percent(worn),
        percent(threshold)
    )
}

/// Describes the distribution of the load across the width in a dimension.
fn across_width(scene: &Scene, indicators: &Indicators<'_>) -> String {
    match scene.dimension {
        Dimension::Point(_) => format!(
            "the contact of both curvatures is solved for, {:.2e} mm along the sliding direction",
            indicators.hertz_half_width()
        ),
        Dimension::Line(_) => {
            "the contact is solved for in sections along its line, which only their forces couple"
                .to_owned()
        }
        Dimension::Extruded(_) => {
            "the bodies are solved for over their width, node plane by node plane".to_owned()
        }
        Dimension::PlaneStrain => {
            let depth = indicators.worn_depth_at_end();
            format!(
                "a tip as round across the width as along the section would be worn to {:.2e} mm {:.0} times sooner, one with a crown \
                 between both: {}",
                indicators.depth_of_life(depth),
                1.0 / indicators.life_of_ball(depth),
                consequence(Effect::AcrossWidth, false)
            )
        }
    }
}

/// The peak pressure beside hardnesses and the onset of yield, and what the permanent depth that is left out means.
fn plasticity(scene: &Scene, indicators: &Indicators<'_>, onset: f64) -> String {
    let Some(unworn) = Yield::of(scene) else {
        return consequence(Effect::Plasticity, false).to_owned();
    };
    let (peak, ratio, name) = (unworn.peak_mpa, unworn.ratio(), unworn.side.name());
    let hardness = unworn.hardness;
    let layers = scene.plating(unworn.side);
    let of = if layers.is_empty() {
        format!("the hardness of the {name}, {:.0} MPa", hardness.carrying)
    } else {
        format!(
            "the hardness that carries the contact on the {name}, {:.0} MPa ({:.2} times that of its outermost layer, {:.2} times that of its \
             base)",
            hardness.carrying,
            peak / hardness.outermost,
            peak / hardness.base
        )
    };
    let follows = if ratio <= onset {
        "it is elastic".to_owned()
    } else if ratio <= 1.0 {
        format!(
            "what yields is enclosed by elastic matter; {}",
            consequence(Effect::Plasticity, false)
        )
    } else {
        let missed = missed_depth(
            layers.first().map(|layer| layer.thickness_mm),
            unworn.depth_mm,
            indicators,
        );
        format!(
            "{}, which misses a permanent depth of about {:.1e} mm{missed}",
            consequence(Effect::Plasticity, false),
            unworn.depth_mm
        )
    };
    format!(
        "the peak pressure of the unworn contact, {peak:.0} MPa, is {ratio:.2} times {of}, and yield begins at {onset:.2} times: {follows}"
    )
}

/// A permanent depth as a share of what decides about the life: the outermost layer, or the worn depth of a bare side.
fn missed_depth(layer_mm: Option<f64>, depth_mm: f64, indicators: &Indicators<'_>) -> String {
    let Sides { slider, receptacle } = indicators.worn_depth_at_end();
    let worn = slider + receptacle;
    match layer_mm {
        Some(thickness) => format!(
            ", {} of the outermost layer: its life is uncertain by as much",
            percent(depth_mm / thickness)
        ),
        None if worn > 0.0 => format!(
            ", {} of the worn depth at the estimated end",
            percent(depth_mm / worn)
        ),
        None => String::new(),
    }
}

/// Temperatures by friction in words.
fn frictional_heat(indicators: &Indicators<'_>) -> String {
    let [mean, most] = indicators.frictional_heat_k();
    let spot = indicators
        .heat_of_one_spot_k()
        .map_or_else(String::new, |kelvin| {
            format!(", one spot that carried all of the load by {kelvin:.2e} K")
        });
    format!(
        "friction heats the unworn contact by {mean:.2e} K on average, {most:.2e} K at most{spot}"
    )
}

/// Returns `true` if the coefficient of friction follows from the wear that an effect is.
fn follows_friction(scene: &Scene, effect: Effect) -> bool {
    match effect {
        Effect::SliderWear => scene.friction.follows_wear_of(Side::Slider),
        Effect::ReceptacleWear => scene.friction.follows_wear_of(Side::Receptacle),
        _ => false,
    }
}

/// The reason of an effect that a run has required.
pub(super) fn required_by_run(cycle: u64, value: Option<f64>) -> String {
    match value {
        Some(value) => format!(
            "required by the run: {} after cycle {cycle}",
            percent(value)
        ),
        None => format!("required by the run: no solution without it after cycle {cycle}"),
    }
}

/// Describes the consequence of simulating an effect or leaving it out.
fn consequence(effect: Effect, is_on: bool) -> &'static str {
    match (effect, is_on) {
        (Effect::Elasticity, _) => "both bodies deform",
        (Effect::Friction, true) => "the shear traction deforms both bodies",
        (Effect::Friction, false) => {
            "the contact is solved without shear, which follows from the pressure as mu p"
        }
        (Effect::StickMemory, true) => "each node sticks or slips, and the bodies deform along x",
        (Effect::StickMemory, false) => "each node slips as the slider is displaced",
        (Effect::ReceptacleWear | Effect::SliderWear, true) => "its surface wears",
        (Effect::ReceptacleWear | Effect::SliderWear, false) => "its surface does not wear",
        (Effect::Plating, true) => "each point wears through the layers by its dose",
        (Effect::Plating, false) => "the outermost layer alone wears",
        (Effect::ThermalSoftening, true) => "surfaces wear by their hardness at this temperature",
        (Effect::ThermalSoftening, false) => "surfaces wear by their hardness at 20 °C",
        (Effect::FrictionalHeating | Effect::JouleHeating, true) => {
            "surfaces wear by their hardness and laws at the temperature of the contact"
        }
        (Effect::FrictionalHeating | Effect::JouleHeating, false) => {
            "it is left out of the temperature of the contact"
        }
        (Effect::Relocation, true) => {
            "the mesh follows the worn surface and the stiffness is rebuilt"
        }
        (Effect::Relocation, false) => "the stiffness of the unworn bodies is used throughout",
        (Effect::SpringFading, true) => "the load decreases as the bodies wear",
        (Effect::SpringFading, false) => "the load is constant",
        (Effect::SkinEffect, _) => "the resistance to direct current is computed",
        (Effect::Resistance, true) => "the resistance of the worn contact is computed",
        (Effect::Resistance, false) => "the resistance of the contact is not computed",
        (Effect::GeometricNonlinearity, _) => "strains and rotations are taken as small",
        (Effect::Plasticity, _) => "it is simulated as elastic",
        (Effect::AcrossWidth, _) => {
            "the load is even across the width; `model.dimension` of `point` or `line` simulates it"
        }
        (
            Effect::Oxidation
            | Effect::Relaxation
            | Effect::Inertia
            | Effect::ThirdBody
            | Effect::MetalTransfer
            | Effect::Fatigue,
            _,
        ) => "it is left out",
    }
}

/// A relative change in percent.
fn percent(value: f64) -> String {
    let percent = 100.0 * value;
    if !percent.is_finite() {
        "without bound".to_owned()
    } else if percent == 0.0 || percent >= 0.01 {
        format!("{percent:.2} %")
    } else {
        format!("{percent:.0e} %")
    }
}
