//! Lives of plated contacts, and the work that an interface costs.
//!
//! * A criterion is reached at the same cycle whether the run stops there or continues.
//! * A base that wears twenty times as fast as its plating, or not at all, needs few computed cycles more than a bare body.

use crate::verification::recorder::solve;
use crate::verification::verify_plating::{THICKNESS, layer, plated};
use solver::record::{Outcome, Summary};
use solver::scene::{Criterion, Scene, WearLaw};
use solver::sides::Side;

/// Amplitudes of a scar and of a groove, mm.
const AMPLITUDES: [f64; 2] = [0.004, 0.1];

fn summary(scene: &Scene) -> Summary {
    solve(scene).expect("the scene can be solved").0
}

/// Cycles at which a run that stops there reaches a criterion, and at which its life is reached by one that continues three times as
/// long.
fn stopped_and_passed(scene: &Scene, criterion: Criterion) -> (f64, f64) {
    let mut stopped = scene.clone();
    stopped.stop = vec![criterion];
    let stopped = summary(&stopped);
    assert_eq!(stopped.outcome, Outcome::StopCondition);
    let last = stopped.last.cycle;
    let mut passed = scene.clone();
    passed.life = vec![criterion];
    passed.cycles = 3 * last;
    let life = summary(&passed).life.criteria[0];
    let cycles = u32::try_from(last).expect("few cycles");
    (f64::from(cycles), life.cycles.expect("it is reached"))
}

fn a_life_is_the_same_whether_the_run_stops_or_goes_on() {
    let bottom = THICKNESS[0] + THICKNESS[1];
    for amplitude in AMPLITUDES {
        for (tolerance, part, depth_mm) in [
            (0.02, 0.0, THICKNESS[0]),
            (0.02, 0.5, THICKNESS[0]),
            (0.02, 0.0, bottom),
            (0.1, 0.0, bottom),
            (0.1, 0.5, bottom),
        ] {
            let sides = &Side::BOTH[1..];
            let mut scene = plated(amplitude, sides, 1_000_000, tolerance);
            // A base that does not wear carries the load before half of the scar is through.
            let unworn = part <= 0.0 || depth_mm < bottom;
            let bases = [Some(scene.receptacle.wear), unworn.then_some(None)];
            for base in bases.into_iter().flatten() {
                scene.receptacle.wear = base;
                let side = Side::Receptacle;
                let criterion = Criterion {
                    side,
                    part,
                    depth_mm,
                };
                let (stopped, passed) = stopped_and_passed(&scene, criterion);
                let off = passed / stopped - 1.0;
                println!(
                    "life at {tolerance}, amplitude {amplitude} mm, {part} of the scar {depth_mm} mm deep, base {}: {off:+.1e}",
                    if base.is_some() {
                        "wears"
                    } else {
                        "does not wear"
                    }
                );
                assert!(off.abs() < 0.25 * tolerance, "{off}: {stopped} {passed}");
            }
        }
    }
}

/// Computed cycles of a groove through one layer, twice as long as the layer lasts, and its deepest point.
fn through_one_layer(base: Option<f64>) -> (u64, f64) {
    let mut scene = plated(0.1, &Side::BOTH[1..], 1_000_000, 0.02);
    scene.receptacle.plating = vec![layer(2e-3, 1e-7)];
    scene.receptacle.wear = base.map(|k_over_h_per_mpa| WearLaw::Archard { k_over_h_per_mpa });
    let cycles = 2e-3 / (1e-7 * scene.load_n_per_mm);
    scene.cycles = (1_u32..1_000_000)
        .find(|n| f64::from(*n) >= cycles)
        .map_or(0, u64::from);
    let summary = summary(&scene);
    let deepest = summary.last.receptacle.max_depth_mm;
    (summary.resolution.computed_cycles, deepest)
}

/// Long after the plating is through nothing wears but the ends of the groove.
#[test]
fn a_base_that_does_not_wear_needs_few_computed_cycles_for_long() {
    let mut scene = plated(0.1, &Side::BOTH[1..], 1_000_000, 0.1);
    scene.receptacle.wear = None;
    let computed = summary(&scene).resolution.computed_cycles;
    println!("a million cycles: {computed} computed ones");
    assert!(computed < 400, "{computed}");
}

#[test]
fn a_base_of_any_rate_needs_few_computed_cycles() {
    let (same, _) = through_one_layer(Some(1e-7));
    for base in [None, Some(5e-9), Some(2e-6)] {
        let (computed, deepest) = through_one_layer(base);
        println!("base of {base:?}: {computed} computed cycles for {same}, {deepest:.2e} mm deep");
        assert!(computed < 4 * same, "{computed} {same}");
        if base.is_none() {
            assert!((deepest / 2e-3 - 1.0).abs() < 1e-9, "{deepest}");
        }
    }
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 17 s"]
    fn a_life_is_the_same_whether_the_run_stops_or_goes_on() {
        super::a_life_is_the_same_whether_the_run_stops_or_goes_on();
    }
}
