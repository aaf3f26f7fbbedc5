//! Motions of a point contact: strokes between several turning points, and a surface that slides through a contact at rest.
//!
//! A ball of 0.4 mm under 0.5 N on a flat. Each body loses V = k F s over the path s (Archard), whatever the strokes are.

use solver::record::Summary;
use solver::scene::{Effect, Motion, Scene, TurningPoints};
use solver::sides::Side;

use crate::verification::recorder::{Recorder, depth_at, solve};
use crate::verification::verify_point_runs::ball;
use crate::verification::verify_resume::resumes_to_the_same_bits;

const FORCE: f64 = 0.5;
/// k/H, 1/MPa.
const K: f64 = 2e-8;
/// Largest relative error of a volume, or of the work of a friction loop: round-off of some thousand increments.
const ROUND_OFF: f64 = 1e-9;

/// A scene whose slider turns at these displacements, mm.
fn turning(scene: Scene, x_mm: &[f64]) -> Scene {
    let turns = TurningPoints::new(x_mm).expect("they alternate");
    let motion = Motion::Periodic {
        turns,
        period_s: 0.05,
    };
    Scene { motion, ..scene }
}

fn done(scene: &Scene) -> (Summary, Recorder) {
    solve(scene).expect("it can be solved")
}

fn volume(summary: &Summary, side: Side) -> f64 {
    let volume = summary.last.side(side).worn_volume_mm3;
    volume.expect("a point has a volume")
}

#[test]
fn two_turning_points_are_a_reciprocating_motion() {
    let reciprocating = ball(K, K, 0.02, 200);
    let periodic = turning(reciprocating.clone(), &[0.02, -0.02]);
    let [one, other] = [reciprocating, periodic].map(|scene| done(&scene).0.last);
    assert_eq!(format!("{one:?}"), format!("{other:?}"));
}

#[test]
fn each_body_loses_the_volume_of_all_strokes() {
    let scene = turning(ball(K, 0.5 * K, 0.02, 300), &[0.02, -0.01, 0.005, -0.02]);
    resumes_to_the_same_bits("turning ball", &scene, 2);
    let (summary, recorder) = done(&scene);
    let path = 300.0 * (0.03 + 0.015 + 0.025 + 0.04);
    for (side, rate) in [(Side::Slider, K), (Side::Receptacle, 0.5 * K)] {
        let (found, exact) = (volume(&summary, side), rate * FORCE * path);
        assert!((found / exact - 1.0).abs() < ROUND_OFF, "{found} {exact}");
    }
    let snapshot = recorder.snapshots.last().expect("it has a snapshot");
    let found = &snapshot.friction_loop;
    let displacements = [
        0.0, 0.02, 0.02, -0.01, -0.01, 0.005, 0.005, -0.02, -0.02, 0.0,
    ];
    assert_eq!(found.displacement_mm, displacements);
    let work: f64 = (1..displacements.len())
        .map(|i| {
            let step = displacements[i] - displacements[i - 1];
            0.5 * step * (found.tangential_force_n[i] + found.tangential_force_n[i - 1])
        })
        .sum();
    let exact = scene.friction.unworn() * FORCE * path / 300.0;
    assert!((work / exact - 1.0).abs() < ROUND_OFF, "{work} {exact}");
}

#[test]
fn a_pad_is_twice_as_deep_where_twice_as_many_strokes_pass() {
    let mut scene = turning(ball(0.0, K, 0.2, 20), &[0.2, 0.0, 0.1, -0.2]);
    scene.receptacle.shape.length_mm = 2.0;
    let (summary, recorder) = done(&scene);
    let (found, exact) = (
        volume(&summary, Side::Receptacle),
        K * FORCE * 20.0 * (0.2 + 0.1 + 0.3 + 0.4),
    );
    assert!((found / exact - 1.0).abs() < ROUND_OFF, "{found} {exact}");
    let profile = recorder.last_profile();
    let ratio = depth_at(profile, 0.05) / depth_at(profile, -0.1);
    println!("depth where four strokes pass over that where two do: {ratio:.3}");
    // A groove of a tenth of the indentation widens the contact across it, which takes a few per cent of the line load of later passes.
    assert!((1.9..2.01).contains(&ratio), "{ratio}");
}

#[test]
fn a_surface_that_slides_through_a_contact_at_rest_wears_it_in_place() {
    // An amplitude far below a cell is not resolved.
    let mut short = ball(0.0, K, 2e-4, 500);
    short.effects = short.effects.with(Effect::StickMemory, false);
    let continuous = Scene {
        motion: Motion::Continuous { step_mm: 8e-4 },
        ..short.clone()
    };
    let (at_rest, recorder) = done(&continuous);
    let exact = K * FORCE * 500.0 * 8e-4;
    let found = volume(&at_rest, Side::Receptacle);
    assert!((found / exact - 1.0).abs() < ROUND_OFF, "{found} {exact}");
    let depth = |summary: &Summary| summary.last.receptacle.max_depth_mm;
    let in_place = depth(&done(&short).0);
    assert!((depth(&at_rest) / in_place - 1.0).abs() < 1e-12);
    let snapshot = recorder.snapshots.last().expect("it has a snapshot");
    assert_eq!(snapshot.positions.len(), 1, "it turns nowhere");
}
