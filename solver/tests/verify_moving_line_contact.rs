//! A line contact that moves over a place wears it by k times the integral of p ds = k P, whatever the mesh, the step
//! or the shape of the pressure.
//!
//! ```text
//!    P ->  ...  ->         each place between the turning points is passed twice in a cycle: 2 k P deep
//!   ( )        ( )         (engine: k = 1e-10 per MPa, so that the groove, 0.4 pm, does not change the geometry)
//!  ___________________
//! ```
//! The depth differs from 2 k P because the contact sticks for the first micrometre after each turning point and the
//! surface is strained as it passes, together 0.1 %; and because elements or steps as long as half the half-width sample the pressure coarsely, by
//! a few per cent at single places, without effect on the mean.

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::scene::{Effect, Switches};
use solver::scene::{Friction, Motion, Scene, WearLaw};

const K: f64 = 1e-10;

/// Largest and mean deviation of the depth from 2 k P over the places that the contact has passed completely.
fn deviation(radius: f64, friction: f64, element: f64, increments: u32) -> (f64, f64) {
    let amplitude = 0.4;
    let mut scene = Scene {
        cycles: 1,
        motion: Motion::Reciprocating {
            amplitude_mm: amplitude,
            period_s: 1.0,
        },
        friction: if friction > 0.0 {
            Friction::Coulomb {
                coefficient: friction,
            }
        } else {
            Friction::Frictionless
        },
        ..mccoll()
    };
    scene.slider.shape.radius_mm = radius;
    scene.slider.shape.half_width_mm = 0.75 * radius;
    scene.slider.shape.height_mm = radius;
    scene.slider.wear = None;
    scene.receptacle.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: K,
    });
    if friction > 0.0 {
        scene.effects = Switches::default()
            .with(Effect::Friction, true)
            .with(Effect::StickMemory, true);
    }
    scene.accuracy.contact_element_mm = Some(element);
    scene.accuracy.increments_per_cycle = Some(increments);
    scene.output.snapshots_at_cycles = vec![1];
    let (summary, recorder) = solve(&scene).expect("the scene can be solved");
    let passed = amplitude - 2.0 * summary.initial.contact_half_width_mm - 2.0 * element;
    let profile = &recorder
        .snapshots
        .last()
        .expect("cycle 1 has a snapshot")
        .receptacle;
    let places = profile.x_mm.iter().zip(&profile.depth_mm);
    let ratios: Vec<f64> = places
        .filter(|(x, _)| x.abs() < passed)
        .map(|(_, depth)| depth / (2.0 * K * scene.load_n_per_mm) - 1.0)
        .collect();
    let count = f64::from(u32::try_from(ratios.len()).expect("some hundred places"));
    let largest = ratios.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
    println!(
        "moving contact, R = {radius} mm, mu = {friction}, h = {} um, step = {} um: mean {:.1e}, largest {largest:.1e}",
        1e3 * element,
        4e3 * amplitude / f64::from(increments),
        ratios.iter().sum::<f64>() / count
    );
    (largest, ratios.iter().sum::<f64>().abs() / count)
}

/// Half-widths are 36 um at R = 6 mm and 18 um at R = 1.5 mm; meshes from a/9 to a/2, steps from a/9 to a/2.
#[test]
fn every_passed_place_wears_by_k_times_the_line_load() {
    for (radius, friction, element, increments, largest) in [
        (6.0, 0.0, 0.004, 400, 0.005),
        (6.0, 0.9, 0.004, 400, 0.005),
        (6.0, 0.9, 0.009, 400, 0.01),
        (6.0, 0.9, 0.018, 100, 0.05),
        (1.5, 0.3, 0.004, 200, 0.05),
        (1.5, 0.3, 0.004, 400, 0.01),
    ] {
        let (worst, mean) = deviation(radius, friction, element, increments);
        assert!(worst < largest && mean < 0.005, "{worst} {mean}");
    }
}
