//! Runs of periodic motions: increments, checkpoints, stated errors, forecasts, missions.

use super::{both_wear, inner_loop, periodic};
use crate::verification::recorder::{check_stated_error, depth_at, largest_distance, solve};
use crate::verification::scenes::sprung_contact;
use crate::verification::verify_mission::{RATE, block, last_profiles, with_mission};
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::forecast::forecast;
use solver::model::Layout;
use solver::scene::{Accuracy, Block, Scene, Timing};

/// Half and twice the increments change depth and energy within the tolerance.
#[test]
fn halved_increments_change_little() {
    let run = |increments| {
        let mut scene = both_wear(inner_loop(20));
        scene.accuracy.refinement.increments = increments;
        solve(&scene).expect("the scene can be solved")
    };
    let ((one, profile), (fine, fine_profile)) = (run(1.0), run(2.0));
    let apart = largest_distance(profile.last_profile(), fine_profile.last_profile());
    let energy = one.last.dissipated_energy_mj_per_mm / fine.last.dissipated_energy_mj_per_mm - 1.0;
    println!(
        "periodic: with half the increments the profile is {:.2} % off, the energy {:.3} %",
        100.0 * apart,
        100.0 * energy
    );
    assert!(apart < 0.02 && energy.abs() < 0.005, "{apart} {energy}");
}

#[test]
fn a_periodic_run_resumes_to_the_same_bits() {
    let mut scene = both_wear(inner_loop(30));
    scene.output.snapshots_at_cycles = vec![15, 30];
    resumes_to_the_same_bits("periodic", &scene, 2);
}

/// The companions of a periodic run estimate its error.
#[test]
fn a_periodic_run_states_its_error() {
    let of = |accuracy| {
        let scene = Scene {
            accuracy,
            ..inner_loop(30)
        };
        solve(&scene).expect("the scene can be solved").0
    };
    let done = of(Accuracy {
        estimate_errors: true,
        ..Accuracy::from_tolerance(0.02)
    });
    let fine = of(Accuracy::from_tolerance(0.004));
    check_stated_error("periodic", &done, &fine);
}

/// The cost model follows the strokes of a periodic motion.
#[test]
fn the_work_of_a_periodic_motion_is_foreseen() {
    for (name, scene) in [("pad", inner_loop(60)), ("both", both_wear(inner_loop(30)))] {
        let layout = Layout::of(&scene).expect("it can be meshed");
        let expected = forecast(&scene, &layout).increments();
        let (done, _) = solve(&scene).expect("the scene can be solved");
        let increments = done.resolution.work.increments;
        let increments = f64::from(u32::try_from(increments).expect("few increments"));
        println!("periodic, {name}: {expected:.0} increments foreseen, {increments} taken");
        let ratio = expected / increments;
        assert!((0.5..2.0).contains(&ratio), "{ratio}");
    }
}

/// A periodic block of a mission: its passes add up with those of the other.
#[test]
fn a_periodic_motion_is_a_block_of_a_mission() {
    let turning = Block {
        motion: periodic(&[0.2, -0.1, 0.1, -0.2]),
        timing: Timing::Triangle,
        cycles: 3,
    };
    let scene = with_mission(sprung_contact(), &[turning, block(0.1, 5)], 3);
    let profile = last_profiles(&scene).receptacle;
    let pass = RATE * scene.load_n_per_mm;
    for (x, passes) in [(0.0, 66.0), (0.05, 66.0), (-0.15, 18.0), (0.15, 18.0)] {
        let depth = depth_at(&profile, x);
        println!(
            "mission with a periodic block: {:.4} of {passes} passes at {x} mm",
            depth / pass
        );
        assert!((depth / (passes * pass) - 1.0).abs() < 0.02, "{x}: {depth}");
    }
}
