//! Extruded bodies as runs of a scene: checkpoints, layers, springs, lives and stated errors are those of a section's run.

use super::WIDTH;
use crate::verification::recorder::{check_stated_error, solve};
use crate::verification::scenes::fuzz_button;
use crate::verification::verify_plating::layer;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::scene::Effect;
use solver::scene::{Accuracy, Criterion, Dimension, Ends, Extruded, Scene, WearLaw};
use solver::sides::Side;

/// The thesis' fuzz button in layers.
pub(super) fn extruded(layers: usize, ends: Ends, cycles: u64) -> Scene {
    let mut scene = fuzz_button();
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.cycles = cycles;
    scene.output.snapshots_at_cycles = vec![cycles];
    scene.dimension = Dimension::Extruded(Extruded {
        width_mm: WIDTH,
        layers,
        layer_growth: 1.5,
        ends,
    });
    scene
}

/// Both sides worn through a layer under a spring, and bodies that are condensed again.
#[test]
fn a_resumed_run_of_extruded_bodies_reaches_the_bits_of_the_undisturbed_one() {
    let mut scene = extruded(2, Ends::Free, 8);
    scene.accuracy.increments_per_cycle = Some(40);
    let rate = 2.5761e-6;
    let law = WearLaw::Archard {
        k_over_h_per_mpa: rate,
    };
    (scene.slider.wear, scene.receptacle.wear) = (Some(law), Some(law));
    let plating = vec![layer(4e-6, 0.5 * rate)];
    (scene.slider.plating, scene.receptacle.plating) = (plating.clone(), plating);
    scene.spring_n_per_mm2 = 400.0;
    scene.life = vec![Criterion::deepest(Side::Slider, 4e-6)];
    let (summary, _) = resumes_to_the_same_bits("extruded", &scene, 2);
    assert!(summary.life.criteria[0].cycles.is_some());
    assert!(summary.checks.worn_area < 1e-10, "{:?}", summary.checks);
    assert!(summary.checks.force_balance < 1e-9, "{:?}", summary.checks);
    let mut worn = extruded(2, Ends::Free, 150);
    worn.receptacle.shape.height_mm = 0.006;
    worn.effects = worn.effects.with(Effect::Relocation, true);
    let (summary, _) = resumes_to_the_same_bits("extruded, relocated", &worn, 2);
    assert!(summary.resolution.relocations > 0);
}

/// The run of a scene between held ends is that of the section within the errors that both state.
#[test]
fn held_ends_wear_as_the_section_within_their_stated_errors() {
    let mut scene = extruded(2, Ends::Held, 40);
    scene.accuracy.estimate_errors = true;
    let (held, _) = solve(&scene).expect("it can be solved");
    scene.dimension = Dimension::PlaneStrain;
    scene.effects = scene.effects.with(Effect::StickMemory, false);
    let (plane, _) = solve(&scene).expect("it can be solved");
    let depth = |summary: &solver::record::Summary| summary.last.receptacle.max_depth_mm;
    let (held_mm, plane_mm) = (depth(&held), depth(&plane));
    let stated = [&held, &plane].map(|summary| {
        let errors = summary.errors.expect("errors are estimated");
        errors.worn_depth.relative
    });
    println!("held ends {held_mm:.6e} mm, the section {plane_mm:.6e} mm; stated {stated:?}");
    // They differ by their jumps: the section extrapolates its groove between two computed cycles.
    let off = (held_mm / plane_mm - 1.0).abs();
    assert!(off < 0.01);
    assert!(off <= stated[0] + stated[1], "{off} {stated:?}");
}

/// Free ends against a finer run.
#[test]
fn the_stated_error_of_free_ends_covers_that_against_a_finer_run() {
    let mut scene = extruded(2, Ends::Free, 40);
    scene.accuracy.estimate_errors = true;
    let mut finer = scene.clone();
    finer.accuracy = Accuracy::from_tolerance(0.02);
    finer.accuracy.estimate_errors = false;
    let (run, _) = solve(&scene).expect("it can be solved");
    let (reference, _) = solve(&finer).expect("it can be solved");
    check_stated_error("extruded", &run, &reference);
}
