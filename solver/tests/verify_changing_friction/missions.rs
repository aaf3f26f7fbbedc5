//! A coefficient of friction that changes through the blocks of missions of lines, extruded bodies and points.

use solver::scene::{Block, Ends, Top};

use super::along_lines::{as_extruded, as_line, card};
use super::points::plated;
use super::{HIGH, LOW, by_cycle, by_layer, energy, with};
use crate::verification::verify_line_runs::CROWN;
use crate::verification::verify_mission::{block, with_mission};
use crate::verification::verify_resume::resumes_to_the_same_bits;

/// Blocks of one motion are one run; blocks of other motions, of which a part sticks in one, resume to the same bits.
#[test]
fn changing_friction_of_a_ball_goes_through_the_blocks_of_a_mission() {
    let scene = plated(0.02, 300, 0.1);
    let layers = [LOW, HIGH];
    for law in [
        by_cycle(&[(30.0, LOW), (270.0, HIGH)]),
        by_layer(&layers, &layers),
    ] {
        let mission = |blocks: &[Block]| with(&with_mission(scene.clone(), blocks, 3), law.clone());
        let alike = mission(&[block(0.02, 30), block(0.02, 70)]);
        let one = energy(&with(&scene, law.clone()));
        let off = energy(&alike) / one - 1.0;
        println!("mission of a ball: energy of blocks {off:.1e} off that of one run");
        assert!(off.abs() < 0.05, "{off}");
        let unlike = mission(&[block(2e-4, 70), block(0.02, 30)]);
        resumes_to_the_same_bits("mission of a ball", &unlike, 3);
    }
}

/// Blocks of one motion are one run; blocks of other motions resume to the same bits.
#[test]
fn changing_friction_along_a_line_goes_through_the_blocks_of_a_mission() {
    let card = card(120);
    let layers = [LOW, HIGH];
    for (name, scene, law) in [
        (
            "line",
            as_line(&card, Some(CROWN), Top::Rigid),
            by_cycle(&[(15.0, LOW), (100.0, HIGH)]),
        ),
        (
            "extruded",
            as_extruded(&card, Ends::Free),
            by_layer(&layers, &layers),
        ),
    ] {
        let mission = |blocks: &[Block]| with(&with_mission(scene.clone(), blocks, 3), law.clone());
        let alike = mission(&[block(0.005, 15), block(0.005, 25)]);
        let one = energy(&with(&scene, law.clone()));
        let off = energy(&alike) / one - 1.0;
        println!("mission, {name}: energy of blocks {off:.1e} off that of one run");
        assert!(off.abs() < 0.1, "{name}: {off}");
        let unlike = mission(&[block(0.005, 25), block(0.01, 5)]);
        resumes_to_the_same_bits(name, &unlike, 3);
    }
}
