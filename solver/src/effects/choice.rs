//! The decision about each effect: nothing to simulate, the user's switch, what the run has required, its indicator.

use super::basis::{Absence, Basis, Indicator};
use super::decision::{Decision, Verdict};
use super::dimension::can_simulate;
use super::facts::facts;
use super::indicators::Indicators;
use super::small_strain;
use crate::law::surface::SurfaceWear;
use crate::scene::{Body, Conduction, Effect, MissingInput, Scene, SurfaceEffects, WearLaw};
use crate::sides::{Side, Sides};

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
        let is_required = required.contains(&effect);
        let basis = match (nothing, missing) {
            (Some(nothing), _) => Basis::Nothing(nothing),
            (None, Some(missing)) => Basis::Missing(missing),
            (None, None) => {
                let indicator = indicator(scene, indicators, effect);
                match facts(scene, indicators, effect, indicator, is_required) {
                    Ok(facts) => Basis::Indicator(indicator, facts),
                    Err(nothing) => Basis::Nothing(nothing),
                }
            }
        };
        decisions.push(Decision {
            effect,
            verdict: verdict(scene, effect, basis, is_required),
            is_available: can_simulate(scene, effect),
            basis,
        });
    }
    decisions
}

fn verdict(scene: &Scene, effect: Effect, basis: Basis, is_required: bool) -> Verdict {
    let switch = scene.effects.of(effect);
    let indicator = match basis {
        Basis::Nothing(_) => return Verdict::Skipped,
        Basis::Missing(_) if switch == Some(false) => return Verdict::ForcedOff,
        Basis::Missing(_) => return Verdict::InputMissing,
        Basis::Indicator(indicator, _) => indicator,
    };
    // Sticking needs shear.
    let needed = effect == Effect::Friction && scene.effects.of(Effect::StickMemory) == Some(true);
    match switch {
        Some(true) => Verdict::ForcedOn,
        Some(false) => Verdict::ForcedOff,
        None if !can_simulate(scene, effect) => Verdict::Skipped,
        None if is_required || needed || indicator.is_beyond_threshold() => Verdict::Simulated,
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

/// Returns the input that a scene lacks for an effect that matters.
fn missing_input(scene: &Scene, effect: Effect) -> Option<MissingInput> {
    match effect {
        Effect::ThermalSoftening => {
            let unknown = Sides {
                slider: scene.slider.softening.is_unknown(),
                receptacle: scene.receptacle.softening.is_unknown(),
            };
            let is_missing = unknown.slider || unknown.receptacle;
            is_missing.then_some(MissingInput::MeltingTemperature(unknown))
        }
        Effect::Resistance => match scene.conduction {
            Conduction::Unknown {
                missing,
                is_requested: true,
            } => Some(MissingInput::Conductor(missing)),
            _ => None,
        },
        _ => None,
    }
}

/// Returns the input that a scene lacks for heat that could matter, or is to be simulated.
fn missing_heat(
    scene: &Scene,
    indicators: &Indicators<'_>,
    effect: Effect,
) -> Option<MissingInput> {
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
) -> Option<Absence> {
    let wears = || is_on(Effect::ReceptacleWear) || is_on(Effect::SliderWear);
    let slides = scene.motion.distance_per_cycle_mm() > 0.0;
    let wear = |has_law: bool, side: Side| match (has_law, slides) {
        (false, _) => Some(Absence::NoWear(side)),
        (true, false) => Some(Absence::NothingSlides),
        (true, true) => None,
    };
    match effect {
        Effect::Friction | Effect::StickMemory | Effect::FrictionalHeating
            if !scene.has_friction() =>
        {
            Some(Absence::Frictionless)
        }
        Effect::StickMemory if !is_on(Effect::Friction) && !is_point(scene) => {
            Some(Absence::FrictionOff)
        }
        Effect::ReceptacleWear => wear(wears_by_law(scene, &scene.receptacle), Side::Receptacle),
        Effect::SliderWear => wear(wears_by_law(scene, &scene.slider), Side::Slider),
        Effect::Plating if !is_plated(scene) => Some(Absence::NotPlated),
        Effect::ThermalSoftening if is_at_reference(scene) => Some(Absence::ReferenceTemperature),
        Effect::Plating
        | Effect::ThermalSoftening
        | Effect::FrictionalHeating
        | Effect::JouleHeating
            if !wears() =>
        {
            Some(Absence::NothingWears)
        }
        Effect::FrictionalHeating | Effect::JouleHeating if !heat_counts(scene) => {
            Some(Absence::NoRateByTemperature)
        }
        Effect::JouleHeating if scene.effects.of(Effect::Resistance) == Some(false) => {
            Some(Absence::ResistanceOff)
        }
        Effect::JouleHeating => match &scene.conduction {
            Conduction::Known(electrical) if electrical.current_a.is_none() => {
                Some(Absence::NoCurrent)
            }
            Conduction::Known(_) => None,
            Conduction::Unknown { missing, .. } => Some(Absence::Conductor(*missing)),
        },
        Effect::Relocation if is_point(scene) => Some(Absence::HalfSpaces),
        Effect::SpringFading if scene.spring_n_per_mm2 <= 0.0 => Some(Absence::DeadLoad),
        Effect::AcrossWidth if scene.dimension.is_finite() => None,
        Effect::Relocation | Effect::SpringFading | Effect::AcrossWidth if !wears() => {
            Some(Absence::NothingWears)
        }
        Effect::Resistance if scene.dimension.has_sections() => Some(Absence::Sections),
        Effect::Resistance => match scene.conduction {
            Conduction::Unknown {
                missing,
                is_requested: false,
            } => Some(Absence::Conductor(missing)),
            _ => None,
        },
        Effect::SkinEffect => match &scene.conduction {
            Conduction::Unknown { missing, .. } => Some(Absence::Conductor(*missing)),
            Conduction::Known(electrical) if electrical.frequency_hz.is_none() => {
                Some(Absence::DirectCurrent)
            }
            Conduction::Known(_) => None,
        },
        Effect::AcrossWidth if scene.conduction.known().is_none() => Some(Absence::UnknownWidth),
        Effect::Oxidation if oxidises(scene) => Some(Absence::WearLaw),
        Effect::Oxidation
        | Effect::Relaxation
        | Effect::Inertia
        | Effect::ThirdBody
        | Effect::MetalTransfer
        | Effect::Fatigue => Some(Absence::NeverSimulated),
        _ => None,
    }
}

/// Returns `true` if a surface wears by an oxidational law.
fn oxidises(scene: &Scene) -> bool {
    let laws = [scene.slider.wear, scene.receptacle.wear];
    laws.iter()
        .any(|law| matches!(law, Some(WearLaw::OfSpeed(_))))
}
