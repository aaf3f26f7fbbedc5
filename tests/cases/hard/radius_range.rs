//! Requirement: radii from 1 um to 10 m give the same results in units of the radius.
//! Source: all terms of the problem scale with one length (P with it too); contract.md sets no smaller range.
//! Naive: tolerances in millimetres are too loose for a contact of nanometres and too tight for one of metres.

use serde_json::json;

use super::invariants::hold;
use super::run::solve;
use super::specs::cylinder;

#[test]
fn radii_from_a_micrometre_to_ten_metres_give_the_same_scaled_wear() {
    let depths = [1e-3, 6.0, 1e4].map(|radius: f64| {
        let run = solve(&cylinder(json!({
            "system": {"radius_mm": radius, "slider_half_width_mm": 0.5 * radius, "slider_height_mm": 0.6 * radius,
                "flat_length_mm": radius, "flat_height_mm": 0.6 * radius},
            "load": {"kind": "line_force", "n_per_mm": 3.0 * radius},
            "motion": {"amplitude_mm": 0.004 * radius},
            "cycles": 50,
        })));
        hold(&run);
        run.depth() / radius
    });
    for depth in depths {
        assert!((depth / depths[1] - 1.0).abs() < 1e-6, "{depths:?}");
    }
}
