//! Requirement: bodies of nearly equal curvature stay in balance: the contact is wide under a light load.
//! Source: Johnson 1985, eq. 4.43: with 1/R = 1/R1 + 1/R2 the half-width grows without bound as R2 -> -R1. A concave
//! receptacle cannot be specified, so the closest are a cylinder of 10 m on a flat, and a scar worn by its own cylinder.
//! Naive: the gap is the difference of two nearly equal heights, R - sqrt(R^2 - x^2) cancels all its digits, and the
//! contact status alternates.

use std::f64::consts::PI;

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::{AGREEMENT, cylinder};

#[test]
fn a_cylinder_of_ten_metres_on_a_flat_meets_hertz() {
    let run = solve(&cylinder(json!({
        "system": {"radius_mm": 1e4, "slider_half_width_mm": 60, "slider_height_mm": 60,
            "flat_length_mm": 120, "flat_height_mm": 60},
        "interface": {"friction": {"law": "frictionless", "coefficient": null}},
        "load": {"kind": "line_force", "n_per_mm": 1.0},
        "cycles": 20,
    })));
    hold(&run);
    let modulus = 200e3 / (2.0 * (1.0 - 0.09));
    let half_width = (4.0 * 1.0 * 1e4 / (PI * modulus)).sqrt();
    let reached = run.summary().initial.contact_half_width_mm;
    assert!(
        (reached / half_width - 1.0).abs() < AGREEMENT,
        "{reached} {half_width}"
    );
}

/// A scar that a cylinder has worn to its own radius: as wide as the segment of its worn area, its pressure uniform.
#[test]
fn a_scar_that_has_taken_the_cylinders_shape_is_smooth() {
    let run = solve(&cylinder(json!({
        "interface": {"wear": {"receptacle": {"k_over_h_per_mpa": 1e-6}}},
        "motion": {"amplitude_mm": 0.01},
        "cycles": 20_000,
    })));
    hold(&run);
    let last = &run.summary().last;
    let segment = (1.5 * 6.0 * last.receptacle.worn_area_mm2).cbrt();
    let scar = last.receptacle.scar_half_width_mm;
    assert!((scar / segment - 1.0).abs() < AGREEMENT, "{scar} {segment}");
    let mean = 18.5 / (2.0 * last.contact_half_width_mm);
    assert!(
        last.peak_pressure_mpa < 2.5 * mean,
        "{} {mean}",
        last.peak_pressure_mpa
    );
}
