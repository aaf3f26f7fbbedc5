//! The stages of a resolution before its scene: bodies, their loading, and the settings of the solution.
//!
//! Each stage borrows the former one, reads fields of a specification, and fills them in. No stage reads fields of a later one, except that
//! the kind of the motion and the temperature decide about platings and laws.

use std::collections::BTreeMap;

use api::spec::{Spec, SystemKind};
use solver::law::softening::REFERENCE_C;
use solver::scene::{self, Elastic, Layer, Switches};
use solver::sides::Sides;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::{self, LawDefaults, Laws};
use crate::spec::load::{self, LineLoad};
use crate::spec::motion::{self, HeldContact};
use crate::spec::movement::Movement;
use crate::spec::system::{self, Preset, Shapes};
use crate::spec::{
    accuracy, changing_friction, effects, environment, materials, mission, model, output, plating,
    plating_choice,
};

/// Both bodies with their materials, platings and laws, and the dimension of their model.
pub(super) struct Bodies {
    pub(super) kind: SystemKind,
    /// Values for what a specification leaves out.
    pub(super) preset: Preset,
    /// The specification with the fields of the bodies filled in.
    pub(super) spec: Spec,
    pub(super) shapes: Shapes,
    pub(super) elastic: Sides<Elastic>,
    pub(super) layers: Sides<Vec<Layer>>,
    pub(super) laws: Laws,
    /// Plated sides, also by layers that have faults.
    pub(super) plated: Sides<bool>,
    pub(super) dimension: model::Resolved,
}

/// The normal load on bodies, and their motion or mission.
pub(super) struct Loading<'a> {
    pub(super) bodies: &'a Bodies,
    /// The specification with the fields of bodies and loading filled in.
    pub(super) spec: Spec,
    pub(super) line_load: LineLoad,
    pub(super) movement: Movement,
}

/// Accuracy, output and switches of effects, and the surroundings of loaded bodies.
pub(super) struct Numerics<'a> {
    pub(super) loading: &'a Loading<'a>,
    /// The specification with the fields of all stages filled in.
    pub(super) spec: Spec,
    pub(super) accuracy: scene::Accuracy,
    pub(super) output: scene::Output,
    pub(super) effects: Switches,
}

impl Bodies {
    /// Resolves the bodies of a specification of a kind.
    pub(super) fn resolve(kind: SystemKind, given: &Spec, diagnostics: &mut Diagnostics) -> Self {
        let preset = plating_choice::preset_for_motion(given, (system::definition(kind).preset)());
        let (system, shapes) = system::resolve(kind, &given.system, diagnostics);
        let (materials, elastic) = materials::resolve(&given.materials, &preset, diagnostics);
        let plating_choices = plating_choice::resolve(given, &preset);
        let plated = plating_choices.map(|choice| choice.is_plated());
        let defaults = LawDefaults {
            preset: &preset,
            plating_choices,
            surroundings_c: given.environment.temperature_c.unwrap_or(REFERENCE_C),
        };
        let (interface, laws) = law::resolve(given, &materials, defaults, diagnostics);
        law::check_plated_sides(&laws, plated, diagnostics);
        let friction = laws.friction.unworn();
        let (plating, layers) = plating::resolve(plating_choices, friction, diagnostics);
        let laws = changing_friction::with_layers(laws, &plating, &layers, diagnostics);
        let (model, dimension) = model::resolve(given.model.as_ref(), &shapes, kind, diagnostics);
        Self {
            kind,
            preset,
            spec: Spec {
                system,
                model: Some(model),
                materials,
                interface,
                plating,
                provenance: BTreeMap::new(),
                ..given.clone()
            },
            shapes,
            elastic,
            layers,
            laws,
            plated,
            dimension,
        }
    }
}

impl<'a> Loading<'a> {
    /// Resolves load and motion.
    pub(super) fn resolve(bodies: &'a Bodies, given: &Spec, diagnostics: &mut Diagnostics) -> Self {
        // A force needs no width where the model has one.
        let with_width = !bodies.dimension.has_width();
        let load = given.load.as_ref();
        let (load, line_load) = load::resolve(
            load,
            &bodies.preset,
            with_width,
            &bodies.shapes,
            diagnostics,
        );
        let contact = HeldContact {
            friction: bodies.laws.friction.unworn(),
            force_n: load.n,
        };
        let movement = movement(&bodies.preset, given, contact, diagnostics);
        if movement.distance_mm.is_some() {
            law::check_continuous(&bodies.laws, bodies.plated, diagnostics);
        }
        Self {
            bodies,
            spec: Spec {
                load: Some(load),
                motion: movement.motion.clone(),
                cycles: movement.cycles,
                mission: movement.mission.clone(),
                repeat: movement.repeat,
                order: movement.order.map(Into::into),
                ..bodies.spec.clone()
            },
            line_load,
            movement,
        }
    }
}

/// The motion or the mission.
fn movement(
    preset: &Preset,
    given: &Spec,
    contact: HeldContact,
    diagnostics: &mut Diagnostics,
) -> Movement {
    if !given.mission.is_empty() {
        return mission::resolve(given, preset, contact, diagnostics);
    }
    if given.repeat.is_some() {
        diagnostics.fault("/repeat", "it repeats a `mission`, which is not given");
    }
    if given.order.is_some() {
        diagnostics.fault("/order", "it orders a `mission`, which is not given");
    }
    let motion = motion::resolve(given.motion.as_ref(), preset, contact, diagnostics);
    let cycles = motion::cycles(given.cycles, &motion, preset, diagnostics);
    Movement::single(motion, cycles)
}

impl<'a> Numerics<'a> {
    /// Resolves the settings.
    pub(super) fn resolve(
        loading: &'a Loading<'a>,
        given: &Spec,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let (shapes, movement) = (&loading.bodies.shapes, &loading.movement);
        let cycles = movement.total_cycles;
        let (accuracy, numerical) = accuracy::resolve(&given.accuracy, shapes, cycles, diagnostics);
        let (output, recorded) = output::resolve(&given.output, movement, shapes, diagnostics);
        let effects = effects::resolve(&given.effects, diagnostics);
        let environment = environment::resolve(&given.environment, diagnostics);
        Self {
            loading,
            spec: Spec {
                accuracy,
                output,
                environment,
                ..loading.spec.clone()
            },
            accuracy: numerical,
            output: recorded,
            effects,
        }
    }
}
