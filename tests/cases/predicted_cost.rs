//! Requirement: a plan estimates the unknowns, memory, computed cycles and increments of a solve within a factor of two,
//! on all systems and both published scenes, at every tolerance.
//!
//! Workload is counted here; time depends on other load of the machine; `fretwear bench --predictions` compares it. The
//! looser tolerances run with every test; `FRETWEAR_PREDICTIONS=long` runs all.

use server::bench::predictions::{TOLERANCES, compare, scenes};
use server::estimate::machine;

#[test]
fn counted_work_is_within_a_factor_of_two_of_the_plan() {
    let all = std::env::var("FRETWEAR_PREDICTIONS").is_ok_and(|length| length == "long");
    let machine = machine::measure().expect("the machine can be measured");
    let tolerances = if all {
        &TOLERANCES[..]
    } else {
        &TOLERANCES[..2]
    };
    for tolerance in tolerances {
        for scene in scenes().expect("scenes are sound") {
            let prediction = compare(&tests::binary(), &machine, &scene, *tolerance);
            let prediction = prediction.expect("it can be solved");
            assert_eq!(prediction.pairs.len(), 5);
            for pair in &prediction.pairs {
                let ratio = pair.ratio();
                println!(
                    "{} at {tolerance}: {} {:.3} / {:.3} = {ratio:.2}",
                    scene.0, pair.what, pair.expected, pair.measured
                );
                assert!(
                    pair.what == "cpu_s" || (0.5..=2.0).contains(&ratio),
                    "{prediction:?}"
                );
            }
        }
    }
}
