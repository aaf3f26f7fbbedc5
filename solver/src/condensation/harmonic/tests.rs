use std::f64::consts::PI;

use super::*;
use crate::model::tests::fuzz_button;
use crate::model::{self, Model};
use crate::scene::{Accuracy, Scene};

const YOUNG: f64 = 117_000.0;
const POISSON: f64 = 0.34;
/// Radius of the fuzz button's wire and of the centre line of its ring, mm.
const WIRE: f64 = 0.0254;
const RING: f64 = 0.4826;
const HALF_WIDTH: f64 = 4e-4;

fn built(scene: &Scene) -> Model {
    let plan = crate::effects::plan(scene);
    model::build(scene, &plan).expect("the scene can be meshed")
}

fn draft() -> Scene {
    Scene {
        accuracy: Accuracy::from_tolerance(0.1),
        ..fuzz_button()
    }
}

fn of(model: &Model, side: Side, waves: &[(Waves, FarFace)]) -> Vec<f64> {
    let body = model.bodies.of(side);
    harmonic_compliances(body, side, HALF_WIDTH, waves).expect("the body is held")
}

fn straight(per_mm: f64) -> Waves {
    Waves {
        per_mm,
        radius_mm: None,
    }
}

fn ring(n: f64) -> Waves {
    Waves {
        per_mm: n / RING,
        radius_mm: Some(RING),
    }
}

/// Long waves bend a straight wire about its top, which keeps its place: E I k^4 with I = pi r^4/8 of a half circle about its diameter.
/// Shear adds (k r)^2 times a number of about 0.3.
#[test]
fn long_waves_bend_a_wire_about_its_top() {
    let model = built(&draft());
    for k in [0.5, 1.0, 2.0, 4.0] {
        let found = of(&model, Side::Slider, &[(straight(k), FarFace::HeldInPlane)]);
        let beam = YOUNG * PI * WIRE.powi(4) / 8.0 * k.powi(4);
        let off = 1.0 / found[0] / beam - 1.0;
        assert!(off.abs() < 0.005, "k = {k}: {off}");
    }
}

/// An independent code (numpy, no code shared) has 2.4 N/mm per mm.
#[test]
fn two_waves_lift_the_wire_of_a_ring_as_a_reference_has_it() {
    let model = built(&draft());
    let none = of(&model, Side::Slider, &[(straight(0.0), FarFace::Held)])[0];
    let two = of(&model, Side::Slider, &[(ring(2.0), FarFace::HeldInPlane)])[0];
    let stiffness = 1.0 / (two - none);
    assert!((stiffness / 2.4 - 1.0).abs() < 0.02, "{stiffness}");
}

/// The same code has changes of 0.13, 0.9 and 5 % for 4, 8 and 16 waves of the receptacle, and of 0.03, 0.13 and 0.9 % of the wire. Those of
/// the receptacle are 0.15, 0.98 and 5.1 % here; those of the wire, a thousandth of what it deforms, are 0.55 to 0.7 of the reference,
/// which gives neither its mesh nor its contact.
#[test]
fn waves_around_a_ring_change_the_compliance_as_a_reference_has_it() {
    let model = built(&draft());
    let waves = [4.0, 8.0, 16.0].map(|n| (ring(n), FarFace::Held));
    for (side, reference) in [
        (Side::Slider, [0.0003, 0.0013, 0.009]),
        (Side::Receptacle, [0.0013, 0.009, 0.05]),
    ] {
        let none = of(&model, side, &[(straight(0.0), FarFace::Held)])[0];
        let found = of(&model, side, &waves);
        for (found, reference) in found.iter().zip(reference) {
            let change = 1.0 - found / none;
            assert!(
                change > 0.4 * reference && change < 1.2 * reference,
                "{change}"
            );
        }
    }
}

/// Waves between the lengths of contact and body see a half-space: 2 (1 - nu^2)/(pi E) for each factor of e. The longest of these, 40/mm, is 2.5 over
/// the height of the block, and leaves 3 %.
#[test]
fn waves_shorter_than_the_body_see_a_half_space() {
    let model = built(&draft());
    let at = |k: f64| of(&model, Side::Receptacle, &[(straight(k), FarFace::Held)])[0];
    let slope = (at(40.0) - at(160.0)) / 4.0_f64.ln();
    let half_space = 2.0 * (1.0 - POISSON * POISSON) / (PI * YOUNG);
    assert!(
        (slope / half_space - 1.0).abs() < 0.05,
        "{}",
        slope / half_space
    );
}
