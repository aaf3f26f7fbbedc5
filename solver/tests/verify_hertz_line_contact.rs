//! Hertz line contact.
//!
//! ```text
//!        |P = 18.5 N/mm
//!      .-v-.        a  = sqrt(4 P R / (pi E*)) = 0.03586 mm
//!     ( R=6 )       p0 = 2 P / (pi a)          = 328.4 MPa
//!   ___`-.-'___     E* = E / (2 (1 - nu^2))    (Johnson, Contact Mechanics, 1985, eqs. 4.43-4.46)
//! ```
//! The bodies are finite (12 x 6 mm and a cylinder section of 9 x 6 mm), a/R = 0.6 %, so Hertz holds to O(a/R).

use crate::keep::solve;
use crate::scenes::mccoll;
use solver::scene::{Elastic, Friction, Scene};
use std::f64::consts::PI;

fn hertz() -> (f64, f64) {
    let (load, radius) = (18.5, 6.0);
    let modulus = 0.5 * 200e3 / (1.0 - 0.09);
    let half_width = (4.0_f64 * load * radius / (PI * modulus)).sqrt();
    (half_width, 2.0 * load / (PI * half_width))
}

fn errors(scene: &Scene) -> (f64, f64) {
    let (summary, _) = solve(scene).expect("the scene can be solved");
    let (half_width, peak) = hertz();
    (
        (summary.initial.contact_half_width_mm / half_width - 1.0).abs(),
        (summary.initial.peak_pressure_mpa / peak - 1.0).abs(),
    )
}

#[test]
fn standard_accuracy_meets_hertz_within_two_per_cent() {
    let scene = Scene {
        cycles: 1,
        ..mccoll()
    };
    let (width, peak) = errors(&scene);
    println!("Hertz at tolerance 2 %: half-width off by {width:.2e}, peak pressure by {peak:.2e}");
    assert!(width < 0.02 && peak < 0.02);
}

/// Halving the element halves the error of the edge at least; the peak converges faster, down to the O(a/R) of the
/// finite bodies (0.1 % here, the reason for the floor).
#[test]
fn refinement_converges_to_hertz() {
    let at = |element: f64| {
        let mut scene = Scene {
            cycles: 1,
            ..mccoll()
        };
        scene.accuracy.tolerance = 0.003;
        scene.accuracy.contact_element_mm = Some(element);
        scene.receptacle.wear = None;
        scene.slider.wear = None;
        errors(&scene)
    };
    let coarse = at(0.008);
    let fine = at(0.002);
    println!("Hertz (width, peak) at 8 um: {coarse:?}, at 2 um: {fine:?}");
    assert!(
        fine.0 < 0.5 * coarse.0 && fine.0 < 3e-3,
        "{coarse:?} {fine:?}"
    );
    assert!(fine.1 < (0.25 * coarse.1).max(2e-3), "{coarse:?} {fine:?}");
}

/// Two convex bodies of unequal materials: 1/R = 1/6 + 1/4, so R = 2.4 mm; 1/E* adds up both compliances. Without
/// friction, because unequal bodies under normal load also want to slip.
#[test]
fn two_convex_bodies_of_unequal_materials_meet_hertz() {
    let mut scene = Scene {
        cycles: 1,
        friction: Friction::Frictionless,
        ..mccoll()
    };
    scene.receptacle.shape.length_mm = 6.0;
    scene.receptacle.shape.crown_radius_mm = Some(4.0);
    scene.receptacle.elastic = Elastic {
        youngs_modulus_mpa: 117e3,
        poisson_ratio: 0.34,
    };
    let (summary, _) = solve(&scene).expect("the scene can be solved");
    let compliance = (1.0 - 0.09) / 200e3 + (1.0 - 0.34 * 0.34) / 117e3;
    let half_width = (4.0_f64 * 18.5 * 2.4 * compliance / PI).sqrt();
    let peak = 2.0 * 18.5 / (PI * half_width);
    let width = summary.initial.contact_half_width_mm / half_width - 1.0;
    let peak = summary.initial.peak_pressure_mpa / peak - 1.0;
    println!("Hertz, two convex bodies: half-width off by {width:.2e}, peak by {peak:.2e}");
    assert!(width.abs() < 0.02 && peak.abs() < 0.02);
}
