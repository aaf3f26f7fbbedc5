//! Switches of physical effects, and the checks of a scene against them.

use std::collections::BTreeMap;

use api::problem::Fault;
use api::spec::{EnumValue, Switch};
use solver::effects::{EffectsPlan, Verdict, small_strain};
use solver::law::softening::MOLTEN;
use solver::scene::{Effect, Switches};
use solver::scene::{Friction, Scene};

use crate::spec::diagnostics::{Diagnostics, shortened};
use crate::spec::suggestion::did_you_mean;
use crate::words::{decisions, effects};

/// Names of all effects.
pub(crate) fn names() -> Vec<&'static str> {
    Effect::ALL.iter().copied().map(effects::name).collect()
}

/// Switches by the name of their effect; an absent one is `auto`.
type Given = BTreeMap<String, EnumValue<Switch>>;

/// Checks the switches, and returns those of the effects that the engine knows.
pub(crate) fn resolve(given: &Given, diagnostics: &mut Diagnostics) -> Switches {
    let mut switches = Switches::default();
    for (name, switch) in given {
        let pointer = format!("/effects/{}", api::spec::pointer_token(name));
        let mut effects = Effect::ALL.iter().copied();
        let effect = effects.find(|effect| effects::name(*effect) == name);
        if effect.is_none() {
            let names = names();
            let detail = format!(
                "`{}` is no effect; effects are {}{}",
                shortened(name),
                names.join(", "),
                did_you_mean(name, names.iter().copied())
            );
            diagnostics.fault(&pointer, detail);
            continue;
        }
        match (diagnostics.enum_member(&pointer, switch), effect) {
            (Some(Switch::On), effect) if !effect.is_some_and(Effect::is_available) => {
                diagnostics.fault(&pointer, format!("`{name}` is never simulated"));
            }
            (Some(Switch::Off), Some(Effect::Elasticity)) => {
                diagnostics.fault(
                    &pointer,
                    "cannot be off: pressure and width of the contact follow from it",
                );
            }
            (Some(Switch::On), Some(effect)) => switches = switches.with(effect, true),
            (Some(Switch::Off), Some(effect)) => switches = switches.with(effect, false),
            _ => {}
        }
    }
    let on = |effect| switches.of(effect);
    if (on(Effect::Friction), on(Effect::StickMemory)) == (Some(false), Some(true)) {
        let detail = "cannot be on while `friction` is off: nothing sticks without friction";
        diagnostics.fault("/effects/stick_memory", detail);
    }
    switches
}

/// Checks a scene against the switches. `cause` is the pointer of the field that causes strains beyond the limit.
pub(crate) fn check(
    given: &Given,
    scene: &Scene,
    cause: impl FnOnce() -> String,
    diagnostics: &mut Diagnostics,
) {
    let plan = solver::effects::plan(scene);
    check_dose(scene, &plan, diagnostics);
    check_forced(given, plan, diagnostics);
    if has_small_strains(given, scene) {
        return;
    }
    let detail = format!(
        "the contact would be strained so much that small-strain elasticity would miss the peak pressure by {:.1} % (limit \
         {:.0} %), and finite strains are not available; lower the load or enlarge the radius, or accept it with \
         `effects.{}`: `off`",
        100.0 * small_strain::cost(scene),
        100.0 * small_strain::limit(scene),
        effects::name(Effect::GeometricNonlinearity)
    );
    diagnostics.fault(&cause(), detail);
}

/// Returns `true` if the strains of the contact are within the range of small-strain theory, or accepted by `off`.
pub(crate) fn has_small_strains(given: &Given, scene: &Scene) -> bool {
    let accepted = switch(given, Effect::GeometricNonlinearity) == Some(Switch::Off);
    accepted || small_strain::cost(scene) <= small_strain::limit(scene)
}

/// Adds a fault for a friction by dose beside heat that the plan simulates: the dose of a place does not follow from the worn depth.
fn check_dose(scene: &Scene, plan: &EffectsPlan, diagnostics: &mut Diagnostics) {
    let heats = [Effect::FrictionalHeating, Effect::JouleHeating];
    let heated = heats.into_iter().find(|effect| plan.simulates(*effect));
    if let (Friction::ByDose(_), Some(effect)) = (&scene.friction, heated) {
        let name = effects::name(effect);
        let detail = format!(
            "the dose of a place follows from its worn depth, which heat changes: write `by_cycle`, or switch `effects.{name}` off"
        );
        diagnostics.fault("/interface/friction/by_dose", detail);
    }
}

/// Adds a fault for each effect that is switched on and has nothing to simulate in the scene.
fn check_forced(given: &Given, plan: EffectsPlan, diagnostics: &mut Diagnostics) {
    for decision in plan.decisions {
        let name = effects::name(decision.effect);
        let forced = switch(given, decision.effect) == Some(Switch::On);
        let is_out = matches!(decision.verdict, Verdict::Skipped | Verdict::InputMissing);
        let pointer = format!("/effects/{name}");
        if forced && !decision.is_available {
            let detail = match decision.effect {
                Effect::StickMemory => {
                    "cannot be on: a point contact sticks in part up to amplitudes of a tenth of its half-length"
                }
                _ => {
                    "cannot be on: the contact of this `model.dimension` is simulated without it; `plane_strain` has it"
                }
            };
            diagnostics.fault(&pointer, detail);
        } else if forced && is_out {
            diagnostics.fault(
                &pointer,
                format!("cannot be on: {}", decisions::reason(&decision)),
            );
        }
    }
}

/// Warnings of effects beyond their limits that are not simulated, and of those that lack an input.
pub(crate) fn warnings(scene: &Scene) -> Vec<Fault> {
    let decisions = solver::effects::plan(scene).decisions.into_iter();
    let off = decisions.filter_map(|decision| {
        if decision.verdict == Verdict::InputMissing {
            return Some(Fault {
                pointer: format!("/effects/{}", effects::name(decision.effect)),
                detail: decisions::reason(&decision),
            });
        }
        let heats = matches!(
            decision.effect,
            Effect::FrictionalHeating | Effect::JouleHeating
        );
        let heat = decision
            .indicator()
            .filter(|_| heats && decision.verdict.is_on());
        if heat.is_some_and(|indicator| indicator.value() >= MOLTEN) {
            return Some(Fault {
                pointer: "/environment".to_owned(),
                detail: format!("the contact melts: {}", decisions::reason(&decision)),
            });
        }
        decision.is_missed().then(|| Fault {
            pointer: format!("/effects/{}", effects::name(decision.effect)),
            detail: decisions::missed(&decision),
        })
    });
    off.collect()
}

fn switch(given: &Given, effect: Effect) -> Option<Switch> {
    given.get(effects::name(effect)).and_then(EnumValue::known)
}
