//! Missions of contacts other than a section: a point, a line and extruded bodies.
//!
//! A copper wire of 25.4 um radius on a block, at 10 %: as a ball under 10 mN with a = 1.4 um, and as a section under 0.1 N/mm with a = 0.25 um.

mod scenes;

use super::*;
use crate::error_control;
use crate::forecast::{line_forecast, point_forecast};
use crate::law::surface::SurfaceWear;
use crate::model::Layout;
use crate::number::real_cycles;
use crate::record::BlockWear;
use crate::scene::{Motion, Order, Power, Refinement};
use crate::sides::Side;
use scenes::{alone, ball, in_order, mixed, pressed_bodies, ring, straight_line};

/// Solves a scene; returns its checkpoints besides.
fn solved(scene: &Scene) -> (Summary, Vec<Checkpoint>) {
    let mut recorder = Recorder::default();
    let done = solve(scene, &mut recorder).expect("the scene can be solved");
    (done, recorder.checkpoints)
}

/// Change from one value to another, relative.
fn off(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// Largest change of depths and volumes of both sides, relative.
fn apart(found: &Summary, expected: &Summary) -> f64 {
    let sides = Side::BOTH
        .into_iter()
        .filter(|side| expected.last.side(*side).max_depth_mm > 0.0);
    let changes = sides.map(|side| {
        let (found, expected) = (found.last.side(side), expected.last.side(side));
        off(found.max_depth_mm, expected.max_depth_mm)
            .max(off(found.worn_area_mm2, expected.worn_area_mm2))
    });
    changes.fold(0.0, f64::max)
}

/// In jumps of five cycles, which every block has a multiple of.
fn in_fives(mut scene: Scene) -> Scene {
    scene.accuracy.cycle_jump = Some(5);
    scene
}

/// The same, no rounds of which are done together.
fn one_by_one(mut scene: Scene) -> Scene {
    scene.accuracy.tuning.repetitions_of_done = Power {
        value: 0.0,
        exponent: 0.0,
    };
    scene
}

/// Blocks of one amplitude are one motion with the cycles of all, in however many repetitions: within half of the tolerance in jumps that
/// blocks shorten, within `limit` in equal jumps.
fn blocks_of_one_motion_are_one_motion(scene: &Scene, amplitude: f64, limit: f64) {
    let motion = alone(scene, amplitude, 60);
    let single = in_order(scene, &[(amplitude, 15)], 4);
    let (fives, _) = solved(&in_fives(motion.clone()));
    let (repeated, _) = solved(&in_fives(single));
    assert!(
        apart(&repeated, &fives) <= limit,
        "{}",
        apart(&repeated, &fives)
    );
    let (whole, _) = solved(&motion);
    let (blocks, _) = solved(&in_order(scene, &[(amplitude, 10), (amplitude, 5)], 4));
    assert!(apart(&blocks, &whole) < 0.5 * scene.accuracy.tolerance);
    assert_eq!(blocks.blocks.len(), 2);
    for side in Side::BOTH {
        if whole.last.side(side).max_depth_mm > 0.0 {
            let share =
                *blocks.blocks[0].worn_area_mm2.of(side) / blocks.last.side(side).worn_area_mm2;
            assert!((share - 2.0 / 3.0).abs() < 0.02, "{share}");
        }
    }
}

/// Path of a mission and of its blocks, mm.
fn paths(scene: &Scene) -> (f64, Vec<f64>) {
    let blocks = scene.blocks();
    let paths = blocks.iter().map(|block| {
        let cycles = real_cycles(block.cycles);
        cycles * block.motion.distance_per_cycle_mm()
    });
    let paths: Vec<f64> = paths.collect();
    (paths.iter().sum(), paths)
}

/// Shares of the blocks add up to 1, and their areas, cycles and paths to those of the run.
fn blocks_add_up(scene: &Scene, done: &Summary) {
    let (total, paths) = paths(scene);
    assert!(off(done.last.sliding_distance_mm, total) < 1e-12);
    for (block, path) in done.blocks.iter().zip(&paths) {
        assert!(off(block.sliding_distance_mm, *path) < 1e-12, "{block:?}");
    }
    let cycles: u64 = done.blocks.iter().map(|block| block.cycles).sum();
    assert_eq!(cycles, scene.cycles);
    let sum = |of: &dyn Fn(&BlockWear) -> f64| done.blocks.iter().map(of).sum::<f64>();
    let energy = sum(&|block| block.energy_mj_per_mm);
    assert!(off(energy, done.last.dissipated_energy_mj_per_mm) < 1e-12);
    for side in Side::BOTH {
        let report = done.last.side(side);
        if report.max_depth_mm > 0.0 {
            assert!(
                off(
                    sum(&|block| *block.worn_area_mm2.of(side)),
                    report.worn_area_mm2
                ) < 1e-12
            );
            assert!((sum(&|block| *block.share_of_deepest.of(side)) - 1.0).abs() < 1e-12);
        }
    }
}

/// A motion and one of a larger amplitude after it: the volume is that of the whole path, and the depth that of rounds of single cycles.
fn a_larger_motion_may_come_second(scene: &Scene, small: f64, large: f64) {
    for mission in [
        in_order(scene, &[(small, 10), (large, 2)], 8),
        mixed(scene, &[(small, 40), (large, 8)], 2),
    ] {
        let (done, _) = solved(&mission);
        blocks_add_up(&mission, &done);
        assert!(done.checks.worn_area < 1e-10, "{:?}", done.checks);
        let (path, _) = paths(&mission);
        for side in Side::BOTH {
            let report = done.last.side(side);
            let Some(ideal) = report.ideal_volume_mm3 else {
                continue;
            };
            let volume = report.worn_volume_mm3.expect("it is known");
            // Of a point exact; along a line but for the slopes of the scar.
            let exact = if scene.dimension.point().is_some() {
                1e-12
            } else {
                1e-4
            };
            assert!(off(volume, ideal) < exact, "{volume} {ideal}");
            let rate = mission
                .surface_wear()
                .of(side)
                .and_then(SurfaceWear::uniform);
            let force = scenes::force_n(&mission);
            assert!(off(ideal, rate.expect("it wears") * force * path) < 1e-12);
        }
        let mut fine = one_by_one(mission.clone());
        fine.accuracy.refinement = Refinement {
            cycles: 3.0,
            ..Refinement::NONE
        };
        let (fine, _) = solved(&fine);
        assert!(
            apart(&done, &fine) < scene.accuracy.tolerance,
            "{}",
            apart(&done, &fine)
        );
    }
}

/// Resumed after each quarter of its checkpoints, a mission reaches the same bits.
fn resumed_missions_reach_the_same_bits(mission: &Scene) {
    let (done, checkpoints) = solved(mission);
    for quarter in 1..4 {
        let from = checkpoints[quarter * checkpoints.len() / 4].clone();
        let resumed = resume(mission, from, &mut Recorder::default()).expect("it resumes");
        assert_eq!(format!("{resumed:?}"), format!("{done:?}"));
    }
}

#[test]
fn a_ball_wears_by_blocks_of_one_motion_as_by_one() {
    blocks_of_one_motion_are_one_motion(&ball(0.1), 2e-3, 0.0);
}

/// Each block has its own schedule in the forecast, as in the run.
#[test]
fn missions_are_forecast_block_by_block() {
    let blocks = [(1e-3, 30), (7e-3, 6)];
    for scene in [ball(0.1), straight_line(), pressed_bodies()] {
        let mission = in_order(&scene, &blocks, 10);
        let (computed, increments, end) = forecast_of(&mission);
        assert_eq!(end, mission.cycles);
        let (done, _) = solved(&mission);
        let ratio = computed / real_cycles(done.resolution.computed_cycles);
        assert!(
            (0.6..1.7).contains(&ratio),
            "{:?}: {ratio}",
            scene.dimension
        );
        let small = forecast_of(&alone(&scene, 1e-3, mission.cycles)).1;
        assert!(increments > small, "{:?}: {increments}", scene.dimension);
    }
}

/// Computed cycles, increments and last cycle of the forecast of a scene.
fn forecast_of(scene: &Scene) -> (f64, f64, u64) {
    if let Some(found) = point_forecast(scene) {
        return (found.computed_cycles, found.increments, found.course.end());
    }
    let layout = Layout::of(scene).expect("it can be meshed");
    let found = line_forecast(scene, &layout).expect("it is along a line");
    (
        found.computed_cycles,
        found.increments(),
        found.course.end(),
    )
}

#[test]
fn a_block_without_motion_wears_nothing() {
    for scene in [ball(0.1), straight_line(), pressed_bodies()] {
        let mission = in_order(&scene, &[(2e-3, 5), (0.0, 4)], 4);
        let (done, _) = solved(&mission);
        let (alone, _) = solved(&alone(&scene, 2e-3, 20));
        assert!(apart(&done, &alone) < 0.5 * scene.accuracy.tolerance);
        assert_eq!(done.blocks[1].cycles, 16);
        for area in Side::BOTH.map(|side| *done.blocks[1].worn_area_mm2.of(side)) {
            assert!(area.abs() < 1e-18, "{area}");
        }
    }
}

/// Amplitudes are whole numbers of cells of the grid that all motions of a mission have: another block, without cycles, changes it alone.
#[test]
fn a_ball_wears_alike_on_the_grid_of_another_motion() {
    let ball = ball(0.1);
    for (amplitude, other) in [(2.3e-3, 7.1e-3), (6.7e-4, 2.9e-3), (2.3e-3, 2.6e-3)] {
        let (own, _) = solved(&alone(&ball, amplitude, 60));
        let (found, _) = solved(&in_order(&ball, &[(amplitude, 60), (other, 0)], 1));
        let apart = apart(&found, &own);
        assert!(apart < 0.01, "{amplitude}, {other}: {apart}");
    }
}

#[test]
fn missions_state_their_errors() {
    for mut scene in [ball(0.1), straight_line()] {
        scene.accuracy.estimate_errors = true;
        let mission = in_order(&scene, &[(1e-3, 10), (4e-3, 3)], 4);
        let done = error_control::solve(&mission, &mut Recorder::default());
        let done = done.expect("it can be solved");
        let errors = done.errors.expect("they are estimated");
        let relative = errors.worn_depth.relative;
        assert!(relative > 0.0 && relative < 0.2, "{errors:?}");
    }
}

#[test]
fn a_ball_wears_by_a_larger_motion_after_a_smaller_one() {
    a_larger_motion_may_come_second(&ball(0.1), 1e-3, 7e-3);
    // One that the cells do not resolve, and of which no part sticks.
    let mut slipping = ball(0.1);
    slipping.effects = Switches::default().with(Effect::StickMemory, false);
    a_larger_motion_may_come_second(&slipping, 4e-5, 3e-3);
}

/// The loop of friction of a motion of which a part sticks is its own, after any other motion.
#[test]
fn a_sticking_ball_dissipates_its_own_loop_after_another_motion() {
    let mut scene = ball(1.21);
    for wear in [&mut scene.slider.wear, &mut scene.receptacle.wear] {
        *wear = Some(WearLaw::Archard {
            k_over_h_per_mpa: 1e-14,
        });
    }
    let of_cycle = |summary: &Summary| {
        let cycles = real_cycles(summary.last.cycle);
        summary.last.dissipated_energy_mj_per_mm / cycles
    };
    let (small, large) = (6e-5, 1e-4);
    let expected = of_cycle(&solved(&alone(&scene, small, 6)).0);
    // The cells of a mission with a long motion have another length, and the slip annulus is about one of them wide.
    for (other, limit) in [(large, 1e-3), (3e-3, 0.05)] {
        let mission = in_order(&scene, &[(small, 2), (other, 2)], 3);
        assert!(effects::plan(&mission).simulates(Effect::StickMemory));
        let (done, _) = solved(&mission);
        let found = done.blocks[0].energy_mj_per_mm / 6.0;
        assert!(off(found, expected) < limit, "{other}: {found} {expected}");
        let rigid = 4.0 * 1.21 * scene.load_n_per_mm * small;
        assert!(found < 0.5 * rigid, "{found} {rigid}");
    }
}

#[test]
fn a_mission_of_a_ball_is_resumed() {
    let mut scene = ball(0.1);
    scene.spring_n_per_mm2 = 30.0;
    resumed_missions_reach_the_same_bits(&in_order(&scene, &[(1e-3, 10), (7e-3, 3)], 6));
    let sticking = mixed(&ball(1.21), &[(1e-4, 30), (3e-3, 6)], 2);
    assert!(effects::plan(&sticking).simulates(Effect::StickMemory));
    resumed_missions_reach_the_same_bits(&sticking);
}

#[test]
fn a_line_wears_by_blocks_of_one_motion_as_by_one() {
    blocks_of_one_motion_are_one_motion(&straight_line(), 2e-3, 1e-9);
}

#[test]
fn a_line_wears_by_a_larger_motion_after_a_smaller_one() {
    a_larger_motion_may_come_second(&straight_line(), 1e-3, 7e-3);
}

#[test]
fn a_mission_of_a_ring_is_resumed() {
    resumed_missions_reach_the_same_bits(&in_order(&ring(), &[(1e-3, 10), (4e-3, 3)], 5));
}

#[test]
fn extruded_bodies_wear_by_blocks_of_one_motion_as_by_one() {
    blocks_of_one_motion_are_one_motion(&pressed_bodies(), 2e-3, 1e-9);
}

#[test]
fn extruded_bodies_wear_by_a_larger_motion_after_a_smaller_one() {
    a_larger_motion_may_come_second(&pressed_bodies(), 1e-3, 7e-3);
}

#[test]
fn a_mission_of_extruded_bodies_is_resumed() {
    resumed_missions_reach_the_same_bits(&in_order(&pressed_bodies(), &[(1e-3, 10), (4e-3, 3)], 5));
}
