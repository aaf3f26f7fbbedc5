//! Requirement: a place whose plating is through is no deeper than the slider can reach past the plating that stands beside it.
//! Source: geometry. With the rigid slider at u, the gap circle(x - u) + h_slider(x - u) + h_receptacle(x) is nowhere negative: the slider has sunk by
//! its least value s(u), so that h_receptacle(x) is at most the largest s(u) - circle(x - u) - h_slider(x - u) over the stroke.
//! Naive: contact of means. A node of the base wears 260 times as fast as the nickel beside it and digs where the means hide it: 3.3 um beyond
//! reach here, 100 um at twice the cycles, and the run ended without a contact state.
//!
//! The slider was less blunt before, and it is elastic: it has reached a little deeper than its last shape does.

use std::ops::ControlFlow;

use serde_json::json;
use solver::observer::{Event, Observer};
use solver::record::{DepthProfile, Snapshot};

use super::run::scene;

/// Radius of the slider and amplitude of a ZIF contact with all defaults, mm.
const RADIUS: f64 = 0.25;
const AMPLITUDE: f64 = 0.02;
/// Positions of the slider to either side.
const POSITIONS: i32 = 20;
/// Half-width in which the slider is a circle that may touch, mm.
const NEAR: f64 = 0.12;
/// Most beyond reach of the last shape, mm: 0.3 um are, and 3.3 um were with the hole. The layer of nickel beside it is 1.27 um thick.
const MOST_BEYOND: f64 = 5e-4;
/// Tolerance of `draft`.
const TOLERANCE: f64 = 0.1;

/// Keeps the last snapshot of a run.
#[derive(Default)]
struct Last(Option<Snapshot>);

impl Observer for Last {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        if let Event::Snapshot(snapshot) = event {
            self.0 = Some(snapshot.clone());
        }
        ControlFlow::Continue(())
    }
}

fn depth_at(profile: &DepthProfile, x: f64) -> f64 {
    let next = profile.x_mm.partition_point(|place| *place < x);
    if next == 0 || next == profile.x_mm.len() {
        return 0.0;
    }
    let (left, right) = (profile.x_mm[next - 1], profile.x_mm[next]);
    let share = (x - left) / (right - left);
    let (from, to) = (profile.depth_mm[next - 1], profile.depth_mm[next]);
    from + share * (to - from)
}

/// Largest depth of the receptacle below what the slider reaches over its stroke, mm.
fn beyond_reach(receptacle: &DepthProfile, slider: &DepthProfile) -> f64 {
    let places = || {
        receptacle
            .x_mm
            .iter()
            .copied()
            .zip(receptacle.depth_mm.iter().copied())
    };
    let surface = |from_middle: f64| {
        let circle = from_middle * from_middle / (2.0 * RADIUS);
        circle + depth_at(slider, from_middle)
    };
    let mut reached = vec![0.0_f64; receptacle.x_mm.len()];
    for position in -POSITIONS..=POSITIONS {
        let u = AMPLITUDE * f64::from(position) / f64::from(POSITIONS);
        let near = |x: f64| (x - u).abs() < NEAR;
        let gaps = places()
            .filter(|(x, _)| near(*x))
            .map(|(x, depth)| surface(x - u) + depth);
        let sunk = gaps.fold(f64::INFINITY, f64::min);
        for ((x, _), most) in places().zip(&mut reached) {
            if near(x) {
                *most = most.max(sunk - surface(x - u));
            }
        }
    }
    let beyond = places()
        .zip(&reached)
        .map(|((_, depth), most)| depth - most);
    beyond.fold(0.0, f64::max)
}

#[test]
fn no_hole_is_dug_beside_standing_plating() {
    let spec = json!({
        "system": {"kind": "zif"}, "cycles": 262_000, "accuracy": {"preset": "draft"},
        "output": {"snapshots_at_cycles": [262_000]},
    });
    let mut last = Last::default();
    let summary =
        solver::error_control::solve(&scene(&spec), &mut last).expect("the run goes through");
    let snapshot = last.0.expect("it is stored");
    let deepest = summary.last.receptacle.max_depth_mm;
    let beyond = beyond_reach(&snapshot.receptacle, &snapshot.slider);
    let stated = summary
        .errors
        .expect("they are estimated")
        .worn_depth
        .relative;
    println!(
        "after 262000 cycles {:.1} um deep, {:.1} um beyond reach, stated error {:.0} %",
        1e3 * deepest,
        1e3 * beyond,
        100.0 * stated
    );
    assert!(beyond < MOST_BEYOND, "{beyond}");
    assert!(stated < TOLERANCE, "{stated}");
}
