//! Jumps of a point contact that are implicit in the worn shapes.
//!
//! * Lives of a ball, plated on both sides, are those of fine jumps and increments.
//! * They take a fraction of the iterations of computed cycles.
//! * Some hundred of them wear a ball through to its base metal and on, within the stated error of its lives.
//! * The forecast foresees them.
//! * A resumed run gives the same bits.

use crate::verification::recorder::solve;
use crate::verification::scenes::{COPPER_WEAR, sprung_contact};
use crate::verification::verify_plating::layer;
use crate::verification::verify_point_runs::ball;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use crate::verification::verify_section_and_ball::as_ball;
use solver::forecast::point_forecast;
use solver::law::elastic::Elastic;
use solver::record::Summary;
use solver::scene::{Accuracy, Criterion, Refinement, Scene, WearLaw};
use solver::sides::Side;

/// Gold and nickel of the presets, 1/MPa, and their thickness, mm.
const GOLD: f64 = 1e-5 / 1_700.0;
const NICKEL: f64 = 2e-4 / 2_000.0;
const GOLD_MM: f64 = 0.76e-3;
const NICKEL_MM: f64 = 1.27e-3;

/// A ball of 0.4 mm under 0.5 N on a flat, +-20 um, both plated with gold over nickel that is so many times as thick.
fn plated_ball(thickness: f64) -> Scene {
    let mut scene = sprung_contact();
    scene.spring_n_per_mm2 = 0.0;
    scene.slider.elastic = Elastic {
        youngs_modulus_mpa: 131e3,
        poisson_ratio: 0.3,
    };
    scene.receptacle.elastic = Elastic {
        youngs_modulus_mpa: 117e3,
        poisson_ratio: 0.34,
    };
    let archard = |k_over_h_per_mpa| Some(WearLaw::Archard { k_over_h_per_mpa });
    scene.slider.wear = archard(0.004 / 3_700.0);
    scene.receptacle.wear = archard(COPPER_WEAR);
    let plating = vec![
        layer(thickness * GOLD_MM, GOLD),
        layer(thickness * NICKEL_MM, NICKEL),
    ];
    (scene.slider.plating, scene.receptacle.plating) = (plating.clone(), plating);
    scene.accuracy = Accuracy::from_tolerance(0.02);
    as_ball(&mut scene, 0.5, 0.4);
    scene.life = vec![deepest(thickness * GOLD_MM)];
    scene
}

/// The slider's largest depth.
fn deepest(depth_mm: f64) -> Criterion {
    Criterion::deepest(Side::Slider, depth_mm)
}

/// The life of the gold and the last cycle of a run.
fn lives(name: &str, scene: &Scene) -> ([f64; 2], Summary) {
    let done = solve(scene).expect("it has a solution").0;
    let gold = done.life.criteria[0].cycles.expect("it is reached");
    let last = u32::try_from(done.last.cycle).map_or(f64::NAN, f64::from);
    println!(
        "{name}: nickel after {gold:.0} cycles, the last is {last}; {} computed, {:?}",
        done.resolution.computed_cycles, done.resolution.work
    );
    ([gold, last], done)
}

fn computed(scene: &Scene) -> Scene {
    let mut computed = scene.clone();
    computed.accuracy.tuning.implicit_jumps = false;
    computed
}

#[test]
fn a_thinly_plated_ball_lives_as_long_as_by_computed_cycles() {
    let mut scene = plated_ball(0.2);
    scene.cycles = 300;
    let ([life, _], done) = lives("implicit", &scene);
    let mut fine = computed(&scene);
    fine.accuracy.refinement = Refinement {
        increments: 2.0,
        cycles: 4.0,
        ..Refinement::NONE
    };
    let ([expected, _], reference) = lives("fine computed cycles", &fine);
    assert!((life / expected - 1.0).abs() < 0.005, "{life} {expected}");
    let depth = done.last.slider.max_depth_mm / reference.last.slider.max_depth_mm - 1.0;
    // Below the gold the depth grows 17 times as fast: 0.5 % of the life is more of the depth.
    assert!(depth.abs() < 0.01, "{depth}");
}

/// Lives of the gold and to the base metal at a tenth of the tolerance, 0.2 %, by 625 jumps; those at 2 % and 10 % by 68 and 36.
const FINE_LIVES: [f64; 2] = [4_519.0, 15_299.0];

/// The ball until it is through to its base metal.
fn until_base_metal(tolerance: f64) -> Scene {
    let mut scene = plated_ball(1.0);
    scene.accuracy = Accuracy::from_tolerance(tolerance);
    scene.cycles = 100_000;
    scene.stop = vec![deepest(GOLD_MM + NICKEL_MM)];
    scene.life.extend(scene.stop.clone());
    scene
}

fn is_foreseen(name: &str, scene: &Scene, done: &Summary) {
    let foreseen = point_forecast(scene).expect("it is a point contact");
    let count = |count: u64| f64::from(u32::try_from(count).expect("it is small"));
    let found = count(done.resolution.work.increments) / foreseen.increments;
    println!("{name}: {found:.2} times the foreseen solves");
    assert!((0.5..2.0).contains(&found), "{name}: {found}");
}

#[test]
fn a_ball_lives_to_its_base_metal_by_a_hundred_jumps() {
    let scene = until_base_metal(0.02);
    let (found, done) = lives("2 %", &scene);
    for (life, expected) in found.into_iter().zip(FINE_LIVES) {
        assert!((life / expected - 1.0).abs() < 0.005, "{life} {expected}");
    }
    assert!(done.resolution.computed_cycles < 100);
    is_foreseen("plated, 2 %", &scene, &done);
}

#[test]
fn stated_errors_of_lives_hold() {
    let mut scene = until_base_metal(0.1);
    scene.accuracy.estimate_errors = true;
    let (_, done) = lives("10 % with companions", &scene);
    for (state, expected) in done.life.criteria.iter().zip(FINE_LIVES) {
        let (life, stated) = (state.cycles, state.error.expect("it is estimated"));
        let off = (life.expect("it is reached") / expected - 1.0).abs();
        println!("{:.2} % off, stated {:.2} %", 100.0 * off, 100.0 * stated);
        assert!(off < stated && stated < 0.05, "{off} {stated}");
    }
    is_foreseen("plated, 10 %", &scene, &done);
}

/// Nickel that wears a tenth as fast stands beside the base, and gold a hundredth.
#[test]
fn jumps_of_open_base_metal_converge() {
    let mut scene = plated_ball(1.0);
    scene.cycles = 30_000;
    let done = solve(&scene).expect("it has a solution").0;
    println!("{} computed cycles", done.resolution.computed_cycles);
    assert!(done.resolution.computed_cycles < 110);
    assert!(done.last.slider.max_depth_mm > 1.5 * (GOLD_MM + NICKEL_MM));
    assert!(done.checks.worn_area < 1e-12, "{:?}", done.checks);
    is_foreseen("through to its base", &scene, &done);
}

#[test]
fn jumps_of_bare_balls_are_foreseen() {
    for (name, receptacle, tolerance) in [
        ("both, 2 %", GOLD, 0.02),
        ("both, 10 %", GOLD, 0.1),
        ("slider alone", 0.0, 0.02),
    ] {
        let mut scene = ball(GOLD, receptacle, 0.02, 20_000);
        scene.accuracy = Accuracy::from_tolerance(tolerance);
        let done = solve(&scene).expect("it has a solution").0;
        is_foreseen(name, &scene, &done);
    }
}

#[test]
fn a_resumed_ball_gives_the_same_bits() {
    let mut scene = plated_ball(0.2);
    scene.cycles = 400;
    resumes_to_the_same_bits("plated ball, implicit", &scene, 6);
}

/// Forms that take long.
mod long {
    use super::*;

    #[test]
    #[ignore = "long: takes a minute"]
    fn a_ball_lives_as_long_as_by_fine_jumps_for_a_fraction_of_the_work() {
        // Twice as thick: the step that computed cycles leave bounds them the more, the longer the life is.
        let mut scene = plated_ball(2.0);
        scene.cycles = 400_000;
        scene.stop = vec![deepest(2.0 * (GOLD_MM + NICKEL_MM))];
        let (found, done) = lives("implicit", &scene);
        let (_, by_cycles) = lives("computed cycles", &computed(&scene));
        let mut fine = scene.clone();
        fine.accuracy.refinement = Refinement {
            increments: 3.0,
            cycles: 4.0,
            ..Refinement::NONE
        };
        let (expected, _) = lives("finer", &fine);
        for (life, expected) in found.into_iter().zip(expected) {
            assert!((life / expected - 1.0).abs() < 0.005, "{life} {expected}");
        }
        let iterations = |done: &Summary| done.resolution.work.unknowns;
        assert!(iterations(&done) < iterations(&by_cycles) / 3);
    }
}
