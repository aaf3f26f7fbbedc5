//! Hertz line contact.
//!
//! ```text
//!        |P = 18.5 N/mm
//!      .-v-.        a  = sqrt(4 P R / (pi E*)) = 0.03586 mm
//!     ( R=6 )       p0 = 2 P / (pi a)          = 328.4 MPa
//!   ___`-.-'___     E* = E / (2 (1 - nu^2))    (Johnson, Contact Mechanics, 1985, eqs. 4.43-4.46)
//! ```
//! The bodies are finite (12 x 6 mm and a cylinder section of 9 x 6 mm), a/R = 0.6 %, so Hertz holds to O(a/R).

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::scene::{Elastic, Friction, Motion, Scene};
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

/// The pressure's error, integral |p - p_Hertz| dx / P, at 1/100 of the load: a/R = 0.06 %, so that the bodies'
/// finite size (O(a/R)) stays below the mesh's error. Hertz' pressure ends as a square root, for which linear
/// elements converge with order 3/2 in this norm; the position of the edge between two nodes adds scatter.
#[test]
fn pressure_converges_to_hertz_at_the_order_that_its_edge_allows() {
    let (half_width, peak) = hertz();
    let (load, half_width, peak) = (0.185, 0.1 * half_width, 0.1 * peak);
    let error = |elements: f64| {
        let mut scene = Scene {
            cycles: 1,
            load_n_per_mm: load,
            friction: Friction::Frictionless,
            ..mccoll()
        };
        scene.motion = Motion::Continuous { step_mm: 1e-3 };
        scene.accuracy.tolerance = 0.003;
        scene.accuracy.contact_element_mm = Some(half_width / elements);
        scene.receptacle.wear = None;
        scene.slider.wear = None;
        let (_, recorder) = solve(&scene).expect("the scene can be solved");
        let field = &recorder.snapshots[0].positions[0];
        let spots = field.x_mm.windows(2).zip(field.pressure_mpa.windows(2));
        // Ten places an element, so that the quadrature of the norm adds no error.
        let difference = |x: &[f64], p: &[f64]| {
            let places = (0..10).map(|i| 0.1 * (f64::from(i) + 0.5));
            let at = |t: f64| {
                let place = (1.0 - t) * x[0] + t * x[1];
                let exact = peak * (1.0 - (place / half_width).powi(2)).max(0.0).sqrt();
                ((1.0 - t) * p[0] + t * p[1] - exact).abs()
            };
            0.1 * (x[1] - x[0]) * places.map(at).sum::<f64>()
        };
        spots.map(|(x, p)| difference(x, p)).sum::<f64>() / load
    };
    let meshes = [3.0, 6.0, 12.0, 24.0, 48.0];
    let errors = meshes.map(error);
    for (elements, error) in meshes.iter().zip(&errors) {
        println!("Hertz, {elements} elements across a: pressure off by {error:.2e} of P");
    }
    let order = (errors[0] / errors[4]).log2() / 4.0;
    println!("Hertz: order {order:.2} in the pressure");
    assert!(order > 1.2, "{errors:?}");
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
