//! Reasons of decisions about effects, with their numbers.

use solver::effects::{AcrossWidth, Basis, Decision, Facts, Verdict, Yield};
use solver::scene::Effect;
use solver::sides::Sides;

use crate::words::absences;

/// The reason of a decision.
pub(crate) fn reason(decision: &Decision) -> String {
    let Decision {
        effect,
        verdict,
        basis,
        ..
    } = *decision;
    let (indicator, facts) = match basis {
        Basis::Nothing(absence) => return absences::absence(effect, absence),
        Basis::Missing(input) => return absences::missing(effect, input),
        Basis::Indicator(indicator, facts) => (indicator, facts),
    };
    let result = consequence(effect, verdict.is_on());
    let shares = [indicator.unworn, indicator.worn, indicator.threshold];
    let [unworn, worn, limit] = shares.map(percent);
    let heated = |heat: String| {
        format!("{heat}, which changes a wear rate by {unworn}, limit {limit}: {result}")
    };
    let text = match facts {
        Facts::Deformation {
            modulus_mpa,
            half_width_mm,
        } => {
            return format!(
                "contact modulus {modulus_mpa:.0} MPa, unworn Hertz half-width {half_width_mm:.3e} mm"
            );
        }
        Facts::KnownConductor if !verdict.is_on() => return "switched off".to_owned(),
        Facts::KnownConductor => {
            "force, resistivities and hardnesses are known; the wear does not depend on it"
                .to_owned()
        }
        Facts::SkinDepth(Sides { slider, receptacle }) => format!(
            "the current enters the slider by {slider:.2e} mm and the receptacle by {receptacle:.2e} mm: {unworn} more resistance, \
             limit {limit}: {result}"
        ),
        Facts::FrictionalHeat {
            mean_k,
            highest_k,
            of_one_spot_k,
        } => {
            let spot = of_one_spot_k.map_or_else(String::new, |kelvin| {
                format!(", one spot that carried all of the load by {kelvin:.2e} K")
            });
            heated(format!(
                "friction heats the unworn contact by {mean_k:.2e} K on average, {highest_k:.2e} K at most{spot}"
            ))
        }
        Facts::JouleHeat(kelvin) => heated(format!(
            "the current heats the unworn contact by {kelvin:.2e} K at most"
        )),
        Facts::AcrossWidth(found) => across_width(found, result),
        Facts::Yield {
            unworn,
            layer_mm,
            worn_mm,
        } => {
            let missed = missed_depth(layer_mm, worn_mm, unworn.depth_mm);
            yields(unworn, layer_mm.is_some(), indicator.threshold, &missed)
        }
        Facts::FrictionByWear => {
            format!("the coefficient of friction follows from its worn depth: {result}")
        }
        Facts::Change {
            is_beyond_budget,
            is_stated_error,
        } => {
            let together = if is_beyond_budget {
                ", and more than half of the tolerance together with all that is left out"
            } else {
                ""
            };
            let unavailable = if is_stated_error {
                "; it cannot be simulated here, and its change is part of the stated errors"
            } else {
                ""
            };
            format!(
                "{unworn} unworn, {worn} at the estimated end, limit {limit}{together}: {result}{unavailable}"
            )
        }
    };
    format!("{}{text}", switch(verdict))
}

/// Error of a result by an effect that is beyond its limit and not simulated.
pub(crate) fn missed(decision: &Decision) -> String {
    let calls = if decision.effect.is_available() && decision.is_available {
        "the scene calls for it"
    } else {
        "it is beyond its limit and not simulated"
    };
    format!("{calls}: {}", reason(decision))
}

/// The user's switch.
fn switch(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::ForcedOn => "switched on; ",
        Verdict::ForcedOff => "switched off; ",
        Verdict::Simulated | Verdict::Skipped | Verdict::InputMissing => "",
    }
}

/// The distribution of the load across the width.
fn across_width(found: AcrossWidth, result: &str) -> String {
    match found {
        AcrossWidth::Point { half_length_mm } => format!(
            "the contact of both curvatures is solved for, {half_length_mm:.2e} mm along the sliding direction"
        ),
        AcrossWidth::Sections => {
            "the contact is solved for in sections along its line, which only their forces couple"
                .to_owned()
        }
        AcrossWidth::NodePlanes => {
            "the bodies are solved for over their width, node plane by node plane".to_owned()
        }
        AcrossWidth::Even {
            depth_mm,
            life_over_ball,
        } => format!(
            "a tip as round across the width as along the section would be worn to {depth_mm:.2e} mm {life_over_ball:.0} times sooner, \
             one with a crown between both: {result}"
        ),
    }
}

/// The peak pressure beside hardnesses and the onset of yield, and the permanent depth that is left out.
fn yields(unworn: Yield, is_plated: bool, onset: f64, missed: &str) -> String {
    let (peak, ratio, name) = (unworn.peak_mpa, unworn.ratio(), unworn.side.name());
    let hardness = unworn.hardness;
    let of = if is_plated {
        format!(
            "the hardness that carries the contact on the {name}, {:.0} MPa ({:.2} times that of its outermost layer, {:.2} times that of its \
             base)",
            hardness.carrying,
            peak / hardness.outermost,
            peak / hardness.base
        )
    } else {
        format!("the hardness of the {name}, {:.0} MPa", hardness.carrying)
    };
    let result = consequence(Effect::Plasticity, false);
    let follows = if ratio <= onset {
        "it is elastic".to_owned()
    } else if ratio <= 1.0 {
        format!("what yields is enclosed by elastic matter; {result}")
    } else {
        format!(
            "{result}, which misses a permanent depth of about {:.1e} mm{missed}",
            unworn.depth_mm
        )
    };
    format!(
        "the peak pressure of the unworn contact, {peak:.0} MPa, is {ratio:.2} times {of}, and yield begins at {onset:.2} times: {follows}"
    )
}

/// A permanent depth as a share of what decides about the life: the outermost layer, or the worn depth of a bare side.
fn missed_depth(layer_mm: Option<f64>, worn_mm: f64, depth_mm: f64) -> String {
    match layer_mm {
        Some(thickness) => format!(
            ", {} of the outermost layer: its life is uncertain by as much",
            percent(depth_mm / thickness)
        ),
        None if worn_mm > 0.0 => format!(
            ", {} of the worn depth at the estimated end",
            percent(depth_mm / worn_mm)
        ),
        None => String::new(),
    }
}

/// The consequence of simulating an effect or leaving it out.
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
