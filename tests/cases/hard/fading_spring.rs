//! Requirement: a spring so stiff that its force fades as the contact wears ends with no force and a finite depth.
//! Source: exponential fade P = P0 exp(-2 k s_pass .. ) of a sprung contact on a flat floor (verify_spring_load); the
//! slider can sink by P0 / k_spring and no further.
//! Naive: the force goes negative and pulls; or the contact is lost and the load balance has no solution.

use serde_json::json;
use server::spec;

use super::invariants::hold;
use super::run::{solve, solve_part};
use super::specs::fuzz_button;

#[test]
fn a_stiff_spring_fades_to_zero_and_stops_the_wear() {
    // 0.508 N/mm over 0.0005 mm of sinking.
    let run = solve(&fuzz_button(json!({
        "load": {"kind": "pressure", "mpa": 10, "spring_n_per_mm": 1016},
        "cycles": 1000,
    })));
    hold(&run);
    let loads: Vec<f64> = run
        .reports
        .iter()
        .map(|report| report.load_n_per_mm)
        .collect();
    assert!(
        loads.windows(2).all(|w| w[1] <= w[0] * (1.0 + 1e-9)),
        "{loads:?}"
    );
    let last = loads.last().expect("there are reports");
    assert!(*last >= 0.0 && *last < 1e-3 * 0.508, "{last}");
    assert!(
        run.depth() > 0.0 && run.depth() < 2.0 * 0.0005,
        "{}",
        run.depth()
    );
}

/// As drawn by `random_specifications`: round-off gave a load below zero in an earlier version.
#[test]
fn a_spring_that_fades_within_a_jump_leaves_no_force_and_never_pulls() {
    let path = tests::spec("found/spring_fades_within_a_jump.json");
    let bytes = std::fs::read(path).expect("the specification is kept");
    let scene = spec::read(&bytes).expect("it is accepted").scene;
    let run = solve_part(scene, usize::MAX);
    hold(&run);
    let load = run.summary().last.load_n_per_mm;
    assert!((0.0..1e-9 * 9.134e-8).contains(&load), "{load}");
}
