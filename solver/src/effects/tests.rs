//! Plans of scenes in different regimes.

use super::*;
use crate::model::tests::fuzz_button;
use crate::scene::{Friction, Motion};

fn simulated(scene: &Scene) -> Vec<&'static str> {
    let plan = plan(scene);
    let decisions = plan.decisions.iter();
    decisions
        .filter(|decision| decision.verdict.is_on())
        .map(|decision| decision.effect.name())
        .collect()
}

#[test]
fn only_what_the_scene_calls_for_is_simulated() {
    let mut scene = fuzz_button();
    assert_eq!(
        simulated(&scene),
        [
            "elasticity",
            "friction",
            "stick_memory",
            "receptacle_wear",
            "relocation"
        ]
    );
    scene.friction = Friction::Frictionless;
    scene.receptacle.wear = None;
    assert_eq!(simulated(&scene), ["elasticity"]);
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
        ["elasticity", "friction", "stick_memory"]
    );
}
