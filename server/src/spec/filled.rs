//! A specification with every default filled in, and its scene.

use std::collections::BTreeMap;

use api::spec::{Load, Spec, SystemKind};
use solver::law::softening::REFERENCE_C;
use solver::scene::{
    self, Body, Conduction, Conductor, Criterion, Elastic, Layer, Scene, Softening, WearLaw,
};
use solver::sides::Sides;

use crate::spec::conductors::{self, Conductors};
use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::LawDefaults;
use crate::spec::load::LineLoad;
use crate::spec::movement::Movement;
use crate::spec::system::{self, Preset};
use crate::spec::{
    accuracy, changing_friction, criterion, effects, environment, law, life, load, materials,
    mission, model, motion, output, plating, plating_choice, stop,
};

/// A specification with its defaults.
pub(super) struct Filled {
    pub(super) spec: Spec,
    /// The dimension that was chosen, with the reason.
    pub(super) chosen: Option<String>,
    pub(super) scene: Scene,
    pub(super) movement: Movement,
    pub(super) resistance_lacks: Vec<String>,
}

/// The scene of a specification without faults.
pub(super) fn scene_of(spec: &Spec, kind: SystemKind) -> Option<Scene> {
    let mut diagnostics = Diagnostics::default();
    let Filled { scene, .. } = fill(spec, kind, &mut diagnostics);
    diagnostics.is_clean().then_some(scene)
}

/// The specification with every default filled in, and its scene.
pub(super) fn fill(spec: &Spec, kind: SystemKind, diagnostics: &mut Diagnostics) -> Filled {
    let preset = plating_choice::preset_for_motion(spec, (system::definition(kind).preset)());
    let (system, shapes) = system::resolve(kind, &spec.system, diagnostics);
    let (materials, elastic) = materials::resolve(&spec.materials, &preset, diagnostics);
    let defaults = LawDefaults {
        preset: &preset,
        plating_choices: plating_choice::resolve(spec, &preset),
        surroundings_c: spec.environment.temperature_c.unwrap_or(REFERENCE_C),
    };
    let plated = defaults.plating_choices.map(|choice| choice.is_plated());
    let (interface, laws) = law::resolve(spec, &materials, defaults, diagnostics);
    law::check_plated_sides(&laws, plated, diagnostics);
    let (platings, layers) = plating::resolve(
        defaults.plating_choices,
        laws.friction.unworn(),
        diagnostics,
    );
    let laws = changing_friction::with_layers(laws, (&platings, &layers), diagnostics);
    let (model, dimension) = model::resolve(spec.model.as_ref(), (&shapes, kind), diagnostics);
    let (load, line_load) = resolve_load(spec, (&preset, dimension), &shapes, diagnostics);
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
        model: Some(model),
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
    model::check(&filled, (dimension, movement.scene), diagnostics);
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
    let bodies = layers
        .zip(elastic)
        .zip(laws.wear)
        .zip(thermal.zip(softening));
    let slider = body(shapes.slider, bodies.slider);
    let receptacle = body(shapes.block, bodies.receptacle);
    let scene = Scene {
        dimension: scene::Dimension::PlaneStrain,
        slider,
        receptacle,
        friction: laws.friction.until(crate::number::real(cycles)),
        temperature_c: defaults.surroundings_c,
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
        threads: 1,
    };
    let (scene, chosen) = model::with_dimension(scene, (dimension, &mut filled), diagnostics);
    Filled {
        chosen,
        spec: filled,
        scene,
        movement,
        resistance_lacks: conductors.lacks,
    }
}

/// The load, whose force needs no width where the model has one.
fn resolve_load(
    spec: &Spec,
    (preset, dimension): (&Preset, model::Resolved),
    shapes: &system::Shapes,
    diagnostics: &mut Diagnostics,
) -> (Load, LineLoad) {
    let preset = (preset, !dimension.has_width());
    load::resolve(spec.load.as_ref(), preset, shapes, diagnostics)
}

/// Layers, elastic constants, wear, conductor and softening of a body.
type Parts = (
    ((Vec<Layer>, Elastic), Option<WearLaw>),
    (Option<Conductor>, Softening),
);

/// A body of a shape.
fn body<S>(shape: S, (surface, (thermal, softening)): Parts) -> Body<S> {
    let ((plating, elastic), wear) = surface;
    Body {
        shape,
        elastic,
        wear,
        plating,
        thermal,
        softening,
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
