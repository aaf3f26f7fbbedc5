//! Switches of physical effects, and the checks of a scene against them.

use std::collections::BTreeMap;

use api::spec::{EnumValue, Switch};
use solver::effects::{Effect, SMALL_STRAIN_LIMIT};
use solver::scene::Scene;

use crate::spec::diagnostics::{Diagnostics, shortened};
use crate::spec::suggestion::did_you_mean;

/// Effects that the engine simulates.
const AVAILABLE: [Effect; 5] = [
    Effect::Elasticity,
    Effect::Friction,
    Effect::ReceptacleWear,
    Effect::SliderWear,
    Effect::Relocation,
];
/// Effects that are planned but not available yet.
const PLANNED: [&str; 6] = [
    "frictional_heating",
    "geometric_nonlinearity",
    "oxidation",
    "plasticity",
    "plating",
    "resistance",
];

/// Names of all effects.
pub(crate) fn names() -> Vec<&'static str> {
    let names = AVAILABLE.iter().map(|effect| effect.name());
    names.chain(PLANNED).collect()
}

/// Switches by the name of their effect; an absent one is `auto`.
type Switches = BTreeMap<String, EnumValue<Switch>>;

/// Checks the switches.
pub(crate) fn resolve(given: &Switches, diagnostics: &mut Diagnostics) {
    for (name, switch) in given {
        let pointer = format!("/effects/{}", api::spec::pointer_token(name));
        let available = AVAILABLE.iter().any(|effect| effect.name() == name);
        if !available && !PLANNED.contains(&name.as_str()) {
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
        match diagnostics.enum_member(&pointer, switch) {
            Some(Switch::On) if !available => {
                diagnostics.fault(&pointer, format!("`{name}` is not available yet"));
            }
            Some(Switch::Off) if available => {
                diagnostics.fault(
                    &pointer,
                    "switching it off is not available yet; leave it out of the scene instead",
                );
            }
            _ => {}
        }
    }
}

/// Checks a scene against the switches. `cause` is the pointer of the field that causes strains beyond the limit.
pub(crate) fn check(
    given: &Switches,
    scene: &Scene,
    cause: impl FnOnce() -> String,
    diagnostics: &mut Diagnostics,
) {
    check_forced(given, scene, diagnostics);
    if has_small_strains(given, scene) {
        return;
    }
    let detail = format!(
        "the contact would be strained so much that small-strain elasticity would miss the peak pressure by {:.1} % (limit \
         {:.0} %), and finite strains are not available; lower the load or enlarge the radius, or accept it with \
         `effects.{}`: `off`",
        100.0 * solver::effects::small_strain_cost(scene),
        100.0 * SMALL_STRAIN_LIMIT,
        Effect::GeometricNonlinearity.name()
    );
    diagnostics.fault(&cause(), detail);
}

/// Whether the strains of the contact are within the range of small-strain theory, or accepted by `off`.
pub(crate) fn has_small_strains(given: &Switches, scene: &Scene) -> bool {
    let accepted = switch(given, Effect::GeometricNonlinearity) == Some(Switch::Off);
    accepted || solver::effects::small_strain_cost(scene) <= SMALL_STRAIN_LIMIT
}

/// Adds a fault for each effect that is switched on and has nothing to simulate in the scene.
fn check_forced(given: &Switches, scene: &Scene, diagnostics: &mut Diagnostics) {
    for decision in solver::effects::plan(scene).decisions {
        let name = decision.effect.name();
        let forced = switch(given, decision.effect) == Some(Switch::On);
        if forced && !decision.simulated && decision.effect != Effect::GeometricNonlinearity {
            let detail = format!("cannot be on: {}", decision.reason);
            diagnostics.fault(&format!("/effects/{name}"), detail);
        }
    }
}

fn switch(given: &Switches, effect: Effect) -> Option<Switch> {
    given.get(effect.name()).and_then(EnumValue::known)
}
