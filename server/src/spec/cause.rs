//! The field that causes a fault of the whole scene: the given one without which there would be none.
//!
//! The given fields are left out one after the other. A trial resolves the stages from the one that reads the field on; those before it
//! remain. At most 13 trials are made: element size, amplitude, tolerance or preset, load, materials, the six dimensions of a
//! `cylinder_on_flat`, width and crown.

use api::spec::{Spec, SystemKind};
use serde_json::Value;
use solver::scene::Scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::stages::{Bodies, Loading, Numerics};
use crate::spec::{filled, repair, system};

/// Fields on which mesh and strains depend, besides the lengths. The most specific is first.
const FIELDS: [&str; 6] = [
    "/accuracy/overrides/contact_element_mm",
    "/motion/amplitude_mm",
    "/accuracy/tolerance",
    "/accuracy/preset",
    "/load",
    "/materials",
];

/// Lengths of the model, on which strains and mesh depend as on those of the system.
const LENGTHS: [&str; 4] = [
    "/model/radius_z_mm",
    "/model/crown_radius_mm",
    "/model/width_mm",
    "/model/outer_diameter_mm",
];

/// Returns the pointer of the first given field that, left out, would make the scene of a specification possible; another one if none
/// alone does.
pub(super) fn of_fault(
    given: &Spec,
    numerics: &Numerics<'_>,
    otherwise: &str,
    is_possible: impl Fn(&Scene) -> bool,
) -> String {
    let document = serde_json::to_value(given).unwrap_or_default();
    let is_given = |pointer: &String| document.pointer(pointer).is_some();
    let fields = fields(numerics.loading.bodies.kind).filter(is_given);
    let fields: Vec<String> = fields.collect();
    let is_cause = |pointer: &&String| {
        let without = without(&document, pointer).filter(|without| without != given);
        let scene = without.and_then(|without| scene_of(&without, pointer, numerics));
        scene.is_some_and(|scene| is_possible(&scene))
    };
    // A model may require a length: nothing shows then that another field is the cause, unless it is given as well.
    let other = fields.iter().any(|field| field.starts_with(otherwise));
    let mut lengths = fields.iter().filter(|field| field.starts_with("/model"));
    let cause = fields.iter().find(is_cause);
    let cause = cause.or_else(|| lengths.next().filter(|_| !other));
    cause.map_or(otherwise, String::as_str).to_owned()
}

/// Fields of a specification of a kind that may be a cause, in the order in which they are left out.
fn fields(kind: SystemKind) -> impl Iterator<Item = String> {
    let dimensions = system::definition(kind).dimension_names();
    let dimensions = dimensions.map(|name| format!("/system/{name}"));
    let before = FIELDS.into_iter().map(str::to_owned);
    before
        .chain(dimensions)
        .chain(LENGTHS.into_iter().map(str::to_owned))
}

/// The specification of a document without a field.
fn without(document: &Value, pointer: &str) -> Option<Spec> {
    let mut document = document.clone();
    repair::remove(&mut document, pointer);
    serde_json::from_value(document).ok()
}

/// The scene of a specification that differs from resolved stages in a field; none if it has a fault.
fn scene_of(without: &Spec, field: &str, resolved: &Numerics<'_>) -> Option<Scene> {
    let mut diagnostics = Diagnostics::default();
    let of_numerics = field.starts_with("/accuracy");
    let of_bodies = !of_numerics && !field.starts_with("/motion") && field != "/load";
    let bodies = resolved.loading.bodies;
    let changed = of_bodies.then(|| Bodies::resolve(bodies.kind, without, &mut diagnostics));
    let bodies = changed.as_ref().unwrap_or(bodies);
    let changed = (!of_numerics).then(|| Loading::resolve(bodies, without, &mut diagnostics));
    let loading = changed.as_ref().unwrap_or(resolved.loading);
    let numerics = Numerics::resolve(loading, without, &mut diagnostics);
    let filled = filled::resolve(&numerics, &mut diagnostics);
    diagnostics.is_clean().then_some(filled.scene)
}

#[cfg(test)]
mod tests;
