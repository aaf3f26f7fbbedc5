//! Plans of scenes in different regimes.

use super::*;
use crate::law::temperature::Temperature;
use crate::law::wear::WearLaw;
use crate::model::tests::fuzz_button;
use crate::scene::{
    Dimension, Drive, Friction, Line, LineShape, MildOxidation, Motion, RingMotion, SpeedLaw,
    SurfaceState, Top,
};

fn simulated(scene: &Scene) -> Vec<Effect> {
    let plan = plan(scene);
    let decisions = plan.decisions.iter();
    decisions
        .filter(|decision| decision.verdict.is_on())
        .map(|decision| decision.effect)
        .collect()
}

#[test]
fn only_what_the_scene_calls_for_is_simulated() {
    let mut scene = fuzz_button();
    assert_eq!(
        simulated(&scene),
        [
            Effect::Elasticity,
            Effect::Friction,
            Effect::StickMemory,
            Effect::ReceptacleWear,
            Effect::Relocation
        ]
    );
    scene.friction = Friction::Frictionless;
    scene.receptacle.wear = None;
    assert_eq!(simulated(&scene), [Effect::Elasticity]);
}

/// A tip of the given half-width, worn to a flat, in a long stroke.
fn worn_tip(half_width_mm: f64) -> Scene {
    let mut scene = fuzz_button();
    scene.slider.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 1e-7,
    });
    scene.slider.elastic = scene.receptacle.elastic;
    scene.slider.shape.half_width_mm = half_width_mm;
    scene.slider.shape.radius_mm = 1.0;
    scene.slider.shape.height_mm = 0.02;
    scene.friction = Friction::Coulomb { coefficient: 0.1 };
    scene.cycles = 100;
    scene
}

#[test]
fn a_slender_slider_bends_under_friction_and_a_stocky_one_does_not() {
    assert!(simulated(&worn_tip(0.01)).contains(&Effect::Friction));
    assert!(!simulated(&worn_tip(0.1)).contains(&Effect::Friction));
    let mut held = worn_tip(0.01);
    held.drive = Drive::WholeBody;
    assert!(!simulated(&held).contains(&Effect::Friction));
}

#[test]
fn nothing_wears_where_nothing_slides() {
    let mut scene = fuzz_button();
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.0,
        period_s: 1.0,
    };
    assert_eq!(
        simulated(&scene),
        [Effect::Elasticity, Effect::Friction, Effect::StickMemory]
    );
}

/// A sine takes its time at the turning points, where the shear of the bodies takes up slip.
#[test]
fn wear_by_time_calls_for_friction_where_wear_by_distance_does_not() {
    let mut scene = fuzz_button();
    // The walls of a deep groove would require it too.
    scene.cycles = 50;
    scene.friction = Friction::Coulomb { coefficient: 0.05 };
    let has_friction = |scene: &Scene| simulated(scene).contains(&Effect::Friction);
    assert!(!has_friction(&scene));
    scene.receptacle.wear = Some(WearLaw::OfSpeed(SpeedLaw::MildOxidation(MildOxidation {
        constant: 1.0,
        arrhenius_m2_s: 1e-6,
        activation_j_mol: 1e5,
        film_um: 10.0,
        surface: SurfaceState {
            hardness_mpa: 427.0,
            temperature: Temperature::OfContact(800.0),
        },
    })));
    assert!(has_friction(&scene));
}

/// Every node of a section along a line slips; a contact of one section may stick as soon as shear acts on it.
#[test]
fn friction_calls_for_sticking_where_nodes_may_stick_only() {
    let required = |dimension: Dimension| {
        let mut scene = fuzz_button();
        scene.cycles = 10;
        scene.friction = Friction::Coulomb { coefficient: 0.05 };
        scene.dimension = dimension;
        let crossings = plan(&scene).required_after_failure(7);
        let effects = crossings.iter().map(|crossing| crossing.effect);
        effects.collect::<Vec<_>>()
    };
    assert_eq!(
        required(Dimension::PlaneStrain),
        [Effect::Friction, Effect::StickMemory]
    );
    let ring = Line {
        shape: LineShape::Ring {
            radius_mm: 0.5,
            motion: RingMotion::InPlane,
        },
        top: Top::Even,
        force_n: 0.0834,
        stations: Some(5),
    };
    assert_eq!(required(Dimension::Line(ring)), [Effect::Friction]);
}
