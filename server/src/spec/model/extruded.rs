//! Extruded bodies: their width, layers and ends, and what they need of the rest of a specification.

use api::spec::{Ends, Model, Spec, SystemKind};
use solver::extruded::{ExtrudedError, ExtrudedScene, MOST_LAYERS};
use solver::scene::{self, Conduction, Extruded, Scene};
use solver::sides::Sides;

use super::length::length;
use super::section_only;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::{Sourced, assumed, source};

/// Width of the source's extruded fuzz button, mm, and its layers.
const FUZZ_BUTTON_MM: f64 = 0.010_58;
const LAYERS: u32 = 2;
/// Length of a layer over that of its neighbour toward the end.
const GROWTH: std::ops::RangeInclusive<f64> = 1.0..=5.0;

/// Fields of the model.
pub(super) const FIELDS: &[&str] = &[
    "preset",
    "dimension",
    "width_mm",
    "layers",
    "layer_growth",
    "ends",
];

/// Resolves the bodies of a model.
pub(super) fn resolve(
    given: &Model,
    kind: SystemKind,
    diagnostics: &mut Diagnostics,
) -> (Model, Extruded) {
    const WIDTH: &str = "/model/width_mm";
    let is_known = kind == SystemKind::FuzzButton || given.width_mm.is_some();
    let width_mm = if is_known {
        length(WIDTH, given.width_mm, source(FUZZ_BUTTON_MM), diagnostics)
    } else {
        diagnostics.missing(WIDTH, "`extruded` needs it");
        FUZZ_BUTTON_MM
    };
    let default = match kind {
        SystemKind::FuzzButton => source(LAYERS),
        _ => assumed(LAYERS),
    };
    let layers = layers(given.layers, default, diagnostics);
    let growth = diagnostics.or_default("/model/layer_growth", given.layer_growth, assumed(1.0));
    let layer_growth = diagnostics.check_range("/model/layer_growth", growth, &GROWTH);
    let named = given.ends.as_ref();
    let named = named.and_then(|ends| diagnostics.enum_member("/model/ends", ends));
    let ends = diagnostics.or_default("/model/ends", named, assumed(Ends::Free));
    let filled = Model {
        width_mm: Some(width_mm),
        layers: Some(layers),
        layer_growth: Some(layer_growth),
        ends: Some(ends.into()),
        ..Model::default()
    };
    let extruded = Extruded {
        width_mm,
        layers: usize::try_from(layers).unwrap_or(usize::MAX),
        layer_growth,
        ends: match ends {
            Ends::Free => scene::Ends::Free,
            Ends::Held => scene::Ends::Held,
        },
    };
    (filled, extruded)
}

fn layers(given: Option<u32>, default: Sourced<u32>, diagnostics: &mut Diagnostics) -> u32 {
    const POINTER: &str = "/model/layers";
    let layers = diagnostics.or_default(POINTER, given, default);
    let layers = diagnostics.check_count(POINTER, layers, &(2..=u64::from(MOST_LAYERS)));
    if !layers.is_multiple_of(2) {
        let detail = format!("{layers} is odd: the middle of the width is a node plane");
        diagnostics.fault(POINTER, detail);
    }
    layers
}

/// Makes a scene with its section one of extruded bodies. A force, and its spring, are those of the whole width; other loads act on
/// each mm of it.
pub(super) fn with_dimension(
    mut scene: Scene,
    extruded: Extruded,
    is_force: bool,
    spec: &Spec,
    diagnostics: &mut Diagnostics,
) -> Scene {
    let width = extruded.width_mm;
    if is_force {
        scene.load_n_per_mm /= width;
        scene.spring_n_per_mm2 /= width;
    }
    if let Conduction::Known(electrical) = &mut scene.conduction {
        electrical.width_mm = width;
    }
    scene.dimension = scene::Dimension::Extruded(extruded);
    if diagnostics.is_clean() {
        check(&scene, spec, diagnostics);
    }
    scene
}

/// Checks what extruded bodies cannot simulate.
fn check(scene: &Scene, spec: &Spec, diagnostics: &mut Diagnostics) {
    let Some(bodies) = ExtrudedScene::of(scene) else {
        return;
    };
    let Err(error) = bodies.check_all() else {
        return;
    };
    let pointer = match &error {
        ExtrudedError::Sections(error) => section_only::pointer(error, spec),
        // Others are ranges of fields of their own.
        ExtrudedError::UnlikeLayers { .. } => "/model/layer_growth",
        _ => "/model",
    };
    diagnostics.fault(pointer, error.to_string());
}

/// Adds a fault where the operators of a meshed scene would be larger than the engine takes.
pub(super) fn check_size(scene: &Scene, largest_zone: Sides<usize>, diagnostics: &mut Diagnostics) {
    let Some(bodies) = ExtrudedScene::of(scene) else {
        return;
    };
    if let Err(error) = bodies.check_size(largest_zone) {
        let detail = error.to_string();
        diagnostics.fault("/model/layers", detail);
    }
}
