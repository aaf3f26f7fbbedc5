//! The first load of unlike bodies with friction, from no contact to all of it in one increment.
//!
//! The softer surface spreads and drags against the stiffer one, so that the outer part of the contact slips outward and
//! the middle sticks (Spence 1975); here the stick zone is narrower than an element. Newton's active set cycles on the finer
//! mesh, of 300 candidate nodes: 33 of them still changed after 60 iterations.

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::scene::{Elastic, Friction};

#[test]
fn unlike_bodies_are_loaded_on_a_fine_mesh() {
    let mut scene = mccoll();
    scene.cycles = 1;
    scene.output.snapshots_at_cycles = vec![1];
    scene.slider.elastic = Elastic {
        youngs_modulus_mpa: 142_616.0,
        poisson_ratio: 0.4,
    };
    scene.receptacle.elastic = Elastic {
        youngs_modulus_mpa: 4_259.0,
        poisson_ratio: 0.145,
    };
    scene.friction = Friction::Coulomb {
        coefficient: 0.1767,
    };
    let peak = |element: f64| {
        let mut scene = scene.clone();
        scene.accuracy.contact_element_mm = Some(element);
        let (summary, _) = solve(&scene).expect("the load is in equilibrium");
        summary.initial.peak_pressure_mpa
    };
    let (coarse, fine) = (peak(0.004), peak(0.002));
    println!("first load of unlike bodies: {coarse:.3} and {fine:.3} MPa");
    // The error of the peak is quadratic in the element, a fortieth of the half-width at first: (1/40)^2.
    assert!((coarse / fine - 1.0).abs() < 0.001, "{coarse} {fine}");
}
