//! A coefficient of friction that changes: coefficients of the layers of platings, and what it does not go with.

use api::problem::Fault;
use api::spec::{DerivedMotion, EnumValue, MotionKind, Platings, Provenance, Spec};
use solver::scene;
use solver::sides::{Side, Sides};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::environment;
use crate::spec::law::{ByFriction, Laws, definition, friction_table};
use crate::spec::plating;

/// The laws with the coefficients of friction of the layers of platings; checks whether doses can be read from the wear of these
/// laws and layers.
pub(super) fn with_layers(
    laws: Laws,
    platings: &Platings,
    layers: &Sides<Vec<scene::Layer>>,
    diagnostics: &mut Diagnostics,
) -> Laws {
    let friction = of_layers(laws.friction, platings, diagnostics);
    if let scene::Friction::ByDose(table) = &friction {
        friction_table::check_doses(table, &laws.wear, layers, diagnostics);
    }
    Laws { friction, ..laws }
}

/// Checks a friction that changes beside the resolved specification: wear laws that take one coefficient, and motions whose cycles are
/// no cycles.
pub(super) fn check(resolved: &Spec, friction: &scene::Friction, diagnostics: &mut Diagnostics) {
    if !friction.changes() {
        return;
    }
    let motion = resolved.motion.as_ref().map(|motion| &motion.kind);
    let continuous = motion.and_then(EnumValue::known) == Some(MotionKind::Continuous);
    if continuous && friction.by_cycle().is_some() {
        let detail = "a `continuous` motion has no cycles; write `by_dose`";
        diagnostics.fault(friction_table::BY_CYCLE, detail);
    }
    let bases = environment::laws(resolved);
    let platings = plating::by_side(&resolved.plating);
    for side in Side::BOTH {
        let base = (format!("/interface/wear/{}", side.name()), *bases.of(side));
        let layers = platings.of(side).iter().enumerate();
        let layers = layers.map(|(index, layer)| {
            let pointer = format!("/plating/{}/{index}/wear", side.name());
            (pointer, layer.wear.as_ref())
        });
        for (pointer, law) in layers.chain([base]) {
            let Some(law) = law.and_then(|law| law.law.known()) else {
                continue;
            };
            if definition(law).friction != ByFriction::Independent {
                let detail = format!(
                    "`{}` takes one coefficient of friction, and that of this contact changes; write `archard`, or a constant coefficient",
                    law.as_str()
                );
                diagnostics.fault(&format!("{pointer}/law"), detail);
            }
        }
    }
}

/// Warnings of slips that are derived with a coefficient of friction that changes, by the pointers of their motions.
pub(super) fn warnings_of_derived_slip<'a>(
    derived: impl Iterator<Item = (String, &'a DerivedMotion)>,
    scene: &scene::Scene,
) -> Vec<Fault> {
    if !scene.friction.changes() {
        return Vec::new();
    }
    let detail = format!(
        "the slip is derived once, with the coefficient of friction of the unworn contact, {}; it changes during the run, to {} at most",
        scene.friction.unworn(),
        scene.largest_friction()
    );
    let by_friction =
        |motion: &DerivedMotion| motion.held_amplitude_mm > 0.0 || motion.slips_from_g.is_some();
    let derived = derived.filter(|(_, motion)| by_friction(motion));
    derived
        .map(|(pointer, _)| Fault::new(pointer, detail.clone()))
        .collect()
}

/// The friction with the coefficients of layers that have one: layers without one, and the bases, have that of the contact.
fn of_layers(
    contact: scene::Friction,
    platings: &Platings,
    diagnostics: &mut Diagnostics,
) -> scene::Friction {
    let platings = plating::by_side(platings);
    let mut given = Sides::<bool>::default();
    for side in Side::BOTH {
        for (index, layer) in platings.of(side).iter().enumerate() {
            let Some(coefficient) = layer.friction_coefficient else {
                continue;
            };
            *given.of_mut(side) = true;
            let pointer = format!("/plating/{}/{index}/friction_coefficient", side.name());
            diagnostics.provenance(&pointer, Provenance::Given);
            diagnostics.check_range(&pointer, coefficient, &friction_table::COEFFICIENT_RANGE);
            match contact {
                scene::Friction::Coulomb { .. } | scene::Friction::ByLayer(_) => {}
                scene::Friction::Frictionless => diagnostics.fault(
                    &pointer,
                    "does not belong to a `frictionless` interface; write the law `coulomb`",
                ),
                scene::Friction::ByCycle(_) => {
                    diagnostics.exclusive_fields(&pointer, "interface.friction.by_cycle");
                }
                scene::Friction::ByDose(_) => {
                    diagnostics.exclusive_fields(&pointer, "interface.friction.by_dose");
                }
            }
        }
    }
    if !(given.slider || given.receptacle) {
        return contact;
    }
    let base = contact.unworn();
    scene::Friction::ByLayer(Sides::from_fn(|side| {
        if !given.of(side) {
            return Vec::new();
        }
        let layers = platings.of(side).iter();
        let layers = layers.map(|layer| layer.friction_coefficient.unwrap_or(base));
        layers.chain([base]).collect()
    }))
}
