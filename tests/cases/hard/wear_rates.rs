//! Requirement: k/H from 1e-10 to 1e-3 per MPa is solved with exact worn area, balance and smooth pressure.
//! Source: Archard coefficients of the thesis' table (1e-7 to 1e-2) over hardnesses of 10 to 1e4 MPa.
//! Naive: explicit wear needs |ds| < 4 dx / (pi k E*) an increment, which 1e-3 per MPa breaks a thousandfold; and an
//! absolute gap tolerance hides the wear of 1e-10.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::cylinder;

#[test]
fn seven_decades_of_wear_rate_satisfy_the_invariants() {
    for k in [1e-10, 1e-8, 1e-6, 1e-4, 1e-3] {
        let run = solve(&cylinder(json!({
            "interface": {"wear": {"receptacle": {"k_over_h_per_mpa": k}}},
            "cycles": 10,
        })));
        hold(&run);
        let ratio = run.area_ratio();
        assert!(ratio > 0.85 && ratio < 1.02, "k/H {k:e}: {ratio}");
    }
}

#[test]
fn a_hundredfold_rate_wears_a_hundredfold_area() {
    let area = |k: f64| {
        let changes =
            json!({"interface": {"wear": {"receptacle": {"k_over_h_per_mpa": k}}}, "cycles": 4});
        let run = solve(&cylinder(changes));
        run.summary().last.receptacle.worn_area_mm2 / k
    };
    let (slow, fast) = (area(1e-9), area(1e-7));
    assert!((slow / fast - 1.0).abs() < 0.02, "{slow} {fast}");
}
