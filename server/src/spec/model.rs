//! The dimension of the model, and what it needs of the rest of a specification.

use api::problem::Fault;
use api::spec::{Dimension, LoadKind, Model, Spec};
use solver::effects::Effect;
use solver::model::resolution::{hertz_half_width, worn_contact_half_length_mm};
use solver::point;
use solver::scene::{self, Conduction, Friction, Motion, Point, Scene};
use solver::sides::{Side, Sides};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::{Sourced, assumed};
use crate::spec::system::{LENGTH_MM, Shapes};
use crate::spec::unit;

/// Largest half-length of a contact over the height of a body that is taken as a half-space: its compliance is then a few per cent lower.
const LARGEST_IN_HALF_SPACE: f64 = 0.2;
/// Fewest cells along a half-length of the unworn contact.
const FEWEST_CELLS: f64 = 3.0;
/// Distance of a contact to the edge of the receptacle over its half-length, from which on the edge does not count.
const FROM_EDGE: f64 = 2.0;

/// The dimension and what it has beyond the section, without its force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Resolved {
    dimension: Dimension,
    radius_across_mm: Option<f64>,
}

impl Resolved {
    /// Whether it is a point contact.
    pub(super) fn is_point(&self) -> bool {
        self.dimension == Dimension::Point
    }
}

/// Resolves the dimension.
pub(super) fn resolve(
    given: Option<&Model>,
    shapes: &Shapes,
    diagnostics: &mut Diagnostics,
) -> (Model, Resolved) {
    let model = given.cloned().unwrap_or_default();
    let named =
        given.and_then(|model| diagnostics.enum_member("/model/dimension", &model.dimension));
    let default = assumed(Dimension::PlaneStrain);
    let dimension = diagnostics.or_default("/model/dimension", named, default);
    let (fields, radius): (&[&str], _) = match dimension {
        Dimension::PlaneStrain => (&["dimension"], None),
        Dimension::Point => {
            let default = assumed(shapes.slider.radius_mm);
            let radius = radius(model.radius_z_mm, default, diagnostics);
            (&["dimension", "radius_z_mm"], Some(radius))
        }
    };
    diagnostics.check_fields("/model", &model, fields, dimension.as_str());
    let filled = Model {
        dimension: dimension.into(),
        radius_z_mm: radius,
    };
    let resolved = Resolved {
        dimension,
        radius_across_mm: radius,
    };
    (filled, resolved)
}

fn radius(given: Option<f64>, default: Sourced<f64>, diagnostics: &mut Diagnostics) -> f64 {
    const POINTER: &str = "/model/radius_z_mm";
    diagnostics.check_unit(POINTER, given, &unit::length_mm(default.value));
    let radius = diagnostics.or_default(POINTER, given, default);
    diagnostics.check_range(POINTER, radius, &LENGTH_MM)
}

/// Checks that a specification asks for nothing that its dimension does not have.
pub(super) fn check(
    filled: &Spec,
    (model, motion): (Resolved, Motion),
    diagnostics: &mut Diagnostics,
) {
    if model.is_point() {
        check_point(filled, motion, diagnostics);
    }
}

fn check_point(filled: &Spec, motion: Motion, diagnostics: &mut Diagnostics) {
    let load = filled.load.as_ref();
    if load.is_some_and(|load| load.width_mm.is_some()) {
        diagnostics.foreign_field("/load", "width_mm", "point");
    }
    if load.is_some_and(|load| load.kind != LoadKind::Force.into()) {
        diagnostics.fault(
            "/load/kind",
            "a point contact carries a `force`; pressures and line forces act on a section",
        );
    }
    if !filled.mission.is_empty() {
        diagnostics.fault("/mission", "missions are simulated in `plane_strain` alone");
    } else if !matches!(motion, Motion::Reciprocating { .. }) {
        diagnostics.fault(
            "/motion/kind",
            "a point contact reciprocates between two turning points; other motions are simulated in `plane_strain` alone",
        );
    }
    if filled.output.fields == Some(true) {
        diagnostics.fault(
            "/output/fields",
            "fields inside the bodies are those of a section",
        );
    }
    let overrides = filled.accuracy.overrides.as_ref();
    if overrides.is_some_and(|overrides| overrides.largest_wear_mm.is_some()) {
        diagnostics.foreign_field("/accuracy/overrides", "largest_wear_mm", "point");
    }
}

/// Makes a scene with its section that of a point contact, and checks its laws. The load of its section follows from the force.
pub(super) fn with_dimension(
    mut scene: Scene,
    (model, force_n): (Resolved, Option<f64>),
    diagnostics: &mut Diagnostics,
) -> Scene {
    if !model.is_point() {
        return scene;
    }
    check_laws(&scene, diagnostics);
    let Some(force_n) = force_n.filter(|force| *force > 0.0) else {
        return scene;
    };
    scene.dimension = scene::Dimension::Point(Point {
        force_n,
        radius_across_mm: Sides {
            slider: model.radius_across_mm,
            receptacle: None,
        },
    });
    // Springs were resolved per unit of width.
    let spring_n_per_mm = scene.spring_n_per_mm2;
    scene.load_n_per_mm = point::middle_line_load_n_per_mm(&scene);
    check_size(&scene, diagnostics);
    scene.spring_n_per_mm2 = spring_n_per_mm * scene.load_n_per_mm / force_n;
    if let Conduction::Known(electrical) = &mut scene.conduction {
        electrical.width_mm = force_n / scene.load_n_per_mm;
    }
    scene
}

/// Cells that resolve the contact, and a contact that stays on the receptacle.
fn check_size(scene: &Scene, diagnostics: &mut Diagnostics) {
    let half_length = hertz_half_width(scene);
    if let Some(cell) = scene.accuracy.contact_element_mm {
        let most = half_length / FEWEST_CELLS;
        if cell > most {
            let detail = format!(
                "{cell} is above {most:.2e}, a third of the half-length of the unworn contact"
            );
            diagnostics.fault("/accuracy/overrides/contact_element_mm", detail);
        }
    }
    let (amplitude, half_block) = (
        scene.motion.amplitude_mm(),
        0.5 * scene.receptacle.shape.length_mm,
    );
    if amplitude + half_length > half_block {
        let detail = format!(
            "the contact of {half_length:.2e} mm leaves the receptacle, {half_block} mm to either side, by an amplitude of {amplitude} mm"
        );
        diagnostics.fault("/motion", detail);
    }
}

/// Wear by the dose alone, and one coefficient of friction.
fn check_laws(scene: &Scene, diagnostics: &mut Diagnostics) {
    let wear = scene.surface_wear();
    for side in Side::BOTH {
        if wear.of(side).is_some_and(|wear| wear.dose_rate().is_none()) {
            let pointer = format!("/interface/wear/{}/law", side.name());
            let detail = "a point contact wears by the dose alone: write `archard`, `sarkar` or layers of a plating, or simulate it in \
                 `plane_strain`";
            diagnostics.fault(&pointer, detail);
        }
    }
    if !matches!(
        scene.friction,
        Friction::Frictionless | Friction::Coulomb { .. }
    ) {
        diagnostics.fault(
            "/interface/friction",
            "a point contact has one coefficient of friction; one that changes is simulated in `plane_strain` alone",
        );
    }
}

/// Warnings of a point contact that is no contact of half-spaces, or runs to an edge.
pub(super) fn warnings(scene: &Scene) -> Vec<Fault> {
    if scene.dimension.point().is_none() {
        return Vec::new();
    }
    let half_length = worn_contact_half_length_mm(scene);
    let (slider, block) = (&scene.slider.shape, &scene.receptacle.shape);
    let height = slider.height_mm.min(block.height_mm);
    let to_edge = 0.5 * block.length_mm - scene.motion.amplitude_mm() - half_length;
    let mut warnings = Vec::new();
    if half_length > LARGEST_IN_HALF_SPACE * height {
        warnings.push(format!(
            "the bodies are simulated as half-spaces, which a contact of {half_length:.2e} mm on a body {height} mm high is not: it is \
             stiffer"
        ));
    }
    if to_edge < FROM_EDGE * half_length {
        warnings.push(format!(
            "the bodies are simulated as half-spaces, and the contact of {half_length:.2e} mm ends {to_edge:.3} mm from the edge of the \
             receptacle"
        ));
    }
    let warnings = warnings.into_iter();
    let warnings = warnings.map(|detail| Fault::new("/model/dimension", detail));
    warnings.chain(yields(scene)).collect()
}

/// A warning of a peak pressure beyond the hardness of the softer surface, whether it wears or not.
fn yields(scene: &Scene) -> Option<Fault> {
    let mut decisions = solver::effects::plan(scene).decisions.into_iter();
    let plasticity = decisions.find(|decision| decision.effect == Effect::Plasticity)?;
    let ratio = plasticity.indicator?.unworn;
    (ratio > 1.0).then(|| {
        let detail = format!(
            "the peak pressure of the unworn contact is {ratio:.2} times the hardness of the softer surface: it yields, and is simulated \
             as elastic"
        );
        Fault::new("/load", detail)
    })
}

#[cfg(test)]
mod tests;
