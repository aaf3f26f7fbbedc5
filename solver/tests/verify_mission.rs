//! Missions: blocks of different motions, one after the other, repeated, in one run.

use solver::forecast::forecast;
use solver::model::Layout;
use solver::record::DepthProfile;
use solver::scene::{
    Accuracy, Block, Criterion, Mission, Motion, Order, Power, Scene, Timing, WearLaw,
};
use solver::sides::{Side, Sides};

use crate::verification::recorder::{check_stated_error, depth_at, largest_distance, solve};
use crate::verification::scenes::sprung_contact;

/// k/H of `sprung_contact`, 1/MPa.
pub(crate) const RATE: f64 = 0.004 / 1_700.0;

pub(crate) fn block(amplitude_mm: f64, cycles: u64) -> Block {
    Block {
        motion: Motion::Reciprocating {
            amplitude_mm,
            period_s: 1.0,
        },
        timing: Timing::Sine,
        cycles,
    }
}

/// A scene with blocks, and a snapshot at the end.
pub(crate) fn with_mission(scene: Scene, blocks: &[Block], repeat: u64) -> Scene {
    let mission = Mission {
        blocks: blocks.to_vec(),
        repeat,
        order: Order::InOrder,
    };
    let cycles = mission.cycles() * repeat;
    let mut scene = Scene {
        motion: mission.mean_motion(),
        cycles,
        mission: Some(mission),
        ..scene
    };
    scene.output.snapshots_at_cycles = vec![cycles];
    scene
}

/// A sprung contact that vibrates by 0.02 mm and is wiped by 0.15 mm, on both sides where the slider wears too.
pub(crate) fn vibrated_and_wiped(repeat: u64, slider: Option<f64>) -> Scene {
    let blocks = [block(0.02, 30), block(0.15, 2)];
    let mut scene = with_mission(sprung_contact(), &blocks, repeat);
    let law = |k_over_h_per_mpa| WearLaw::Archard { k_over_h_per_mpa };
    scene.slider.wear = slider.map(law);
    scene
}

/// The same, no repetitions of which are done together.
pub(crate) fn one_by_one(mut scene: Scene) -> Scene {
    scene.accuracy.tuning.repetitions_of_done = Power {
        value: 0.0,
        exponent: 0.0,
    };
    scene
}

pub(crate) fn last_profiles(scene: &Scene) -> Sides<DepthProfile> {
    let (_, record) = solve(scene).expect("the mission can be solved");
    let last = record.snapshots.last().expect("a snapshot at the end");
    Sides {
        slider: last.slider.clone(),
        receptacle: last.receptacle.clone(),
    }
}

/// Taken together, repetitions wear another profile by an error of first order in their number, within the tolerance of 2 %.
fn repetitions_together_wear_like_single_ones() {
    for (name, slider) in [("pad", None), ("pad and tip", Some(0.1 * RATE))] {
        let scene = vibrated_and_wiped(60, slider);
        let together = last_profiles(&scene);
        let single = last_profiles(&one_by_one(scene));
        let pad = largest_distance(&together.receptacle, &single.receptacle);
        let tip = slider.map_or(0.0, |_| largest_distance(&together.slider, &single.slider));
        println!(
            "mission, {name} worn: repetitions together are {:.2} % off on the pad, {:.2} % on the tip",
            100.0 * pad,
            100.0 * tip
        );
        assert!(pad.max(tip) < 0.02, "{name}: {pad} {tip}");
    }
}

/// Every pass over a place of a flat floor wears it by k P, whichever block it belongs to.
#[test]
fn each_pass_of_each_block_wears_by_k_p() {
    let blocks = [block(0.2, 3), block(0.1, 5)];
    let scene = with_mission(sprung_contact(), &blocks, 4);
    let profile = last_profiles(&scene).receptacle;
    let pass = RATE * scene.load_n_per_mm;
    for (x, passes) in [(0.0, 64.0), (0.05, 64.0), (-0.15, 24.0), (0.15, 24.0)] {
        let depth = depth_at(&profile, x);
        println!("mission: {:.4} of {passes} passes at {x} mm", depth / pass);
        // As a single moving contact at 2 % (`verify_moving_line_contact`).
        assert!((depth / (passes * pass) - 1.0).abs() < 0.02, "{x}: {depth}");
    }
}

#[test]
fn blocks_of_one_motion_wear_like_one_run() {
    let blocks = [block(0.02, 30), block(0.02, 70)];
    let mission = with_mission(sprung_contact(), &blocks, 5);
    let mut run = Scene {
        mission: None,
        ..mission.clone()
    };
    run.output.snapshots_at_cycles = vec![500];
    let apart = largest_distance(
        &last_profiles(&mission).receptacle,
        &last_profiles(&run).receptacle,
    );
    println!(
        "mission: blocks of one motion are {:.2} % off one run",
        100.0 * apart
    );
    // The tolerance.
    assert!(apart < 0.02, "{apart}");
}

/// Areas and doses of the blocks add up to those of the run; in gross sliding a block's share of the area is that of its path.
#[test]
fn shares_of_the_blocks_add_up() {
    let scene = vibrated_and_wiped(20, Some(0.1 * RATE));
    let (done, _) = solve(&scene).expect("the mission can be solved");
    assert!(done.checks.worn_area < 1e-12, "{:?}", done.checks);
    let cycles: Vec<u64> = done.blocks.iter().map(|block| block.cycles).collect();
    assert_eq!(cycles, [600, 40]);
    for side in Side::BOTH {
        let areas = done
            .blocks
            .iter()
            .map(|block| *block.worn_area_mm2.of(side));
        let total = done.last.side(side).worn_area_mm2;
        assert!((areas.clone().sum::<f64>() / total - 1.0).abs() < 1e-12);
        let shares = done
            .blocks
            .iter()
            .map(|block| *block.share_of_deepest.of(side));
        assert!((shares.sum::<f64>() - 1.0).abs() < 1e-12);
        // Paths of 48 and 24 mm; the bodies deform by a thousandth of a mm before they slip.
        let share = areas.clone().next().unwrap_or_default() / total;
        assert!((share - 2.0 / 3.0).abs() < 0.01, "{share}");
    }
}

/// A run that stops at a depth ends at the same cycle, whether repetitions are taken together or not.
#[test]
fn a_mission_stops_at_a_depth() {
    let mut scene = vibrated_and_wiped(120, None);
    scene.stop = vec![Criterion::deepest(Side::Receptacle, 2e-3)];
    scene.life = scene.stop.clone();
    let end = |scene: &Scene| {
        let (done, _) = solve(scene).expect("the mission can be solved");
        let depth = done.last.receptacle.max_depth_mm;
        assert!((2e-3..2.02e-3).contains(&depth), "{depth}");
        let life = done.life.criteria[0].cycles.unwrap_or_default();
        (done.last.cycle, life)
    };
    let ((together, life), (single, _)) = (end(&scene), end(&one_by_one(scene)));
    println!("mission: 2 um after {together} cycles, {single} with single repetitions");
    // Half a per cent of depth is a per cent of cycles here; a repetition has 32 cycles.
    assert!(together.abs_diff(single) <= 64, "{together} {single}");
    let cycles = f64::from(u32::try_from(together).expect("few cycles"));
    assert!(
        (life - 1.0..=life + 64.0).contains(&cycles),
        "{life} {together}"
    );
}

/// A block in which nothing moves counts, and wears nothing.
#[test]
fn a_block_without_slip_does_not_wear() {
    let resting = with_mission(sprung_contact(), &[block(0.02, 20), block(0.0, 1_000)], 3);
    let (done, _) = solve(&resting).expect("the mission can be solved");
    assert_eq!(done.last.cycle, 3_060);
    assert!(
        done.blocks[1].worn_area_mm2.receptacle <= 0.0,
        "{:?}",
        done.blocks
    );
    let mut moving = Scene {
        motion: Motion::Reciprocating {
            amplitude_mm: 0.02,
            period_s: 1.0,
        },
        cycles: 60,
        mission: None,
        ..resting.clone()
    };
    moving.output.snapshots_at_cycles = vec![60];
    let apart = largest_distance(
        &last_profiles(&resting).receptacle,
        &last_profiles(&moving).receptacle,
    );
    assert!(apart < 0.02, "{apart}");
}

/// Partial slip in one block, gross sliding in the other.
#[test]
fn a_contact_sticks_in_one_block_and_slides_in_the_other() {
    let scene = with_mission(
        crate::verification::scenes::partial_slip(),
        &[block(0.003, 200), block(0.03, 10)],
        5,
    );
    let (done, _) = solve(&scene).expect("the mission can be solved");
    assert!(
        done.checks.worn_area < 1e-12 && done.checks.friction_cone < 1e-9,
        "{:?}",
        done.checks
    );
    let shares: Vec<f64> = done
        .blocks
        .iter()
        .map(|block| block.worn_area_mm2.receptacle)
        .collect();
    println!("mission: {shares:?} mm^2 worn in partial slip and in gross sliding");
    assert!(shares[0] > 0.0 && shares[1] > shares[0]);
}

/// The companions of a mission estimate its error.
fn a_mission_states_its_error() {
    let mut scene = vibrated_and_wiped(40, None);
    scene.accuracy = Accuracy {
        estimate_errors: true,
        ..Accuracy::from_tolerance(0.02)
    };
    let (done, _) = solve(&scene).expect("the mission can be solved");
    let mut fine = vibrated_and_wiped(40, None);
    fine.accuracy = Accuracy::from_tolerance(0.002);
    let (fine, _) = solve(&fine).expect("the mission can be solved");
    check_stated_error("mission", &done, &fine);
}

/// The cost model follows the blocks of a mission.
#[test]
fn the_work_of_a_mission_is_foreseen() {
    for (name, slider) in [("pad", None), ("pad and tip", Some(0.1 * RATE))] {
        let scene = vibrated_and_wiped(30, slider);
        let layout = Layout::of(&scene).expect("it can be meshed");
        let expected = forecast(&scene, &layout);
        let (done, _) = solve(&scene).expect("the mission can be solved");
        let increments = done.resolution.work.increments;
        let increments = f64::from(u32::try_from(increments).expect("few increments"));
        println!(
            "mission, {name}: {:.0} cycles and {:.0} increments foreseen, {} and {increments} taken",
            expected.computed_cycles,
            expected.increments(),
            done.resolution.computed_cycles
        );
        let ratio = expected.increments() / increments;
        assert!((0.5..2.0).contains(&ratio), "{ratio}");
    }
}

/// Forms that take long.
mod long {
    #[test]
    #[ignore = "long: takes 24 s"]
    fn a_mission_states_its_error() {
        super::a_mission_states_its_error();
    }

    #[test]
    #[ignore = "long: takes 20 s"]
    fn repetitions_together_wear_like_single_ones() {
        super::repetitions_together_wear_like_single_ones();
    }
}
