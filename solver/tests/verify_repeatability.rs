//! The same input gives the same bits.

use crate::keep::solve;
use crate::scenes::mccoll;
use solver::scene::Scene;

#[test]
fn two_runs_at_once_give_the_same_bits() {
    let scene = Scene {
        cycles: 200,
        ..mccoll()
    };
    let run = || solve(&scene).expect("the scene can be solved").1;
    let (first, second) = std::thread::scope(|scope| {
        let other = scope.spawn(run);
        (run(), other.join().expect("the run does not panic"))
    });
    let bits = |keep: &crate::keep::Keep| -> Vec<u64> {
        let depths = keep
            .snapshots
            .iter()
            .flat_map(|s| s.receptacle.depth_mm.iter());
        depths.map(|d| d.to_bits()).collect()
    };
    assert_eq!(bits(&first), bits(&second));
    assert_eq!(first.reports, second.reports);
}
