//! Missions whose cycles are spread evenly over the repetitions.

use solver::forecast::forecast;
use solver::model::Layout;
use solver::scene::{Criterion, Order, Scene};
use solver::sides::Side;

use crate::verification::recorder::{depth_at, largest_distance, solve};
use crate::verification::scenes::sprung_contact;
use crate::verification::verify_mission::{
    RATE, block, last_profiles, one_by_one, vibrated_and_wiped, with_mission,
};
use crate::verification::verify_resume::resumes_to_the_same_bits;

fn mixed(mut scene: Scene) -> Scene {
    if let Some(mission) = &mut scene.mission {
        mission.order = Order::Mixed;
    }
    scene
}

/// Counts without a common divisor, and a block that is passed over in most rounds.
#[test]
fn all_cycles_of_mixed_blocks_are_done() {
    for (cycles, repeat) in [(&[7, 1_000][..], 1), (&[7, 1_000], 3), (&[1, 40, 330], 1)] {
        let amplitudes = [0.15, 0.02, 0.03];
        let blocks = amplitudes.iter().zip(cycles);
        let blocks: Vec<_> = blocks.map(|(amplitude, n)| block(*amplitude, *n)).collect();
        let scene = mixed(with_mission(sprung_contact(), &blocks, repeat));
        let (done, _) = solve(&scene).expect("the mission can be solved");
        let found: Vec<u64> = done.blocks.iter().map(|block| block.cycles).collect();
        let expected: Vec<u64> = cycles.iter().map(|cycles| cycles * repeat).collect();
        assert_eq!(found, expected);
        assert_eq!(done.last.cycle, scene.cycles);
        assert!(done.checks.worn_area < 1e-12, "{:?}", done.checks);
        let path: f64 = amplitudes
            .iter()
            .zip(&expected)
            .map(|(amplitude, cycles)| {
                4.0 * amplitude * f64::from(u32::try_from(*cycles).expect("few cycles"))
            })
            .sum();
        assert!((done.last.sliding_distance_mm / path - 1.0).abs() < 1e-12);
    }
}

/// After many repetitions the order within one is of no account.
fn mixed_blocks_wear_like_repetitions(repeat: u64, cases: &[(&str, Option<f64>)]) {
    for &(name, slider) in cases {
        let in_order = vibrated_and_wiped(repeat, slider);
        let reference = last_profiles(&one_by_one(in_order.clone()));
        let profiles = last_profiles(&mixed(in_order));
        let pad = largest_distance(&profiles.receptacle, &reference.receptacle);
        let tip = slider.map_or(0.0, |_| {
            largest_distance(&profiles.slider, &reference.slider)
        });
        println!(
            "mixed mission, {name} worn: {:.2} % off the repetitions in order on the pad, {:.2} % on the tip",
            100.0 * pad,
            100.0 * tip
        );
        assert!(pad.max(tip) < 0.02, "{name}: {pad} {tip}");
    }
}

#[test]
fn mixed_blocks_wear_like_many_repetitions() {
    mixed_blocks_wear_like_repetitions(30, &[("pad and tip", Some(0.1 * RATE))]);
}

mod long {
    #[test]
    #[ignore = "long: takes 20 s"]
    fn mixed_blocks_wear_like_more_repetitions() {
        let cases = [("pad", None), ("pad and tip", Some(0.1 * super::RATE))];
        super::mixed_blocks_wear_like_repetitions(60, &cases);
    }
}

/// Every pass over a place of a flat floor wears it by k P, in whatever order.
#[test]
fn each_pass_of_mixed_blocks_wears_by_k_p() {
    let blocks = [block(0.2, 3), block(0.1, 5)];
    let scene = mixed(with_mission(sprung_contact(), &blocks, 4));
    let profile = last_profiles(&scene).receptacle;
    let pass = RATE * scene.load_n_per_mm;
    for (x, passes) in [(0.0, 64.0), (0.05, 64.0), (-0.15, 24.0), (0.15, 24.0)] {
        let depth = depth_at(&profile, x);
        println!(
            "mixed mission: {:.4} of {passes} passes at {x} mm",
            depth / pass
        );
        // As in order (`verify_mission`).
        assert!((depth / (passes * pass) - 1.0).abs() < 0.02, "{x}: {depth}");
    }
}

/// A run that stops within a round ends at the same cycle as one of single rounds.
#[test]
fn a_mixed_mission_stops_at_a_depth() {
    let mut scene = mixed(vibrated_and_wiped(120, None));
    scene.stop = vec![Criterion::deepest(Side::Receptacle, 2e-3)];
    let end = |scene: &Scene| {
        let (done, _) = solve(scene).expect("the mission can be solved");
        let depth = done.last.receptacle.max_depth_mm;
        assert!((2e-3..2.02e-3).contains(&depth), "{depth}");
        done.last.cycle
    };
    let (together, single) = (end(&scene), end(&one_by_one(scene.clone())));
    println!("mixed mission: 2 um after {together} cycles, {single} with single rounds");
    // As in order: half a per cent of depth is a per cent of cycles here.
    assert!(together.abs_diff(single) <= 64, "{together} {single}");
}

#[test]
fn a_mixed_mission_resumes_to_the_same_bits() {
    let scene = mixed(vibrated_and_wiped(12, Some(1e-7)));
    let (summary, _) = resumes_to_the_same_bits("mixed mission", &scene, 3);
    assert_eq!(summary.blocks.len(), 2);
}

/// The cost model follows the rounds of a mixed mission.
#[test]
fn the_work_of_a_mixed_mission_is_foreseen() {
    let scene = mixed(vibrated_and_wiped(20, Some(0.1 * RATE)));
    let layout = Layout::of(&scene).expect("it can be meshed");
    let expected = forecast(&scene, &layout).increments();
    let (done, _) = solve(&scene).expect("the mission can be solved");
    let increments = done.resolution.work.increments;
    let increments = f64::from(u32::try_from(increments).expect("few increments"));
    println!("mixed mission: {expected:.0} increments foreseen, {increments} taken");
    let ratio = expected / increments;
    assert!((0.5..2.0).contains(&ratio), "{ratio}");
}
