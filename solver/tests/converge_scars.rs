//! Mesh convergence of worn profiles: with the element halved twice, the change of the profile shrinks at the observed
//! order.
//!
//! E(h) = integral |d_h - d_(h/2)| dx / integral d dx at the same cycles, jumps and increments; order = log2 of the
//! ratio of two such changes. Linear elements and a contact edge that lies anywhere between two nodes suggest
//! first order in the width of the scar and a higher one in its depth.

use crate::verification::recorder::{depth_at, solve};
use crate::verification::scenes::{fuzz_button, mccoll};
use solver::record::DepthProfile;
use solver::scene::Scene;

fn profile(scene: &Scene) -> DepthProfile {
    let (_, recorder) = solve(scene).expect("the scene can be solved");
    recorder.last_profile().clone()
}

/// Relative L1 distance of two profiles on [-half, half].
fn distance(a: &DepthProfile, b: &DepthProfile, half: f64) -> f64 {
    let places = (0..2_000).map(|i| half * (f64::from(i) / 1_000.0 - 1.0));
    let (mut difference, mut area) = (0.0, 0.0);
    for x in places {
        difference += (depth_at(a, x) - depth_at(b, x)).abs();
        area += depth_at(b, x);
    }
    difference / area
}

fn order(name: &str, scene: &Scene, coarsest: f64, half: f64) -> f64 {
    let with = |element: f64| {
        let mut scene = scene.clone();
        scene.accuracy.contact_element_mm = Some(element);
        profile(&scene)
    };
    let profiles = [with(coarsest), with(coarsest / 2.0), with(coarsest / 4.0)];
    let coarse = distance(&profiles[0], &profiles[1], half);
    let fine = distance(&profiles[1], &profiles[2], half);
    let order = (coarse / fine).log2();
    println!("{name}: profile changes by {coarse:.2e}, then {fine:.2e}: order {order:.2}");
    assert!(fine < coarse, "{coarse} {fine}");
    order
}

#[test]
fn short_stroke_scar_converges_with_mesh_refinement() {
    let mut scene = Scene {
        cycles: 1_000,
        ..mccoll()
    };
    scene.accuracy.cycle_jump = Some(20);
    scene.accuracy.increments_per_cycle = Some(40);
    scene.output.snapshots_at_cycles = vec![1_000];
    assert!(order("mccoll, 16 -> 8 -> 4 um", &scene, 0.016, 0.15) > 1.0);
}

#[test]
fn long_stroke_groove_converges_with_mesh_refinement() {
    let mut scene = Scene {
        cycles: 40,
        ..fuzz_button()
    };
    scene.accuracy.cycle_jump = Some(4);
    scene.accuracy.increments_per_cycle = Some(400);
    scene.output.snapshots_at_cycles = vec![40];
    assert!(order("fuzz button, 0.8 -> 0.4 -> 0.2 um", &scene, 8e-4, 0.04) > 0.9);
}
