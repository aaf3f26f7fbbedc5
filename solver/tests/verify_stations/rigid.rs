//! A ring under a rigid top: every place of the floor sinks alike.
//!
//! A floor that the contact passes twice a cycle sinks by 2 k P'/cos(theta), so that P' is in proportion to cos(theta):
//!   P' = (pi/2) (F/L) cos(theta),  2 k P'/cos(theta) = pi k F/(2 pi R) = k F/(2 R).

use super::{FORCE, RADIUS, floor_nm, plane, ring, solved};
use crate::verification::recorder::solve;
use crate::verification::scenes::COPPER_WEAR;
use solver::scene::Top;
use solver::station::{run, stations_for};
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::time::Instant;

/// Near 90 degrees the contact does not leave its own width, and takes a part of the load until the floor has sunk by some of its
/// indentations: 5 % of the rate, as a prototype of this model had (21.5 nm).
#[test]
fn rigid_ring_sinks_alike_everywhere() {
    let floors = |cycles| {
        let mut scene = ring(Top::Rigid, 17, cycles);
        scene.section.accuracy.cycle_jump = Some(4);
        let found = solved(&scene);
        let floors: Vec<f64> = (0..9).map(|station| floor_nm(&found, station)).collect();
        (floors, found.last)
    };
    let ((_, first), (early, _), (late, last)) = (floors(12), floors(20), floors(60));
    let ideal = 1e6 * COPPER_WEAR * FORCE / (2.0 * RADIUS);
    let rates: Vec<f64> = early
        .iter()
        .zip(&late)
        .map(|(a, b)| (b - a) / 40.0)
        .collect();
    println!("ring, rigid: {rates:.2?} nm a cycle, k F/(2 R) {ideal:.2} nm");
    for rate in &rates {
        // The same height is taken off everywhere, but for the elastic approach, some nm in 40 cycles.
        assert!((rate / rates[0] - 1.0).abs() < 0.01);
        assert!((rate / ideal - 1.0).abs() < 0.05);
    }
    let mean = FORCE / (2.0 * PI * RADIUS);
    for (station, theta) in [(0, 0.0_f64), (2, 22.5), (4, 45.0)] {
        let cos = theta.to_radians().cos();
        let [early, late] = [&first, &last]
            .map(|cycle| cycle.stations[station].line_load_n_per_mm / (0.5 * PI * mean * cos));
        println!(
            "ring, rigid, {theta} deg: line load over (pi/2) (F/L) cos {early:.3} after 12 cycles, {late:.3} after 60"
        );
        // The load of places near 90 degrees is missing elsewhere. It grows with the trough there, mostly at the turning points, so that
        // the floor in the middle does not lose as much.
        assert!((early - 1.0).abs() < 0.05 && (late - 1.0).abs() < 0.1);
    }
    // The balance of the common height, 1e-9.
    assert!((last.force_n / FORCE - 1.0).abs() < 1e-8);
}

/// A prototype that did not wear more on inclined walls found 15.8 um at 1 000 cycles with 9 stations. On those walls a section wears more
/// than k P' s, by 6 % of the area across the motion and 21 % at 45 degrees in plane scenes at 2 000 cycles: at most a tenth more here.
#[test]
fn depth_of_the_rigid_ring() {
    let mut scene = ring(Top::Rigid, 9, 1_000);
    scene.section.accuracy.tolerance = 0.1;
    let found = solved(&scene);
    let depth = 1e3 * found.last.stations[0].max_depth_mm.receptacle;
    println!(
        "ring, rigid, draft: {depth:.2} um after 1 000 cycles, {} computed cycles, {:?} increments and iterations",
        found.computed_cycles, found.solves
    );
    assert!(depth > 15.8 && depth < 1.1 * 15.8);
}

mod night {
    use super::*;

    /// The figures of `docs/guide/lines.md`: the thesis' ring with 17 stations at 2 %, and the plane contact under the same line load, one after the other.
    #[test]
    #[ignore = "night: takes minutes"]
    #[expect(
        clippy::disallowed_methods,
        reason = "the test measures time; the engine knows no clock"
    )]
    fn cost_of_the_rigid_ring_against_the_plane_contact() {
        let scene = ring(Top::Rigid, stations_for(0.02), 2_000);
        let started = Instant::now();
        let (summary, recorder) = solve(&plane(&scene, 1.0)).expect("the scene can be solved");
        println!(
            "plane contact: {:.1} s, {:.2} um after 2 000 cycles, {} increments",
            started.elapsed().as_secs_f64(),
            1e3 * recorder.at(2_000).receptacle.max_depth_mm,
            summary.resolution.work.increments
        );
        let started = Instant::now();
        let mut reported = 0;
        let found = run(&scene, |cycle| {
            if cycle.cycle >= reported {
                let depth = |station: usize| 1e3 * cycle.stations[station].max_depth_mm.receptacle;
                println!(
                    "ring, rigid: {:.2}, {:.2}, {:.2} um at 0, 45, 90 deg after {} cycles, {:.0} s",
                    depth(0),
                    depth(4),
                    depth(8),
                    cycle.cycle,
                    started.elapsed().as_secs_f64()
                );
                reported = cycle.cycle + 200;
            }
            ControlFlow::Continue(())
        });
        let found = found.expect("the scene can be solved");
        let worn = found.last.worn_volume_mm3.receptacle;
        let ideal = found
            .last
            .ideal_volume_mm3
            .receptacle
            .unwrap_or_default()
            .max(f64::MIN_POSITIVE);
        println!(
            "ring, rigid: {:?} after {} cycles, {:.1} s, {} computed cycles, {:?} increments and iterations, {} sections condensed again, volume over k F s {:.4}",
            found.outcome,
            found.last.cycle,
            started.elapsed().as_secs_f64(),
            found.computed_cycles,
            found.solves,
            found.relocations,
            worn / ideal
        );
        // As deep everywhere, but for the elastic approach.
        let depths = found.last.stations.iter();
        let depths = depths.map(|station| station.max_depth_mm.receptacle);
        let (least, most) = depths
            .fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), depth| {
                (least.min(depth), most.max(depth))
            });
        assert!(most / least - 1.0 < 0.01);
    }
}
