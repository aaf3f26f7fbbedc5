//! The border between the wire contract and the engine: specifications to scenes, reports to documents.
//!
//! A specification is refused with *all* its faults, each with its JSON pointer; what is accepted comes back with
//! every default filled in and its provenance named.

mod diagnostics;
mod dimensions;
mod geometry;
mod interface;
mod load;
mod materials;
mod motion;
mod output;
mod settings;

use api::problem::Fault;
use api::spec::{Broken, Spec, SystemKind};
use solver::scene::{Body, Scene};

use crate::estimate::footprint::Footprint;
use crate::estimate::workload::Workload;
use crate::reference::presets::Preset;
use diagnostics::Diagnostics;

/// Longest accepted name, characters.
pub(crate) const NAME_LIMIT: usize = 200;
/// Most labels of a job.
const LABEL_LIMIT: usize = 64;
/// Longest key or value of a label, characters.
const LABEL_TEXT_LIMIT: usize = 256;

/// A specification with every default filled in, and the scene it means.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// The specification, complete, with the provenance of each value.
    pub spec: Spec,
    /// The kind of its system.
    pub kind: SystemKind,
    /// The scene.
    pub scene: Scene,
    /// How large its solve would be.
    pub footprint: Footprint,
    /// How much there is to do in it.
    pub workload: Workload,
}

/// Why a submitted document is not a study.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// It cannot be read at all.
    #[error(transparent)]
    Broken(#[from] Broken),
    /// It can be read, and has these faults.
    #[error("the specification has {} fault(s)", .0.len())]
    Faults(Vec<Fault>),
}

/// Reads and resolves a submitted document.
///
/// # Errors
/// [`Refused`] with the place of every fault.
pub fn read(bytes: &[u8]) -> Result<Resolved, Refused> {
    let (spec, unknown) = Spec::read(bytes)?;
    match scene(&spec) {
        Ok(resolved) if unknown.is_empty() => Ok(resolved),
        Ok(_) => Err(Refused::Faults(unknown)),
        Err(faults) => Err(Refused::Faults(unknown.into_iter().chain(faults).collect())),
    }
}

/// Resolves a specification and builds its scene.
///
/// # Errors
/// Every fault at once, each with its JSON pointer.
pub fn scene(spec: &Spec) -> Result<Resolved, Vec<Fault>> {
    let mut diagnostics = Diagnostics::default();
    names(spec, &mut diagnostics);
    let Some(kind) = diagnostics.known("/system/kind", &spec.system.kind) else {
        return Err(diagnostics.into_faults());
    };
    let preset = Preset::of(kind);
    let mut out = Spec {
        name: spec.name.clone(),
        labels: spec.labels.clone(),
        ..Spec::default()
    };

    let (system, shapes) = dimensions::resolve(kind, &spec.system, &mut diagnostics);
    let (materials, elastic) = materials::resolve(&spec.materials, &preset, &mut diagnostics);
    let (interface, laws) = interface::resolve(
        &spec.interface,
        &spec.materials,
        &materials,
        &preset,
        &mut diagnostics,
    );
    let (load, line_load) = load::resolve(spec.load.as_ref(), &preset, &shapes, &mut diagnostics);
    let imposed = motion::resolve(spec.motion.as_ref(), &preset, &mut diagnostics);
    let continuous = imposed.distance_mm().is_some();
    let cycles = settings::cycles(spec.cycles, continuous, &preset, &mut diagnostics);
    if continuous && laws.slider.is_some() {
        diagnostics.fault(
            "/interface/wear/slider",
            "a slider whose surface runs past continuously cannot wear yet; write null",
        );
    }
    let (accuracy, numerical) =
        settings::accuracy(&spec.accuracy, &shapes, cycles, &mut diagnostics);
    let (output, recorded) =
        output::resolve(&spec.output, &imposed, &shapes, cycles, &mut diagnostics);
    let stop = output::stop(&spec.stop, &mut diagnostics);
    out.effects = settings::effects(&spec.effects, &mut diagnostics);

    (out.system, out.materials, out.interface) = (system, materials, interface);
    (out.load, out.motion) = (Some(load), Some(imposed.motion));
    out.cycles = (!continuous).then_some(cycles);
    (out.accuracy, out.output, out.stop) = (accuracy, output, spec.stop.clone());
    let scene = Scene {
        slider: Body {
            shape: shapes.slider,
            elastic: elastic.slider,
            wear: laws.slider,
        },
        receptacle: Body {
            shape: shapes.block,
            elastic: elastic.receptacle,
            wear: laws.receptacle,
        },
        friction: laws.friction,
        load_n_per_mm: line_load.n_per_mm,
        spring_n_per_mm2: line_load.spring_n_per_mm2,
        drive: imposed.drive,
        motion: imposed.engine,
        cycles,
        accuracy: numerical,
        output: recorded,
        stop,
    };
    let mut sized = None;
    if diagnostics.is_clean() {
        settings::planned(&spec.effects, &scene, &mut diagnostics);
        settings::small_strains(&spec.effects, &scene, &mut diagnostics);
        sized = settings::meshable(&scene, &mut diagnostics);
    }
    let Some((footprint, workload)) = sized else {
        return Err(diagnostics.into_faults());
    };
    out.provenance = diagnostics.finish()?;
    Ok(Resolved {
        spec: out,
        kind,
        scene,
        footprint,
        workload,
    })
}

/// Names of the dimensions that belong to a kind of system.
pub fn dimension_names(kind: SystemKind) -> Vec<&'static str> {
    dimensions::names(kind)
}

/// Cycles that the histories of a resolved specification count to.
pub fn cycles(spec: &Spec) -> u64 {
    spec.cycles.unwrap_or(motion::CONTINUOUS_PARTS)
}

fn names(spec: &Spec, diagnostics: &mut Diagnostics) {
    if let Some(name) = &spec.name {
        diagnostics.text("/name", name, NAME_LIMIT);
    }
    if spec.labels.len() > LABEL_LIMIT {
        diagnostics.fault(
            "/labels",
            format!(
                "{} labels, at most {LABEL_LIMIT} are kept",
                spec.labels.len()
            ),
        );
        return;
    }
    for (key, value) in &spec.labels {
        let pointer = format!("/labels/{}", api::spec::pointer_token(key));
        if key.is_empty() {
            diagnostics.fault(&pointer, "the key of a label is empty");
        }
        diagnostics.text(&pointer, key, LABEL_TEXT_LIMIT);
        diagnostics.text(&pointer, value, LABEL_TEXT_LIMIT);
    }
}

#[cfg(test)]
mod tests;
