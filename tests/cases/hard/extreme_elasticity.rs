//! Requirement: a nearly incompressible body, and bodies whose moduli differ by 1e4, agree with Hertz and satisfy the invariants.
//! Source: Johnson 1985, eq. 4.43 to 4.45, with 1/E* = (1 - n1^2)/E1 + (1 - n2^2)/E2.
//! Naive: four-node elements lock at a Poisson's ratio of 0.499 and carry a multiple of the pressure; a penalty chosen
//! for one body is far off for the other.

use std::f64::consts::PI;

use serde_json::json;

use super::invariants::hold;
use super::run::{Run, solve};
use super::specs::cylinder;

/// Steel over another material, at a load that gives the half-width of steel on steel.
fn over(modulus: f64, poisson: f64) -> (Run, f64) {
    let compliance = (1.0 - 0.3 * 0.3) / 200e3 + (1.0 - poisson * poisson) / modulus;
    let a = 0.03586;
    let load = PI * a * a / (4.0 * 6.0 * compliance);
    let run = solve(&cylinder(json!({
        "materials": {"receptacle": {"youngs_modulus_mpa": modulus, "poisson_ratio": poisson}},
        // Without friction: bodies of unequal moduli that stick under the load have 7 % more pressure than Hertz.
        "interface": {"friction": {"law": "frictionless", "coefficient": null}, "wear": {"receptacle": {"k_over_h_per_mpa": 1e-4 / load}}},
        "load": {"kind": "line_force", "n_per_mm": load},
        "accuracy": {"preset": "standard"},
        "cycles": 10,
    })));
    (run, 2.0 * load / (PI * a))
}

#[test]
fn soft_and_incompressible_bodies_meet_hertz() {
    for (modulus, poisson) in [(200e3, 0.499), (20.0, 0.3), (20.0, 0.499), (1e8, 0.3)] {
        let (run, peak) = over(modulus, poisson);
        hold(&run);
        let ratio = run.summary().initial.peak_pressure_mpa / peak;
        assert!(
            (ratio - 1.0).abs() < 0.02,
            "E {modulus}, nu {poisson}: {ratio}"
        );
        assert!(
            run.area_ratio() > 0.5,
            "E {modulus}, nu {poisson}: {}",
            run.area_ratio()
        );
    }
}
