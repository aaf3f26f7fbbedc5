//! Why there is nothing to simulate, and inputs that are missing.

use solver::effects::Absence;
use solver::scene::{Effect, MissingInput, MissingProperty};

/// Why an effect has nothing to simulate.
pub(super) fn absence(effect: Effect, absence: Absence) -> String {
    let words = match absence {
        Absence::NoWear(side) => {
            return format!(
                "the {} has no wear law, or one that wears nothing here",
                side.name()
            );
        }
        Absence::Frictionless => "there is no friction in the scene",
        Absence::FrictionOff => "friction acts on neither body, so that nothing sticks",
        Absence::NothingSlides => "nothing slides: the amplitude is 0",
        Absence::NothingWears => nothing_wears(effect),
        Absence::NotPlated => "neither body is plated",
        Absence::ReferenceTemperature => {
            "the contact is at 20 °C, at which hardnesses are measured"
        }
        Absence::NoRateByTemperature => {
            "no wear law here depends on the temperature, or a hardness on a known `melting_temperature_c`"
        }
        Absence::ResistanceOff => {
            "the resistance of the contact is switched off, from which it follows"
        }
        Absence::NoCurrent => "no current is given: `environment.current_a`",
        Absence::DirectCurrent => "the current is direct: `environment.frequency_hz` is not given",
        Absence::Conductor(property) => conductor(property),
        Absence::HalfSpaces => "half-spaces keep their stiffness",
        Absence::DeadLoad => "the load is a dead load",
        Absence::Sections => "the resistance of sections along a line is not computed",
        Absence::UnknownHardness => {
            "never simulated, and not estimated: give `hardness_mpa` of each material, of layers and bases"
        }
        Absence::UnknownWidth => {
            "never simulated: a dimple or a crown across the width carries the load on less of it and may wear through many times sooner"
        }
        Absence::WearLaw => "it is the wear law of a surface, and nothing beside it",
        Absence::NeverSimulated => never_simulated(effect),
    };
    words.to_owned()
}

/// Consequence for an effect of neither side wearing.
fn nothing_wears(effect: Effect) -> &'static str {
    match effect {
        Effect::Plating => "nothing wears, so no layer is worn through",
        Effect::Relocation => "nothing wears, so nothing moves the mesh",
        Effect::SpringFading => "nothing wears, so the spring keeps its load",
        Effect::AcrossWidth => "never simulated; nothing wears, so that no life depends on it",
        Effect::ThermalSoftening | Effect::FrictionalHeating | Effect::JouleHeating => {
            "nothing wears, so no hardness counts"
        }
        _ => "nothing wears",
    }
}

/// Where to account for an effect that is never simulated.
fn never_simulated(effect: Effect) -> &'static str {
    match effect {
        Effect::Oxidation => {
            "never simulated beside another wear law: name an oxidational one where films of oxide wear"
        }
        Effect::Relaxation => {
            "never simulated: lower the load to what the spring keeps over its life, a third less for phosphor bronze after 1 000 h at 150 °C"
        }
        Effect::Inertia => {
            "never simulated in a run; the slip of a `vibration` is derived with the mass before it"
        }
        Effect::ThirdBody => {
            "never simulated: the coefficient of wear contains the debris of its measurement"
        }
        Effect::MetalTransfer => {
            "never simulated: metal that transfers to the other surface, as prows of gold do, is counted as worn"
        }
        _ => "never simulated",
    }
}

/// The input that an effect lacks.
pub(super) fn missing(effect: Effect, input: MissingInput) -> String {
    let of = match input {
        MissingInput::Conductor(property) => return conductor(property).to_owned(),
        MissingInput::Conductivity => {
            return "the conductivities of the parts' materials are not all known: give `thermal_conductivity_w_mk`"
                .to_owned();
        }
        MissingInput::MeltingTemperature(_) if effect != Effect::ThermalSoftening => "the parts'",
        MissingInput::MeltingTemperature(of) => match (of.slider, of.receptacle) {
            (true, false) => "the slider's",
            (false, true) => "the receptacle's",
            _ => "both parts'",
        },
    };
    format!(
        "the melting temperatures of {of} materials are not all known: give `melting_temperature_c`"
    )
}

/// The property of the contact as a conductor that is not known.
fn conductor(property: MissingProperty) -> &'static str {
    match property {
        MissingProperty::All => "nothing is known about the contact as a conductor",
        MissingProperty::Force => {
            "the force on the contact is not known: give a load of the kind `force` with its `width_mm`"
        }
        MissingProperty::Resistivity => {
            "a resistivity is not known: give `resistivity_ohm_m` of each material"
        }
        MissingProperty::Hardness => {
            "a hardness is not known: give `hardness_mpa` of each material"
        }
    }
}
