//! Cost of extruded bodies.

use std::ops::ControlFlow;
use std::time::Instant;

use super::{TWO, button};
use crate::verification::recorder::solve;
use solver::extruded::run;
use solver::scene::{Accuracy, Ends};
use solver::scene::{Effect, Switches};

/// The figures of `docs/guide/extruded.md`: the thesis' free model over 2 000 cycles, and the plane contact, one after the other.
#[test]
#[ignore = "measures time; run it by name"]
#[expect(
    clippy::disallowed_methods,
    reason = "the test measures time; the engine knows no clock"
)]
fn cost_of_extruded_bodies_against_the_plane_contact() {
    for (tolerance, layers) in [(0.1, TWO), (0.02, TWO), (0.1, (8, 2.0))] {
        let mut scene = button(Ends::Free, layers, 2_000);
        scene.section.accuracy = Accuracy::from_tolerance(tolerance);
        let mut plane = scene.section.clone();
        plane.effects = Switches::default().with(Effect::StickMemory, false);
        let started = Instant::now();
        let (summary, recorder) = solve(&plane).expect("the scene can be solved");
        let seconds = started.elapsed().as_secs_f64();
        println!(
            "plane contact at {tolerance}: {seconds:.2} s, {:.2} um after 2 000 cycles, {} increments",
            1e3 * recorder.at(2_000).receptacle.max_depth_mm,
            summary.resolution.work.increments
        );
        let mut loaded = scene.clone();
        loaded.section.cycles = 1;
        loaded.section.accuracy.increments_per_cycle = Some(4);
        let started = Instant::now();
        let begun = run(&loaded, |_| ControlFlow::Continue(())).map(|found| found.solves);
        let condensing = started.elapsed().as_secs_f64();
        let started = Instant::now();
        let found = run(&scene, |_| ControlFlow::Continue(())).expect("the scene can be solved");
        let all = started.elapsed().as_secs_f64();
        println!(
            "extruded, {layers:?} layers at {tolerance}: {all:.2} s, of which {condensing:.2} s to the first cycle ({begun:?}); {:.2} um, {} computed cycles, {:?} increments and iterations, {} condensed again; {:.1} times the plane contact without",
            1e3 * found.last.stations[0].max_depth_mm.receptacle,
            found.computed_cycles,
            found.solves,
            found.relocations,
            (all - condensing) / seconds
        );
    }
}
