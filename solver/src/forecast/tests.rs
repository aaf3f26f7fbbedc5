use super::*;
use crate::model::{Layout, tests::fuzz_button};
use crate::number::real_cycles;

#[test]
fn the_surrogate_has_the_worn_area() {
    let scene = fuzz_button();
    let layout = Layout::of(&scene).expect("it can be meshed");
    let mut scar = Scar::new(&scene, &layout, false);
    for jump in [1, 10, 100] {
        scar.wear(jump);
        let held: f64 = scar
            .depth
            .receptacle
            .iter()
            .zip(scar.widths().receptacle)
            .map(|(h, w)| h * w)
            .sum();
        // One half of the scar is stored.
        assert!((2.0 * held / scar.area - 1.0).abs() < 1e-3, "{held}");
    }
    let full = 111.0 * scar.area_per_cycle;
    assert!((scar.area / full - 1.0).abs() < 1e-12);
}

#[test]
fn a_forecast_ends_at_the_last_cycle_and_counts_rebuilt_bodies() {
    let scene = fuzz_button();
    let layout = Layout::of(&scene).expect("it can be meshed");
    let run = forecast(&scene, &layout);
    let last = run.segments.last().expect("some cycles");
    assert_eq!(last.cycle, scene.cycles);
    // The block loses three quarters of its height; the slider does not wear.
    assert_eq!(run.condensations.slider, 1);
    assert_eq!(run.condensations.receptacle, 2);
    // Later cycles have longer increments, whose waves the next pass wears off.
    assert!(last.steps < run.segments[0].steps);
}

#[test]
fn a_tighter_tolerance_costs_more_cycles_of_more_increments() {
    let work = |tolerance: f64| {
        let mut scene = fuzz_button();
        scene.accuracy.tolerance = tolerance;
        let run = forecast(&scene, &Layout::of(&scene).expect("it can be meshed"));
        (run.computed_cycles, run.increments() / run.computed_cycles)
    };
    let (loose, tight) = (work(0.1), work(0.01));
    assert!(
        tight.0 > 2.0 * loose.0 && tight.1 > 2.0 * loose.1,
        "{loose:?} {tight:?}"
    );
    assert!(tight.0 < real_cycles(fuzz_button().cycles));
}

/// A run of a million cycles, each computed in 200 000 increments, is forecast in some thousand segments.
#[test]
fn a_fixed_jump_is_forecast_in_few_segments() {
    let mut scene = fuzz_button();
    scene.cycles = 1_000_000;
    scene.accuracy.cycle_jump = Some(1);
    scene.accuracy.increments_per_cycle = Some(1_000_000);
    let run = forecast(&scene, &Layout::of(&scene).expect("it can be meshed"));
    let last = run.segments.last().expect("some cycles").cycle;
    assert!(run.segments.len() < 2_000, "{}", run.segments.len());
    assert!((run.computed_cycles - real_cycles(last)).abs() < 0.5);
}
