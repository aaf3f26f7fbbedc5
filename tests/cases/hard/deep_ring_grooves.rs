//! Requirement: a ring whose grooves become as deep as the wire's radius ends as `deeper_than_radius`, and one on whose walls friction exceeds
//! the slope ends with an outcome or with numbers.
//! Source: three_d.md 8; the thesis' ring with mu = 1.21, worn four hundred times as fast as by its constants.
//! Naive: walls that overhang are no graph: depths of 79 um at 90 degrees out of nothing, then no contact state and halvings without end.

use serde_json::{Value, json};
use solver::record::Outcome;

use super::invariants::across::{faults, hold};
use super::run::solve;
use super::specs::ring;

const RADIUS: f64 = 0.0254;

fn fast(k_over_h_per_mpa: f64) -> Value {
    json!({"wear": {"receptacle": {"law": "archard", "k_over_h_per_mpa": k_over_h_per_mpa}}})
}

#[test]
fn a_groove_as_deep_as_the_wire_ends_the_run() {
    for top in ["even", "rigid"] {
        let run = solve(&ring(json!({
            "model": {"top": top},
            "interface": fast(1e-3),
            "cycles": 2000,
        })));
        hold(&run);
        let summary = run.summary();
        assert_eq!(summary.outcome, Outcome::DeeperThanRadius, "{top}");
        let deepest = summary.last.receptacle.max_depth_mm;
        assert!(
            deepest > 0.5 * RADIUS && deepest < 3.0 * RADIUS,
            "{top}: {deepest} mm"
        );
        assert!(summary.last.cycle > 10 && summary.last.cycle < 400, "{top}");
    }
}

/// Walls pass atan(1/mu) below mu = 2, where nothing but wear lets the wire move on.
#[test]
fn a_ring_that_jams_on_its_walls_ends_with_an_outcome_or_with_numbers() {
    for (top, mu) in [
        ("rigid", 1.21),
        ("even", 1.21),
        ("pressure", 1.21),
        ("rigid", 2.0),
    ] {
        let run = solve(&ring(json!({
            "model": {"top": top},
            "interface": {
                "friction": {"law": "coulomb", "coefficient": mu},
                "wear": {"receptacle": {"law": "archard", "k_over_h_per_mpa": 2.576e-4}},
            },
            "cycles": 400,
        })));
        let found = faults(&run);
        assert!(found.is_empty(), "{top}, {mu}: {}", found.join("\n"));
        assert!(
            run.reports.len() > 2,
            "{top}, {mu}: {:?}",
            run.end.as_ref().err()
        );
    }
}
