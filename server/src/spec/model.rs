//! The dimension of the model, and what it needs of the rest of a specification.

mod auto;
mod extruded;
mod length;
mod line;
mod point;
mod preset;
mod section_only;
mod stroke;

use api::problem::Fault;
use api::spec::{Dimension, LoadKind, Model, Spec, SystemKind};
use solver::model::{BodyLayout, Layout};
use solver::scene::{Extruded, Scene};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::movement::Movement;
use crate::spec::sourced::assumed;
use crate::spec::system::Shapes;
use length::length;
use line::Line;

/// The dimension and what it has beyond the section, without its force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Resolved {
    /// A section.
    PlaneStrain,
    /// A point contact.
    Point {
        /// Radius of the slider across, mm.
        radius_across_mm: f64,
        /// True if `auto` has chosen it.
        is_chosen: bool,
    },
    /// A contact along a line.
    Line(Line),
    /// Extruded bodies.
    Extruded(Extruded),
    /// The dimension that a slider of this width requires.
    Auto(Line),
}

impl Resolved {
    /// Returns `true` if a force needs no width.
    pub(super) fn has_width(&self) -> bool {
        *self != Self::PlaneStrain
    }
}

/// Resolves the dimension.
pub(super) fn resolve(
    given: Option<&Model>,
    shapes: &Shapes,
    kind: SystemKind,
    diagnostics: &mut Diagnostics,
) -> (Model, Resolved) {
    let model = given.cloned().unwrap_or_default();
    let dimension = preset::dimension(&model, kind, diagnostics);
    let (fields, filled, resolved): (&[&str], _, _) = match dimension {
        Dimension::PlaneStrain => (&["dimension"], Model::default(), Resolved::PlaneStrain),
        Dimension::Extruded => {
            let (filled, extruded) = extruded::resolve(&model, kind, diagnostics);
            (extruded::FIELDS, filled, Resolved::Extruded(extruded))
        }
        // Without a width a contact has no ends: the radius across makes it small.
        Dimension::Auto if model.width_mm.is_none() && model.radius_z_mm.is_some() => {
            let (filled, resolved) = round(&model, shapes, true, diagnostics);
            (&["dimension", "radius_z_mm", "chosen"], filled, resolved)
        }
        Dimension::Point => {
            let (filled, resolved) = round(&model, shapes, false, diagnostics);
            (&["dimension", "radius_z_mm"], filled, resolved)
        }
        Dimension::Line | Dimension::Ring | Dimension::Auto => {
            let (filled, line) = line::resolve(dimension, &model, shapes, kind, diagnostics);
            let resolved = if dimension == Dimension::Auto {
                Resolved::Auto(line)
            } else {
                Resolved::Line(line)
            };
            (line::fields(dimension), filled, resolved)
        }
    };
    diagnostics.check_fields("/model", &model, fields, dimension.as_str());
    let filled = Model {
        preset: model.preset,
        dimension: Some(dimension.into()),
        ..filled
    };
    (filled, resolved)
}

/// Resolves a slider that is round across the sliding direction.
fn round(
    given: &Model,
    shapes: &Shapes,
    is_chosen: bool,
    diagnostics: &mut Diagnostics,
) -> (Model, Resolved) {
    let default = assumed(shapes.slider.radius_mm);
    let pointer = "/model/radius_z_mm";
    let radius_across_mm = length(pointer, given.radius_z_mm, default, diagnostics);
    let filled = Model {
        radius_z_mm: Some(radius_across_mm),
        ..Model::default()
    };
    let resolved = Resolved::Point {
        radius_across_mm,
        is_chosen,
    };
    (filled, resolved)
}

/// Checks that a specification asks for nothing that its dimension does not have.
pub(super) fn check(
    filled: &Spec,
    model: Resolved,
    movement: &Movement,
    diagnostics: &mut Diagnostics,
) {
    if !matches!(model, Resolved::Line(_) | Resolved::Auto(_)) {
        line::check_overrides_of_others(filled, diagnostics);
    }
    let name = match model {
        Resolved::PlaneStrain => return,
        Resolved::Point { .. } => {
            point::check(filled, diagnostics);
            "point"
        }
        Resolved::Line(line) => line.name(),
        Resolved::Extruded(_) => "extruded",
        Resolved::Auto(_) => "auto",
    };
    let load = filled.load.as_ref();
    if load.is_some_and(|load| load.width_mm.is_some()) {
        diagnostics.foreign_field("/load", "width_mm", name);
    }
    if name != "auto" {
        let (motion, mission) = (movement.scene, movement.blocks.as_ref());
        section_only::check(filled, name, motion, mission, diagnostics);
    }
}

/// Makes a scene with its section one of its dimension, and checks its laws; with the dimension that was chosen and the reason.
pub(super) fn with_dimension(
    scene: Scene,
    model: Resolved,
    spec: &Spec,
    diagnostics: &mut Diagnostics,
) -> (Scene, Option<(Dimension, String)>) {
    let load = spec.load.as_ref();
    let force_n = load.and_then(|load| load.n).filter(|force| *force > 0.0);
    let is_force = load.is_some_and(|load| load.kind == LoadKind::Force.into());
    let scene = match model {
        Resolved::PlaneStrain => scene,
        Resolved::Point {
            radius_across_mm,
            is_chosen,
        } => {
            section_only::check_laws(&scene, "point contact", diagnostics);
            let scene = match force_n {
                None => scene,
                Some(force_n) => {
                    let across = Some(radius_across_mm);
                    point::with_dimension(scene, across, force_n, spec, diagnostics)
                }
            };
            if is_chosen {
                let reason = "model `point`: a radius across the sliding direction without a width";
                return (scene, Some((Dimension::Point, reason.to_owned())));
            }
            scene
        }
        Resolved::Line(line) => {
            section_only::check_laws(&scene, "contact along a line", diagnostics);
            line.with_dimension(scene, is_force, spec, diagnostics)
        }
        Resolved::Extruded(extruded) => {
            section_only::check_laws(&scene, "contact of extruded bodies", diagnostics);
            extruded::with_dimension(scene, extruded, is_force, spec, diagnostics)
        }
        Resolved::Auto(line) => {
            let chosen = auto::choose(scene, line, is_force, spec, diagnostics);
            let reason = format!("model `{}`: {}", chosen.dimension.as_str(), chosen.reason);
            return (chosen.scene, Some((chosen.dimension, reason)));
        }
    };
    (scene, None)
}

/// Warnings of a contact that is none of its dimension, or leaves the receptacle.
pub(super) fn warnings(scene: &Scene) -> Vec<Fault> {
    let of_dimension = match scene.dimension {
        solver::scene::Dimension::PlaneStrain | solver::scene::Dimension::Extruded(_) => Vec::new(),
        solver::scene::Dimension::Point(_) => point::warnings(scene),
        solver::scene::Dimension::Line(_) => line::warnings(scene),
    };
    stroke::warnings(scene)
        .into_iter()
        .chain(of_dimension)
        .collect()
}

/// Checks the size of what a meshed scene is condensed to.
pub(super) fn check_size(scene: &Scene, layout: &Layout, diagnostics: &mut Diagnostics) {
    let zones = layout.bodies.as_ref().map(BodyLayout::largest_zone);
    extruded::check_size(scene, zones, diagnostics);
}

#[cfg(test)]
mod tests;
