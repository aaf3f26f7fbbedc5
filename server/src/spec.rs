//! Resolution: from a specification as users write it to the scene that the engine solves.
//!
//! A specification is refused with *all* its faults, each with its JSON pointer; an accepted one comes back with every
//! default filled in and the provenance of each value. Mesh lines are placed, which shows whether a scene can be
//! meshed; nothing is meshed or estimated.

mod accuracy;
mod blocks;
mod cause;
mod changing_friction;
pub(crate) mod coefficients;
mod conductors;
mod covering;
mod criterion;
mod diagnostics;
mod effects;
mod environment;
mod films;
mod law;
mod law_range;
mod life;
mod load;
mod materials;
mod mission;
mod motion;
mod movement;
mod output;
mod plating;
mod rated_life;
mod repair;
mod resistance_range;
pub(crate) mod scatter;
pub(crate) mod schema;
mod sourced;
mod spots;
mod stop;
mod suggestion;
mod system;
mod unit;

use std::collections::BTreeMap;

use api::problem::Fault;
use api::results::BlockExtent;
use api::spec::{DerivedMotion, ParseError, Spec, SystemKind};
use solver::law::softening::REFERENCE_C;
use solver::model::Layout;
use solver::scene::{Body, Conduction, Criterion, Layer, Scene};
use solver::sides::Sides;

use conductors::Conductors;
use diagnostics::Diagnostics;
pub(crate) use diagnostics::NAME_LIMIT;
pub(crate) use motion::CYCLES;
use movement::Movement;
pub(crate) use rated_life::RatedMatings;
pub(crate) use suggestion::did_you_mean;
use system::Preset;
pub(crate) use system::definition as system_definition;

/// Most labels of a job.
pub(crate) const LABEL_LIMIT: usize = 64;
/// Longest key or value of a label, characters.
pub(crate) const LABEL_TEXT_LIMIT: usize = 256;

/// A specification with every default filled in, and its scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// The complete specification, with the provenance of each value.
    pub spec: Spec,
    /// The kind of its system.
    pub kind: SystemKind,
    /// The scene.
    pub scene: Scene,
    /// Its mesh lines, which show that it can be meshed.
    pub layout: Layout,
    /// How its motion was derived from a vibration, a thermal cycle or an insertion.
    pub motion: Option<DerivedMotion>,
    /// The blocks of its mission.
    pub blocks: Vec<BlockExtent>,
    /// What a criterion of the contact resistance lacks, in words; nothing if it is modelled.
    pub resistance_lacks: Vec<String>,
    /// Values that were probably written in another unit.
    pub warnings: Vec<Fault>,
}

/// Reason for which a submitted document is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// It cannot be parsed.
    #[error(transparent)]
    Parse(#[from] ParseError),
    /// It has these faults.
    #[error("the specification has {} fault(s)", .0.len())]
    Faults(Vec<Fault>),
}

/// Parses and resolves a submitted document.
///
/// # Errors
/// [`Refused`] with the pointer of every fault.
pub fn read(bytes: &[u8]) -> Result<Resolved, Refused> {
    let (spec, mut unknown) = match Spec::read(bytes) {
        Ok(read) => read,
        Err(error) => {
            let faults = |spec: &Spec| resolve(spec).err().unwrap_or_default();
            return Err(Refused::Parse(repair::with_others(error, bytes, faults)));
        }
    };
    suggestion::suggest_fields(&mut unknown);
    match resolve(&spec) {
        Ok(resolved) if unknown.is_empty() => Ok(resolved),
        Ok(_) => Err(Refused::Faults(unknown)),
        Err(faults) => Err(Refused::Faults(unknown.into_iter().chain(faults).collect())),
    }
}

/// Resolves a specification.
///
/// # Errors
/// All faults, each with its JSON pointer.
pub fn resolve(spec: &Spec) -> Result<Resolved, Vec<Fault>> {
    let mut diagnostics = Diagnostics::default();
    check_names(spec, &mut diagnostics);
    let Some(kind) = diagnostics.enum_member("/system/kind", &spec.system.kind) else {
        return Err(diagnostics.into_faults());
    };
    let Filled {
        spec: mut filled,
        mut scene,
        movement,
        resistance_lacks,
    } = fill(spec, kind, &mut diagnostics);
    if !diagnostics.is_clean() {
        return Err(diagnostics.into_faults());
    }
    let strains_cause = || {
        cause::of_fault(spec, kind, "/load", |spec| {
            scene_of(spec, kind)
                .is_some_and(|scene| effects::has_small_strains(&spec.effects, &scene))
        })
    };
    effects::check(&spec.effects, &scene, strains_cause, &mut diagnostics);
    let layout = match Layout::of(&scene) {
        Ok(layout) => layout,
        Err(error) => {
            let pointer = cause::of_fault(spec, kind, "/system", |spec| {
                scene_of(spec, kind).is_some_and(|scene| Layout::of(&scene).is_ok())
            });
            diagnostics.fault(&pointer, error.to_string());
            return Err(diagnostics.into_faults());
        }
    };
    let mut warnings = diagnostics.warnings().to_vec();
    warnings.extend(law_range::warnings(&filled, &scene));
    warnings.extend(resistance_range::warnings(spec, &scene));
    warnings.extend(effects::warnings(&scene));
    warnings.extend(rated_life::warnings(kind, filled.motion.as_ref(), &scene));
    let derived = || movement.all_derived();
    warnings.extend(changing_friction::warnings_of_derived_slip(
        derived(),
        &scene,
    ));
    let sticks = derived().filter(|(_, motion)| motion.sticks);
    warnings.extend(sticks.map(|(pointer, motion)| Fault::new(&pointer, motion.reason.clone())));
    scene.scattered = scatter::scenes(&filled, &scene, |spec| scene_of(spec, kind));
    let blocks = blocks::extents(&filled, &movement);
    filled.provenance = diagnostics.finish()?;
    Ok(Resolved {
        spec: filled,
        kind,
        scene,
        layout,
        motion: movement.derived,
        blocks,
        resistance_lacks,
        warnings,
    })
}

/// A specification with its defaults.
struct Filled {
    spec: Spec,
    scene: Scene,
    movement: Movement,
    resistance_lacks: Vec<String>,
}

/// The scene of a specification without faults.
fn scene_of(spec: &Spec, kind: SystemKind) -> Option<Scene> {
    let mut diagnostics = Diagnostics::default();
    let Filled { scene, .. } = fill(spec, kind, &mut diagnostics);
    diagnostics.is_clean().then_some(scene)
}

/// The specification with every default filled in, and its scene.
fn fill(spec: &Spec, kind: SystemKind, diagnostics: &mut Diagnostics) -> Filled {
    let preset = covering::preset_for_motion(spec, (system::definition(kind).preset)());
    let (system, shapes) = system::resolve(kind, &spec.system, diagnostics);
    let (materials, elastic) = materials::resolve(&spec.materials, &preset, diagnostics);
    let coverings = covering::resolve(spec, &preset);
    let plated = coverings.map(|covering| covering.is_plated());
    let surroundings_c = spec.environment.temperature_c.unwrap_or(REFERENCE_C);
    let (interface, laws) = law::resolve(
        &spec.interface,
        &spec.materials,
        &materials,
        (&preset, coverings, surroundings_c),
        diagnostics,
    );
    law::check_plated_sides(&laws, plated, diagnostics);
    let (platings, layers) = plating::resolve(coverings, laws.friction.unworn(), diagnostics);
    let laws = changing_friction::with_layers(laws, (&platings, &layers), diagnostics);
    let (load, line_load) = load::resolve(spec.load.as_ref(), &preset, &shapes, diagnostics);
    let contact = motion::HeldContact {
        friction: laws.friction.unworn(),
        force_n: load.n,
    };
    let movement = resolve_movement(spec, &preset, contact, diagnostics);
    let cycles = movement.total_cycles;
    if movement.distance_mm.is_some() {
        law::check_continuous(&laws, plated, diagnostics);
    }
    let (accuracy, numerical) = accuracy::resolve(&spec.accuracy, &shapes, cycles, diagnostics);
    let (output, recorded) = output::resolve(&spec.output, &movement, &shapes, diagnostics);
    let effects = effects::resolve(&spec.effects, diagnostics);
    let environment = environment::resolve(&spec.environment, diagnostics);
    let mut filled = Spec {
        system,
        materials,
        interface,
        plating: platings,
        load: Some(load),
        environment,
        motion: movement.motion.clone(),
        cycles: movement.cycles,
        mission: movement.mission.clone(),
        repeat: movement.repeat,
        order: movement.order.map(Into::into),
        accuracy,
        output,
        provenance: BTreeMap::new(),
        ..spec.clone()
    };
    changing_friction::check(&filled, &laws.friction, diagnostics);
    let softening = environment::softening(&filled, diagnostics);
    let thermal = environment::conductors(&filled);
    let bodies = conductors::Bodies {
        layers: &layers,
        elastic: &elastic,
        motion: movement.scene,
    };
    let mut conductors = conductors::resolve(&mut filled, bodies, diagnostics);
    let wears = laws.wear.zip(plated);
    let surfaces = (&layers, wears.map(|(law, plated)| law.is_some() || plated));
    let (stop, criteria) = limits(spec, &mut filled, surfaces, &mut conductors, diagnostics);
    let scene = Scene {
        slider: Body {
            shape: shapes.slider,
            elastic: elastic.slider,
            wear: laws.wear.slider,
            plating: layers.slider,
            thermal: thermal.slider,
            softening: softening.slider,
        },
        receptacle: Body {
            shape: shapes.block,
            elastic: elastic.receptacle,
            wear: laws.wear.receptacle,
            plating: layers.receptacle,
            thermal: thermal.receptacle,
            softening: softening.receptacle,
        },
        friction: laws.friction.until(crate::number::real(cycles)),
        temperature_c: surroundings_c,
        load_n_per_mm: line_load.n_per_mm,
        spring_n_per_mm2: line_load.spring_n_per_mm2,
        drive: movement.drive,
        motion: movement.scene,
        timing: movement.timing.clone(),
        cycles,
        mission: movement.blocks.clone(),
        cycles_at_a_time: None,
        accuracy: numerical,
        output: recorded,
        stop,
        life: criteria,
        conduction: conductors.conduction,
        effects,
        scattered: Vec::new(),
    };
    Filled {
        spec: filled,
        scene,
        movement,
        resistance_lacks: conductors.lacks,
    }
}

/// The motion or the mission.
fn resolve_movement(
    spec: &Spec,
    preset: &Preset,
    contact: motion::HeldContact,
    diagnostics: &mut Diagnostics,
) -> Movement {
    if !spec.mission.is_empty() {
        return mission::resolve(spec, preset, contact, diagnostics);
    }
    if spec.repeat.is_some() {
        diagnostics.fault("/repeat", "it repeats a `mission`, which is not given");
    }
    if spec.order.is_some() {
        diagnostics.fault("/order", "it orders a `mission`, which is not given");
    }
    let motion = motion::resolve(spec.motion.as_ref(), preset, contact, diagnostics);
    let cycles = motion::cycles(spec.cycles, &motion, preset, diagnostics);
    Movement::single(motion, cycles)
}

/// Criteria that end the run, and those whose life is recorded; limits of the resistance belong to what conducts.
fn limits(
    spec: &Spec,
    filled: &mut Spec,
    (plating, wears): (&Sides<Vec<Layer>>, Sides<bool>),
    conductors: &mut Conductors,
    diagnostics: &mut Diagnostics,
) -> (Vec<Criterion>, Vec<Criterion>) {
    let surfaces = criterion::Surfaces {
        plating,
        wears,
        resistance_lacks: &conductors.lacks,
    };
    let (stop, stop_mohm) = stop::resolve(&spec.stop, surfaces, diagnostics);
    let (life, criteria, life_mohm) = life::resolve(&spec.life, surfaces, diagnostics);
    filled.life = life;
    if let Conduction::Known(electrical) = &mut conductors.conduction {
        (electrical.stop_mohm, electrical.life_mohm) = (stop_mohm, life_mohm);
    }
    (stop, criteria)
}

/// Cycles in the histories of a resolved specification.
pub fn cycles(spec: &Spec) -> u64 {
    if is_continuous(spec) {
        return motion::CONTINUOUS_PARTS;
    }
    let blocks = spec.mission.iter().filter_map(|block| block.cycles);
    let mission = blocks.fold(0, u64::saturating_add);
    spec.cycles
        .unwrap_or_else(|| mission.saturating_mul(spec.repeat.unwrap_or(1)))
}

/// Whether the motion of a resolved specification is continuous.
pub(crate) fn is_continuous(spec: &Spec) -> bool {
    let motion = spec.motion.as_ref();
    motion.is_some_and(|motion| motion.distance_mm.is_some())
}

fn check_names(spec: &Spec, diagnostics: &mut Diagnostics) {
    if let Some(name) = &spec.name {
        diagnostics.check_text("/name", name, NAME_LIMIT);
    }
    let labels = spec.labels.len();
    if labels > LABEL_LIMIT {
        let detail = format!("{labels} labels, at most {LABEL_LIMIT} are allowed");
        diagnostics.fault("/labels", detail);
        return;
    }
    for (key, value) in &spec.labels {
        let pointer = format!("/labels/{}", api::spec::pointer_token(key));
        if key.is_empty() {
            diagnostics.fault(&pointer, "the key of a label is empty");
        }
        diagnostics.check_text(&pointer, key, LABEL_TEXT_LIMIT);
        diagnostics.check_text(&pointer, value, LABEL_TEXT_LIMIT);
    }
}

#[cfg(test)]
mod tests;
