//! Fields and laws that only a section has: other contacts refuse them.

use api::spec::Spec;
use solver::along_line::SectionsError;
use solver::scene::{Friction, Motion, Scene};
use solver::sides::Side;

use crate::spec::diagnostics::Diagnostics;

/// Dimensions besides the section whose fields inside the bodies are computed.
const HAS_FIELDS: [&str; 3] = ["extruded", "line", "ring"];

/// Checks that a specification has nothing that only a section has.
pub(super) fn check(filled: &Spec, name: &str, motion: Motion, diagnostics: &mut Diagnostics) {
    if !filled.mission.is_empty() {
        diagnostics.fault("/mission", "missions are simulated in `plane_strain` alone");
    } else if name != "point" && !matches!(motion, Motion::Reciprocating { .. }) {
        let detail = format!(
            "the contact of a `{name}` reciprocates between two turning points; other motions are simulated in `plane_strain` and as a `point`"
        );
        diagnostics.fault("/motion/kind", detail);
    }
    if filled.output.fields == Some(true) && !HAS_FIELDS.contains(&name) {
        let detail = format!(
            "a `{name}` has no fields inside the bodies; `plane_strain`, `line`, `ring` and `extruded` have"
        );
        diagnostics.fault("/output/fields", detail);
    }
}

/// Wear by the dose alone, and one coefficient of friction.
pub(super) fn check_laws(scene: &Scene, contact: &str, diagnostics: &mut Diagnostics) {
    let wear = scene.surface_wear();
    for side in Side::BOTH {
        if wear.of(side).is_some_and(|wear| wear.dose_rate().is_none()) {
            let pointer = format!("/interface/wear/{}/law", side.name());
            let detail = format!(
                "a {contact} wears by the dose alone: write `archard`, `sarkar` or layers of a plating, or simulate it in `plane_strain`"
            );
            diagnostics.fault(&pointer, detail);
        }
    }
    if !matches!(
        scene.friction,
        Friction::Frictionless | Friction::Coulomb { .. }
    ) {
        let detail = format!(
            "a {contact} has one coefficient of friction; one that changes is simulated in `plane_strain` alone"
        );
        diagnostics.fault("/interface/friction", detail);
    }
}

/// The field that an error of sections along a line is about.
pub(super) fn pointer(error: &SectionsError) -> &'static str {
    match error {
        SectionsError::Sticks { .. }
        | SectionsError::LeavesReceptacle { .. }
        | SectionsError::Motion => "/motion",
        SectionsError::AmplitudeRange(_) => "/motion/amplitude_mm",
        SectionsError::FrictionLaw => "/interface/friction",
        SectionsError::Law { .. } => "/interface/wear",
        SectionsError::Contact { .. }
        | SectionsError::Station { .. }
        | SectionsError::Mesh(_)
        | SectionsError::Operator(_) => "/model",
    }
}
