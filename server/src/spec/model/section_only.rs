//! Fields and laws that only a section has: other contacts refuse them.

use api::spec::Spec;
use solver::along_line::SectionsError;
use solver::scene::{Mission, Motion, Scene};
use solver::sides::Side;

use crate::spec::diagnostics::Diagnostics;

/// Dimensions besides the section whose fields inside the bodies are computed.
const HAS_FIELDS: [&str; 3] = ["extruded", "line", "ring"];

/// Checks that a specification has nothing that only a section has: a motion, or several in a mission.
pub(super) fn check(
    filled: &Spec,
    name: &str,
    motion: Motion,
    mission: Option<&Mission>,
    diagnostics: &mut Diagnostics,
) {
    if name != "point" {
        let blocks = mission.map(|mission| &mission.blocks[..]);
        let blocks = blocks.map(|blocks| blocks.iter().map(|block| block.motion).collect());
        let motions: Vec<Motion> = blocks.unwrap_or_else(|| vec![motion]);
        for (number, motion) in motions.into_iter().enumerate() {
            if matches!(motion, Motion::Reciprocating { .. }) {
                continue;
            }
            let pointer = if filled.mission.is_empty() {
                "/motion/kind".to_owned()
            } else {
                format!("/mission/{number}/motion/kind")
            };
            let detail = format!(
                "the contact of a `{name}` reciprocates between two turning points; other motions are simulated in `plane_strain` and as a `point`"
            );
            diagnostics.fault(&pointer, detail);
        }
    }
    if filled.output.fields == Some(true) && !HAS_FIELDS.contains(&name) {
        let detail = format!(
            "a `{name}` has no fields inside the bodies; `plane_strain`, `line`, `ring` and `extruded` have"
        );
        diagnostics.fault("/output/fields", detail);
    }
}

/// Checks that surfaces wear by the dose alone.
pub(super) fn check_laws(scene: &Scene, contact: &str, diagnostics: &mut Diagnostics) {
    let wear = scene.surface_wear_of_all_motions();
    for side in Side::BOTH {
        if wear.of(side).is_some_and(|wear| wear.dose_rate().is_none()) {
            let pointer = format!("/interface/wear/{}/law", side.name());
            let detail = format!(
                "a {contact} wears by the dose alone: write `archard`, `sarkar` or layers of a plating, or simulate it in `plane_strain`"
            );
            diagnostics.fault(&pointer, detail);
        }
    }
}

/// The field of the motion, or of the motions of a mission.
pub(super) fn movement(spec: &Spec) -> &'static str {
    if spec.mission.is_empty() {
        "/motion"
    } else {
        "/mission"
    }
}

/// The field of a specification that an error of sections along a line is about.
pub(super) fn pointer(error: &SectionsError, spec: &Spec) -> &'static str {
    match error {
        SectionsError::Sticks { .. }
        | SectionsError::LeavesReceptacle { .. }
        | SectionsError::Motion => movement(spec),
        SectionsError::AmplitudeRange(_) if spec.mission.is_empty() => "/motion/amplitude_mm",
        SectionsError::AmplitudeRange(_) => "/mission",
        SectionsError::Law { .. } => "/interface/wear",
        SectionsError::Contact { .. }
        | SectionsError::Station { .. }
        | SectionsError::Mesh(_)
        | SectionsError::Operator(_) => "/model",
    }
}
