//! Point contacts: what they need of the rest of a specification, and where they are none of half-spaces.

use api::problem::Fault;
use api::spec::{LoadKind, Spec};
use solver::closed_form;
use solver::closed_form::expected_wear::worn_contact_half_length_mm;
use solver::closed_form::unworn_contact::hertz_half_width;
use solver::scene::{self, Conduction, Point, Scene};
use solver::sides::Sides;

use super::section_only;
use crate::spec::diagnostics::Diagnostics;

/// Largest half-length of a contact over the height of a body that is taken as a half-space: its compliance is then a few per cent lower.
const LARGEST_IN_HALF_SPACE: f64 = 0.2;
/// Fewest cells along a half-length of the unworn contact.
const FEWEST_CELLS: f64 = 3.0;
/// Distance of a contact to the edge of the receptacle over its half-length, from which on the edge does not count.
const FROM_EDGE: f64 = 2.0;

/// Checks that a specification asks for nothing that a point contact does not have.
pub(super) fn check(filled: &Spec, diagnostics: &mut Diagnostics) {
    let load = filled.load.as_ref();
    if load.is_some_and(|load| load.kind != LoadKind::Force.into()) {
        diagnostics.fault(
            "/load/kind",
            "a point contact carries a `force`; pressures and line forces act on a section",
        );
    }
}

/// Makes a scene with its section that of a point contact under a force, N. The load of its section follows from the force.
pub(super) fn with_dimension(
    mut scene: Scene,
    radius_across_mm: Option<f64>,
    force_n: f64,
    spec: &Spec,
    diagnostics: &mut Diagnostics,
) -> Scene {
    scene.dimension = scene::Dimension::Point(Point {
        force_n,
        radius_across_mm: Sides {
            slider: radius_across_mm,
            receptacle: None,
        },
    });
    // Springs were resolved per unit of width.
    let spring_n_per_mm = scene.spring_n_per_mm2;
    scene.load_n_per_mm = closed_form::middle_line_load_n_per_mm(&scene);
    check_size(&scene, spec, diagnostics);
    scene.spring_n_per_mm2 = spring_n_per_mm * scene.load_n_per_mm / force_n;
    if let Conduction::Known(electrical) = &mut scene.conduction {
        electrical.width_mm = force_n / scene.load_n_per_mm;
    }
    scene
}

/// Cells that resolve the contact, and a contact that stays on the receptacle.
fn check_size(scene: &Scene, spec: &Spec, diagnostics: &mut Diagnostics) {
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
        scene.largest_amplitude_mm(),
        0.5 * scene.receptacle.shape.length_mm,
    );
    if amplitude + half_length > half_block {
        let detail = format!(
            "the contact of {half_length:.2e} mm leaves the receptacle, {half_block} mm to either side, by an amplitude of {amplitude} mm"
        );
        diagnostics.fault(section_only::movement(spec), detail);
    }
}

/// Warnings of a point contact that is no contact of half-spaces, or runs to an edge.
pub(super) fn warnings(scene: &Scene) -> Vec<Fault> {
    let half_length = worn_contact_half_length_mm(scene);
    let (slider, block) = (&scene.slider.shape, &scene.receptacle.shape);
    let height = slider.height_mm.min(block.height_mm);
    let to_edge = 0.5 * block.length_mm - scene.largest_amplitude_mm() - half_length;
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
    warnings.collect()
}
