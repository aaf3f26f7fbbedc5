//! Invariance to the unit of length, and to the exchange of wear coefficient for sliding distance; energy balance.

use crate::verification::recorder::solve;
use crate::verification::scenes::{groove, mccoll, partial_slip};
use solver::scene::{Motion, Scene, WearLaw};

/// All lengths times 4 (and the line load with them) at the same stresses: all depths times 4, up to
/// round-off in the mesh grading.
#[test]
fn depths_scale_with_all_lengths() {
    let scene = Scene {
        cycles: 300,
        ..mccoll()
    };
    let mut large = scene.clone();
    large.slider.shape.radius_mm *= 4.0;
    large.slider.shape.half_width_mm *= 4.0;
    large.slider.shape.height_mm *= 4.0;
    large.receptacle.shape.length_mm *= 4.0;
    large.receptacle.shape.height_mm *= 4.0;
    large.load_n_per_mm *= 4.0;
    large.motion = Motion::Reciprocating {
        amplitude_mm: 0.1,
        period_s: 0.05,
    };
    let depth = |scene: &Scene| {
        let (summary, _) = solve(scene).expect("the scene can be solved");
        summary.last.receptacle.max_depth_mm
    };
    let (small, large) = (depth(&scene), depth(&large));
    assert!(
        (large / (4.0 * small) - 1.0).abs() < 1e-9,
        "{small} {large}"
    );
}

/// Half the wear coefficient over twice the cycles wears the same scar, within the tolerance of both runs.
#[test]
fn half_the_coefficient_over_twice_the_distance_wears_the_same_scar() {
    let scene = Scene {
        cycles: 4_000,
        ..mccoll()
    };
    let mut slow = Scene {
        cycles: 8_000,
        ..mccoll()
    };
    let half = |k| {
        Some(WearLaw::Archard {
            k_over_h_per_mpa: 0.5 * k,
        })
    };
    slow.slider.wear = half(1.9e-8);
    slow.receptacle.wear = half(2.9e-8);
    let run = |scene: &Scene| {
        solve(scene)
            .expect("the scene can be solved")
            .0
            .last
            .receptacle
    };
    let (fast, slow) = (run(&scene), run(&slow));
    let depth = slow.max_depth_mm / fast.max_depth_mm - 1.0;
    let width = slow.scar_half_width_mm / fast.scar_half_width_mm - 1.0;
    println!("half k over twice the distance: depth {depth:.1e}, half-width {width:.1e}");
    assert!(depth.abs() < 0.01 && width.abs() < 0.01, "{depth} {width}");
}

/// The energy dissipated in a cycle equals the area of the force-displacement loop, in gross and in partial slip and with the
/// increments that a tolerance chooses. Backward Euler takes the force at the end of an increment.
#[test]
fn dissipated_energy_is_the_area_of_the_friction_loop() {
    // In partial slip the loop is curved everywhere, and its 20 chords cut off more.
    for (name, scene, increments, limit) in [
        ("gross slip", mccoll(), Some(160), 0.01),
        ("gross slip", mccoll(), None, 0.01),
        ("partial slip", partial_slip(), None, 0.02),
        ("groove", groove(), None, 0.01),
    ] {
        let mut scene = Scene { cycles: 3, ..scene };
        scene.accuracy.increments_per_cycle = increments;
        scene.output.snapshots_at_cycles = vec![2, 3];
        let (_, recorder) = solve(&scene).expect("the scene can be solved");
        let energy = |cycle| recorder.at(cycle).dissipated_energy_mj_per_mm;
        let dissipated = energy(3) - energy(2);
        let last = &recorder.snapshots[recorder.snapshots.len() - 1];
        let (x, q) = (
            &last.friction_loop.displacement_mm,
            &last.friction_loop.tangential_force_n_per_mm,
        );
        let n = x.len();
        let area: f64 = (0..n)
            .map(|i| 0.5 * (q[i] + q[(i + 1) % n]) * (x[(i + 1) % n] - x[i]))
            .sum();
        println!("{name}, {n} points: dissipated {dissipated:.4e} mJ/mm, loop {area:.4e} mJ/mm");
        assert!(
            (dissipated / area - 1.0).abs() < limit,
            "{name}: {dissipated} {area}"
        );
    }
}
