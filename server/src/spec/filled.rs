//! Last stage: the scene, and the specification with every default filled in.

use api::spec::{Spec, SystemKind};
use solver::law::softening::REFERENCE_C;
use solver::resolution;
use solver::scene::{Body, Conduction, Dimension, Scene, Softening};
use solver::sides::Sides;

use crate::number::real;
use crate::spec::criterion::Surfaces;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::stages::{Bodies, Loading, Numerics};
use crate::spec::{changing_friction, conductors, environment, life, model, stop};

/// A specification with its defaults.
pub(super) struct Filled {
    pub(super) spec: Spec,
    /// The dimension that was chosen, with the reason.
    pub(super) chosen: Option<String>,
    pub(super) scene: Scene,
    pub(super) resistance_lacks: Vec<String>,
}

/// The scene of a specification without faults.
pub(super) fn scene_of(spec: &Spec, kind: SystemKind) -> Option<Scene> {
    let mut diagnostics = Diagnostics::default();
    let bodies = Bodies::resolve(kind, spec, &mut diagnostics);
    let loading = Loading::resolve(&bodies, spec, &mut diagnostics);
    let numerics = Numerics::resolve(&loading, spec, &mut diagnostics);
    let Filled { scene, .. } = resolve(&numerics, &mut diagnostics);
    diagnostics.is_clean().then_some(scene)
}

/// Makes the scene, and fills in the fields that depend on all stages.
pub(super) fn resolve(numerics: &Numerics<'_>, diagnostics: &mut Diagnostics) -> Filled {
    let (spec, loading) = (&numerics.spec, numerics.loading);
    let bodies = loading.bodies;
    model::check(spec, bodies.dimension, &loading.movement, diagnostics);
    changing_friction::check(spec, &bodies.laws.friction, diagnostics);
    let softening = environment::softening(spec, diagnostics);
    let conductors = conductors::resolve(numerics, diagnostics);
    let wears = bodies.laws.wear.zip(bodies.plated);
    let surfaces = Surfaces {
        plating: &bodies.layers,
        wears: wears.map(|(law, plated)| law.is_some() || plated),
        resistance_lacks: &conductors.lacks,
    };
    let (stop, stop_mohm) = stop::resolve(&spec.stop, surfaces, diagnostics);
    let (life, criteria, life_mohm) = life::resolve(&spec.life, surfaces, diagnostics);
    life::check_motion(&spec.life, loading.movement.scene, diagnostics);
    let mut conduction = conductors.conduction;
    // Limits of the resistance belong to what conducts.
    if let Conduction::Known(electrical) = &mut conduction {
        (electrical.stop_mohm, electrical.life_mohm) = (stop_mohm, life_mohm);
    }
    let section = Scene {
        stop,
        life: criteria,
        conduction,
        ..section(numerics, softening)
    };
    let (mut scene, chosen) = model::with_dimension(section, bodies.dimension, spec, diagnostics);
    scene.accuracy.narrowest_contact_mm = resolution::first_flat(&scene);
    let (dimension, chosen) = chosen.unzip();
    let mut filled = Spec {
        life,
        ..spec.clone()
    };
    filled.interface.spots = conductors.spots;
    if let Some(model) = &mut filled.model {
        model.chosen = dimension.map(Into::into);
    }
    Filled {
        spec: filled,
        chosen,
        scene,
        resistance_lacks: conductors.lacks,
    }
}

/// The section of all stages, which neither conducts nor ends early.
fn section(numerics: &Numerics<'_>, softening: Sides<Softening>) -> Scene {
    let (spec, loading) = (&numerics.spec, numerics.loading);
    let (bodies, movement) = (loading.bodies, &loading.movement);
    let (layers, laws) = (bodies.layers.clone(), bodies.laws.clone());
    let thermal = environment::conductors(spec);
    Scene {
        dimension: Dimension::PlaneStrain,
        slider: Body {
            shape: bodies.shapes.slider,
            elastic: bodies.elastic.slider,
            wear: laws.wear.slider,
            plating: layers.slider,
            thermal: thermal.slider,
            softening: softening.slider,
        },
        receptacle: Body {
            shape: bodies.shapes.block,
            elastic: bodies.elastic.receptacle,
            wear: laws.wear.receptacle,
            plating: layers.receptacle,
            thermal: thermal.receptacle,
            softening: softening.receptacle,
        },
        friction: laws.friction.until(real(movement.total_cycles)),
        temperature_c: spec.environment.temperature_c.unwrap_or(REFERENCE_C),
        load_n_per_mm: loading.line_load.n_per_mm,
        spring_n_per_mm2: loading.line_load.spring_n_per_mm2,
        drive: movement.drive,
        motion: movement.scene,
        timing: movement.timing.clone(),
        cycles: movement.total_cycles,
        mission: movement.blocks.clone(),
        cycles_at_a_time: None,
        accuracy: numerics.accuracy,
        output: numerics.output.clone(),
        stop: Vec::new(),
        life: Vec::new(),
        conduction: Conduction::default(),
        effects: numerics.effects.clone(),
        scattered: Vec::new(),
        threads: 1,
    }
}
