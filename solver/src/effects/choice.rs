//! The decision about each effect: nothing to simulate, the user's switch, what the run has required, its indicator.

use super::decision::{Decision, Indicator, Verdict};
use super::dimension::can_simulate;
use super::indicators::Indicators;
use super::plasticity::Yield;
use super::reason::{Decided, DecisionBasis, reason};
use super::small_strain;
use crate::scene::Effect;

use crate::law::surface::SurfaceWear;
use crate::scene::{Body, Conduction, Scene, Softening, SurfaceEffects, WearLaw};
use crate::sides::Sides;

/// Largest indicator of a skipped effect over the tolerance. Arbitrary: five effects at this limit exceed their budget
/// twice.
const SHARE: f64 = 0.2;
/// Deepest wear over the thickness of the outermost layer from which on the layers below are simulated: those of a later cycle
/// are reached within a jump. Arbitrary.
const LAYER_SHARE: f64 = 0.8;

/// Decides about all effects, some of which the run or the budget requires.
pub(super) fn decide(
    scene: &Scene,
    indicators: &Indicators<'_>,
    required: &[Effect],
) -> Vec<Decision> {
    let mut decisions: Vec<Decision> = Vec::with_capacity(Effect::ALL.len());
    for &effect in Effect::ALL {
        let is_on = |effect| {
            decisions
                .iter()
                .any(|decision| decision.effect == effect && decision.verdict.is_on())
        };
        let nothing = nothing_to_simulate(scene, effect, is_on);
        let missing =
            missing_input(scene, effect).or_else(|| missing_heat(scene, indicators, effect));
        let basis = match (nothing, missing) {
            (Some(nothing), _) => DecisionBasis::Nothing(nothing),
            (None, Some(missing)) => DecisionBasis::Missing(missing),
            (None, None) => DecisionBasis::Indicator(indicator(scene, indicators, effect)),
        };
        let is_required = required.contains(&effect);
        let verdict = verdict(scene, effect, basis, is_required);
        decisions.push(Decision {
            effect,
            verdict,
            indicator: basis.indicator(),
            is_available: can_simulate(scene, effect),
            reason: reason(
                scene,
                indicators,
                effect,
                Decided {
                    verdict,
                    basis,
                    is_required,
                },
            ),
        });
    }
    decisions
}

fn verdict(scene: &Scene, effect: Effect, basis: DecisionBasis, is_required: bool) -> Verdict {
    let switch = scene.effects.of(effect);
    let indicator = match basis {
        DecisionBasis::Nothing(_) => return Verdict::Skipped,
        DecisionBasis::Missing(_) if switch == Some(false) => return Verdict::ForcedOff,
        DecisionBasis::Missing(_) => return Verdict::InputMissing,
        DecisionBasis::Indicator(indicator) => indicator,
    };
    // Sticking needs shear.
    let needed = effect == Effect::Friction && scene.effects.of(Effect::StickMemory) == Some(true);
    match switch {
        Some(true) => Verdict::ForcedOn,
        Some(false) => Verdict::ForcedOff,
        None if !can_simulate(scene, effect) => Verdict::Skipped,
        None if is_required || needed || indicator.value() > indicator.threshold => {
            Verdict::Simulated
        }
        None => Verdict::Skipped,
    }
}

fn indicator(scene: &Scene, indicators: &Indicators<'_>, effect: Effect) -> Indicator {
    let accuracy = &scene.accuracy;
    Indicator {
        unworn: indicators.value(effect, Sides::default()),
        worn: indicators.value(effect, indicators.worn_depth_at_end()),
        threshold: match effect {
            Effect::Elasticity | Effect::Resistance => 0.0,
            Effect::AcrossWidth if scene.dimension.is_finite() => 0.0,
            Effect::GeometricNonlinearity => small_strain::limit(scene),
            Effect::Plasticity => indicators.onset_of_yield(),
            Effect::Plating => LAYER_SHARE,
            _ => SHARE * accuracy.tolerance,
        },
    }
}

/// Returns `true` if the surface of a body wears by its law or plating.
fn wears_by_law<S>(scene: &Scene, body: &Body<S>) -> bool {
    let motion = scene.timed_motion();
    let wears = |wear: SurfaceWear| {
        let fastest = wear.during(motion.fastest(), 0.0);
        fastest.uniform().is_none_or(|rate| rate > 0.0)
    };
    let all = SurfaceEffects {
        plating: true,
        softening: true,
    };
    body.surface_wear(all, motion.constant()).is_some_and(wears)
}

fn is_point(scene: &Scene) -> bool {
    scene.dimension.point().is_some()
}

fn is_plated(scene: &Scene) -> bool {
    !scene.slider.plating.is_empty() || !scene.receptacle.plating.is_empty()
}

fn is_at_reference(scene: &Scene) -> bool {
    let softening = [&scene.slider.softening, &scene.receptacle.softening];
    softening.iter().all(|side| side.ratios.is_empty())
}

/// Returns `true` if a temperature of the contact changes a wear rate by what is known.
fn heat_counts(scene: &Scene) -> bool {
    let softens = [&scene.slider.softening, &scene.receptacle.softening];
    let laws = [scene.slider.wear, scene.receptacle.wear];
    softens
        .iter()
        .any(|side| side.margin_k().is_some() || side.lacks_melting)
        || laws.into_iter().flatten().any(|law| law.heated(1.0) != law)
}

/// Names the input that a specification lacks for an effect that matters.
fn missing_input(scene: &Scene, effect: Effect) -> Option<&'static str> {
    let unknown = [&scene.slider.softening, &scene.receptacle.softening].map(Softening::is_unknown);
    match (effect, unknown) {
        (Effect::ThermalSoftening, [true, true]) => Some(
            "the melting temperatures of both parts' materials are not all known: give `melting_temperature_c`",
        ),
        (Effect::ThermalSoftening, [true, false]) => Some(
            "the melting temperatures of the slider's materials are not all known: give `melting_temperature_c`",
        ),
        (Effect::ThermalSoftening, [false, true]) => Some(
            "the melting temperatures of the receptacle's materials are not all known: give `melting_temperature_c`",
        ),
        (Effect::Resistance, _) => match scene.conduction {
            Conduction::Unknown {
                missing,
                is_requested: true,
            } => Some(missing),
            _ => None,
        },
        _ => None,
    }
}

/// Names the input that a scene lacks for heat that could matter, or is to be simulated.
fn missing_heat(
    scene: &Scene,
    indicators: &Indicators<'_>,
    effect: Effect,
) -> Option<&'static str> {
    let lacks = match effect {
        Effect::FrictionalHeating => scene.heat_lacks(true)?,
        Effect::JouleHeating => scene.heat_lacks(false)?,
        _ => return None,
    };
    let could_matter =
        indicators.possible_change_by_heat(effect) > SHARE * scene.accuracy.tolerance;
    (could_matter || scene.effects.of(effect) == Some(true)).then_some(lacks)
}

/// Why there is nothing to simulate, beside the effects that are on already.
fn nothing_to_simulate(
    scene: &Scene,
    effect: Effect,
    is_on: impl Fn(Effect) -> bool,
) -> Option<&'static str> {
    let wears = || is_on(Effect::ReceptacleWear) || is_on(Effect::SliderWear);
    let slides = scene.motion.distance_per_cycle_mm() > 0.0;
    let wear = |has_law: bool, without: &'static str| match (has_law, slides) {
        (false, _) => Some(without),
        (true, false) => Some("nothing slides: the amplitude is 0"),
        (true, true) => None,
    };
    match effect {
        Effect::Friction | Effect::StickMemory | Effect::FrictionalHeating
            if !scene.has_friction() =>
        {
            Some("there is no friction in the scene")
        }
        Effect::StickMemory if !is_on(Effect::Friction) && !is_point(scene) => {
            Some("friction acts on neither body, so that nothing sticks")
        }
        Effect::ReceptacleWear => wear(
            wears_by_law(scene, &scene.receptacle),
            "the receptacle has no wear law, or one that wears nothing here",
        ),
        Effect::SliderWear => wear(
            wears_by_law(scene, &scene.slider),
            "the slider has no wear law, or one that wears nothing here",
        ),
        Effect::Plating if !is_plated(scene) => Some("neither body is plated"),
        Effect::Plating if !wears() => Some("nothing wears, so no layer is worn through"),
        Effect::ThermalSoftening if is_at_reference(scene) => {
            Some("the contact is at 20 °C, at which hardnesses are measured")
        }
        Effect::ThermalSoftening | Effect::FrictionalHeating | Effect::JouleHeating if !wears() => {
            Some("nothing wears, so no hardness counts")
        }
        Effect::FrictionalHeating | Effect::JouleHeating if !heat_counts(scene) => Some(
            "no wear law here depends on the temperature, or a hardness on a known `melting_temperature_c`",
        ),
        Effect::JouleHeating if scene.effects.of(Effect::Resistance) == Some(false) => {
            Some("the resistance of the contact is switched off, from which it follows")
        }
        Effect::JouleHeating => match &scene.conduction {
            Conduction::Known(electrical) if electrical.current_a.is_none() => {
                Some("no current is given: `environment.current_a`")
            }
            Conduction::Known(_) => None,
            Conduction::Unknown { missing, .. } => Some(missing),
        },
        Effect::Relocation if is_point(scene) => Some("half-spaces keep their stiffness"),
        Effect::Relocation if !wears() => Some("nothing wears, so nothing moves the mesh"),
        Effect::SpringFading if scene.spring_n_per_mm2 <= 0.0 => Some("the load is a dead load"),
        Effect::Resistance if scene.dimension.has_sections() => {
            Some("the resistance of sections along a line is not computed")
        }
        Effect::Resistance => match scene.conduction {
            Conduction::Unknown {
                missing,
                is_requested: false,
            } => Some(missing),
            _ => None,
        },
        Effect::SkinEffect => match &scene.conduction {
            Conduction::Unknown { missing, .. } => Some(missing),
            Conduction::Known(electrical) if electrical.frequency_hz.is_none() => {
                Some("the current is direct: `environment.frequency_hz` is not given")
            }
            Conduction::Known(_) => None,
        },
        Effect::SpringFading if !wears() => Some("nothing wears, so the spring keeps its load"),
        Effect::Plasticity if Yield::of(scene).is_none() => Some(
            "never simulated, and not estimated: give `hardness_mpa` of each material, of layers and bases",
        ),
        Effect::AcrossWidth if scene.dimension.is_finite() => None,
        Effect::AcrossWidth if !wears() => {
            Some("never simulated; nothing wears, so that no life depends on it")
        }
        Effect::AcrossWidth if scene.conduction.known().is_none() => Some(
            "never simulated: a dimple or a crown across the width carries the load on less of it and may wear through many times sooner",
        ),
        _ => never_simulated(scene, effect),
    }
}

/// Why an effect is named without a number.
fn never_simulated(scene: &Scene, effect: Effect) -> Option<&'static str> {
    match effect {
        Effect::Oxidation if oxidises(scene) => {
            Some("it is the wear law of a surface, and nothing beside it")
        }
        Effect::Oxidation => Some(
            "never simulated beside another wear law: name an oxidational one where films of oxide wear",
        ),
        Effect::Relaxation => Some(
            "never simulated: lower the load to what the spring keeps over its life, a third less for phosphor bronze after 1 000 h at 150 °C",
        ),
        Effect::Inertia => Some(
            "never simulated in a run; the slip of a `vibration` is derived with the mass before it",
        ),
        Effect::ThirdBody => {
            Some("never simulated: the coefficient of wear contains the debris of its measurement")
        }
        Effect::MetalTransfer => Some(
            "never simulated: metal that transfers to the other surface, as prows of gold do, is counted as worn",
        ),
        Effect::Fatigue => Some("never simulated"),
        _ => None,
    }
}

/// Returns `true` if a surface wears by an oxidational law.
fn oxidises(scene: &Scene) -> bool {
    let laws = [scene.slider.wear, scene.receptacle.wear];
    laws.iter()
        .any(|law| matches!(law, Some(WearLaw::OfSpeed(_))))
}
