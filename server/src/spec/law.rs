//! Friction and wear, one file a law.

mod archard;
mod barwell;
mod coulomb;
mod definition;
mod dissipated_energy;
pub(super) mod friction_table;
mod frictionless;
mod load_repetition;
mod mechanism;
mod mild_oxidation;
mod oxidation;
mod power;
mod preset_friction;
mod quinn;
mod rhee;
mod saracibar;
mod sarkar;
mod severe_oxidation;
mod strain_hardening;
mod values;
mod wear_coefficient;
pub(super) mod wearing_side;

use std::ops::RangeInclusive;

use api::spec::{
    Friction, FrictionLaw, Interface, Material, Materials, Provenance, Spec, WearLaw, WearLawName,
};
use solver::scene;
use solver::sides::{Side, Sides};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::materials::{by_side, name};
use crate::spec::plating_choice::{PlatingChoice, wear_of};
use crate::spec::sourced::{Sourced, assumed, source};
use crate::spec::system::{ArchardPreset, Preset};
pub use definition::{Absent, ByFriction, LawDefinition, Number, Scaling, State};
use values::Values;
use wearing_side::WearingSide;

/// Hz, of a wear test: from creep to ultrasonic fretting.
const MEASURED_AT_HZ: RangeInclusive<f64> = 1e-6..=1e6;

const FRICTION: &str = "/interface/friction";

/// Returns the definition of a wear law.
pub fn definition(name: WearLawName) -> &'static LawDefinition {
    match name {
        WearLawName::Archard => &archard::DEFINITION,
        WearLawName::Sarkar => &sarkar::DEFINITION,
        WearLawName::Saracibar => &saracibar::DEFINITION,
        WearLawName::DissipatedEnergy => &dissipated_energy::DEFINITION,
        WearLawName::Barwell => &barwell::DEFINITION,
        WearLawName::Quinn => &quinn::DEFINITION,
        WearLawName::MildOxidation => &mild_oxidation::DEFINITION,
        WearLawName::SevereOxidation => &severe_oxidation::DEFINITION,
        WearLawName::Oxidation => &mechanism::DEFINITION,
        WearLawName::Rhee => &rhee::DEFINITION,
        WearLawName::LoadRepetition => &load_repetition::DEFINITION,
        WearLawName::StrainHardening => &strain_hardening::DEFINITION,
    }
}

/// Numbers of all wear laws with their ranges.
pub(super) fn numbers() -> Vec<(&'static str, RangeInclusive<f64>)> {
    let laws = WearLawName::ALL.into_iter();
    let numbers = laws.flat_map(|law| definition(law).numbers());
    let numbers = numbers.map(|number| (number.field, number.range.clone()));
    let mut numbers: Vec<_> = numbers
        .chain([("measured_at_hz", MEASURED_AT_HZ)])
        .collect();
    numbers.sort_unstable_by_key(|(field, _)| *field);
    numbers.dedup();
    numbers
}

/// The engine's laws.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Laws {
    pub(crate) friction: scene::Friction,
    pub(crate) wear: Sides<Option<scene::WearLaw>>,
}

/// Inputs of the laws besides the interface of a specification.
#[derive(Clone, Copy)]
pub(crate) struct LawDefaults<'a> {
    pub(crate) preset: &'a Preset,
    pub(super) plating_choices: Sides<PlatingChoice<'a>>,
    pub(crate) surroundings_c: f64,
}

/// Resolves friction and the wear of the bodies, below a plating where they are plated. `resolved` are the materials with their
/// properties.
pub(crate) fn resolve(
    spec: &Spec,
    resolved: &Materials,
    defaults: LawDefaults<'_>,
    diagnostics: &mut Diagnostics,
) -> (Interface, Laws) {
    let given = &spec.interface;
    let (materials, resolved) = (by_side(&spec.materials), by_side(resolved));
    let LawDefaults {
        preset,
        plating_choices,
        surroundings_c,
    } = defaults;
    let (friction, friction_law) = friction(given, materials, defaults, diagnostics);
    let coefficient = friction_law.unworn();
    let wear = Sides::from_fn(|at| {
        let law = wear_of(spec, at);
        let metal = Material::Named(preset.materials.of(at).value.to_owned());
        // The base of a preset that is plated is a metal as any other that is named.
        let is_plated =
            !preset.plating.of(at).is_empty() && *plating_choices.of(at) != PlatingChoice::Bare;
        let is_metal_of_preset = |material: &&Material| name(material) == name(&metal);
        let other = materials.of(at).filter(|given| !is_metal_of_preset(given));
        let side = WearingSide {
            pointer: format!("/interface/wear/{}", at.name()),
            given: *materials.of(at),
            resolved: *resolved.of(at),
            wears_as: other.or(is_plated.then_some(&metal)),
            surroundings_c,
        };
        let of_preset = *preset.wear.of(at);
        let default = match plating_choices.of(at) {
            // The law of the material that is plated, where the library lists one.
            PlatingChoice::Given(_) => {
                base_below_plating(&side).map_or(assumed(of_preset.value), Sourced::optional)
            }
            PlatingChoice::Preset(_) | PlatingChoice::Removed | PlatingChoice::Bare => of_preset,
        };
        wear(&side, law, default, coefficient, diagnostics)
    });
    let (slider, slider_law) = wear.slider;
    let (receptacle, receptacle_law) = wear.receptacle;
    let interface = Interface {
        friction: Some(friction),
        wear: api::spec::Sides {
            slider: Some(slider),
            receptacle: Some(receptacle),
        },
        ..given.clone()
    };
    let laws = Laws {
        friction: friction_law,
        wear: Sides {
            slider: slider_law,
            receptacle: receptacle_law,
        },
    };
    (interface, laws)
}

fn friction(
    given: &Interface,
    materials: Sides<Option<&Material>>,
    defaults: LawDefaults<'_>,
    diagnostics: &mut Diagnostics,
) -> (Friction, scene::Friction) {
    let of_preset =
        preset_friction::coefficient(materials, defaults.preset, defaults.plating_choices);
    let Some(given) = &given.friction else {
        return coulomb::from_preset(of_preset, diagnostics);
    };
    let law = diagnostics.enum_member(&format!("{FRICTION}/law"), &given.law);
    diagnostics.provenance(format!("{FRICTION}/law"), Provenance::Given);
    let law = match law {
        Some(FrictionLaw::Coulomb) => return coulomb::resolve(given, of_preset, diagnostics),
        Some(FrictionLaw::Frictionless) => frictionless::resolve(given, diagnostics),
        None => scene::Friction::Frictionless,
    };
    (given.clone(), law)
}

/// Resolves the wear law of a side.
fn wear(
    side: &WearingSide<'_>,
    given: Option<&Option<WearLaw>>,
    default: Sourced<Option<ArchardPreset>>,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (Option<WearLaw>, Option<scene::WearLaw>) {
    let unworn = match (given, default.present()) {
        (Some(Some(given)), preset) => {
            let given = archard::completed(side, given, preset);
            let (filled, law) = given_wear(side, &given.law, friction, diagnostics);
            for (pointer, provenance) in given.defaults {
                diagnostics.provenance(pointer, provenance);
            }
            return (Some(filled), law);
        }
        (None, Some(preset)) => {
            let (filled, law) = archard::from_preset(side, preset, diagnostics);
            return (Some(filled), Some(law));
        }
        (Some(None), _) => Provenance::Given,
        (None, None) => default.provenance,
    };
    diagnostics.provenance(&side.pointer, unworn);
    (None, None)
}

/// Adds a fault for the law of a base or a layer of a plating whose rate is not the same in every state: a plating wears through by
/// the dose that each of its layers takes.
pub(super) fn check_plated(
    pointer: &str,
    law: Option<scene::WearLaw>,
    diagnostics: &mut Diagnostics,
) {
    if law.is_some_and(|law| law.uniform().is_none()) {
        let uniform = WearLawName::ALL
            .into_iter()
            .filter(|law| definition(*law).is_uniform());
        let names: Vec<&str> = uniform.map(WearLawName::as_str).collect();
        let detail = format!(
            "a plating and its base wear by laws whose rate is the same in every state: {}; a bare part, with the `plating` `[]`, \
             wears by any",
            names.join(", ")
        );
        diagnostics.fault(pointer, detail);
    }
}

/// The same for the bases of plated sides.
pub(super) fn check_plated_sides(laws: &Laws, plated: Sides<bool>, diagnostics: &mut Diagnostics) {
    for side in Side::BOTH.into_iter().filter(|side| *plated.of(*side)) {
        let pointer = format!("/interface/wear/{}", side.name());
        check_plated(&pointer, *laws.wear.of(side), diagnostics);
    }
}

/// Adds faults for what a continuous motion cannot have: a slider that wears, a law that counts repetitions of the load.
pub(super) fn check_continuous(laws: &Laws, plated: Sides<bool>, diagnostics: &mut Diagnostics) {
    let wearing = [
        ("/plating/slider", plated.slider, "an empty list"),
        ("/interface/wear/slider", laws.wear.slider.is_some(), "null"),
    ];
    for (pointer, _, nothing) in wearing.into_iter().filter(|(_, wears, _)| *wears) {
        let detail = format!(
            "a slider whose surface runs past continuously cannot wear yet; write {nothing}"
        );
        diagnostics.fault(pointer, detail);
    }
    for side in Side::BOTH {
        let counts = |law: &scene::WearLaw| matches!(law, scene::WearLaw::Power(law) if law.counts_repetitions());
        if laws.wear.of(side).as_ref().is_some_and(counts) {
            let detail = "a continuous motion repeats no load; use a law of slip or of time";
            diagnostics.fault(&format!("/interface/wear/{}/law", side.name()), detail);
        }
    }
}

/// Resolves a wear law as given, beside a coefficient of friction.
pub(super) fn given_wear(
    side: &WearingSide<'_>,
    given: &WearLaw,
    friction: f64,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    let pointer = side.field("measured_at_hz");
    let measured_at_hz = diagnostics.optional(&pointer, given.measured_at_hz, &MEASURED_AT_HZ);
    let own = WearLaw {
        measured_at_hz: None,
        ..given.clone()
    };
    let values = Values::new(side, &own, friction);
    let name = diagnostics.enum_member(&side.field("law"), &given.law);
    diagnostics.provenance(side.field("law"), Provenance::Given);
    let (filled, law) = match name {
        Some(name) => definition(name).resolve(name, values, diagnostics),
        None => (values.law, None),
    };
    let filled = WearLaw {
        measured_at_hz,
        ..filled
    };
    (filled, law)
}

/// The law that the library lists for the material of a side.
pub(super) fn listed_wear(
    side: &WearingSide<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<(WearLaw, scene::WearLaw)> {
    let law = base_below_plating(side)?;
    Some(archard::from_preset(side, law, diagnostics))
}

/// The law of a material that the library lists a wear coefficient of: that of a preset belongs to the preset's plating.
fn base_below_plating(side: &WearingSide<'_>) -> Option<Sourced<ArchardPreset>> {
    let material = side.resolved_library()?;
    Some(source(ArchardPreset {
        k: material.archard_k?,
        hardness_mpa: material.properties.hardness_mpa?,
    }))
}

#[cfg(test)]
pub(in crate::spec) mod tests;
