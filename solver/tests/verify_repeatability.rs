//! The same input gives the same bits, however many solves run at once.

use crate::verification::recorder::{Recorder, solve};
use crate::verification::scenes::{fuzz_button, mccoll};
use solver::scene::Scene;

fn bits(recorder: &Recorder) -> Vec<u64> {
    let depths = recorder
        .snapshots
        .iter()
        .flat_map(|s| s.receptacle.depth_mm.iter().chain(&s.slider.depth_mm));
    depths.map(|d| d.to_bits()).collect()
}

/// Runs the scene on `threads` threads at once and asserts that all of them give the same as `alone`.
fn assert_same(scene: &Scene, alone: &Recorder, threads: usize) {
    let runs: Vec<Recorder> = std::thread::scope(|scope| {
        let started: Vec<_> = (0..threads)
            .map(|_| scope.spawn(|| solve(scene).expect("the scene can be solved").1))
            .collect();
        started
            .into_iter()
            .map(|run| run.join().expect("the run does not panic"))
            .collect()
    });
    for run in &runs {
        assert_eq!(bits(run), bits(alone));
        assert_eq!(run.reports, alone.reports);
    }
}

#[test]
fn one_two_and_four_threads_give_the_same_bits() {
    let mut short = Scene {
        cycles: 200,
        ..mccoll()
    };
    short.output.snapshots_at_cycles = vec![50, 200];
    // Long enough that the block is meshed and condensed again.
    let mut worn = Scene {
        cycles: 400,
        ..fuzz_button()
    };
    worn.accuracy.tolerance = 0.1;
    for scene in [short, worn] {
        let alone = solve(&scene).expect("the scene can be solved").1;
        for threads in [1, 2, 4] {
            assert_same(&scene, &alone, threads);
        }
    }
}
