//! Requirement: strains are assumed small, and the plan states the error; beyond 1 % a scene is refused.
//!
//! CalculiX solves the exported deck of a cylinder on a block with and without geometric non-linearity. The peak pressure
//! falls by 1/2 p0/E* (0.4 % where p0/E* = 0.85 %), the rule that `solver::effects::small_strain_cost` applies.

use serde_json::{Value, json};
use tests::{calculix, fretwear};

/// Half-width at 18.5 N/mm, mm; it grows with the square root of the load.
const HALF_WIDTH: f64 = 0.0357;

fn half_width(load: f64) -> f64 {
    HALF_WIDTH * (load / 18.5).sqrt()
}

/// Bodies of 15 half-widths, so that CalculiX takes seconds.
fn spec(load: f64) -> String {
    let (element, length) = (half_width(load) / 7.0, 15.0 * half_width(load));
    json!({
        "system": {"kind": "cylinder_on_flat", "flat_length_mm": length, "flat_height_mm": length,
            "slider_half_width_mm": 0.5 * length, "slider_height_mm": length},
        "interface": {"friction": {"law": "frictionless"}},
        "load": {"kind": "line_force", "n_per_mm": load},
        "motion": {"kind": "continuous", "distance_mm": 1},
        "accuracy": {"preset": "draft", "overrides": {"contact_element_mm": element}}
    })
    .to_string()
}

/// Mean pressure of the middle third, MPa: single nodes alternate by some per mille.
fn middle(load: f64, step: &str) -> f64 {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let deck = calculix::deck(folder.path(), &spec(load));
    let (plain, increments) = ("*STEP, INC=1000", "0.05, 1., 1e-6, 0.25");
    assert!(deck.contains(plain) && deck.contains(increments), "{deck}");
    // Without friction the end does not depend on the increments.
    let deck = deck.replace(increments, "0.2, 1., 1e-6, 0.4");
    calculix::run(folder.path(), &deck.replace(plain, step));
    let pressures = calculix::contact_pressures(folder.path());
    let reach = 1e6 * 0.3 * half_width(load);
    let near = pressures
        .iter()
        .filter(|(place, _)| place.parse::<f64>().is_ok_and(|x| x.abs() < reach));
    let found: Vec<f64> = near.map(|(_, p)| *p).collect();
    assert!(found.len() > 2, "{pressures:?}");
    found.iter().sum::<f64>() / f64::from(u32::try_from(found.len()).expect("a few"))
}

#[test]
#[cfg_attr(not(has_ccx), ignore = "needs the program ccx of CalculiX")]
fn peak_pressure_falls_by_half_the_contact_strain() {
    for (load, strain) in [(18.5, 0.0030), (150.0, 0.0085)] {
        let linear = middle(load, "*STEP, INC=1000, NLGEOM=NO");
        let finite = middle(load, "*STEP, INC=1000, NLGEOM");
        let change = finite / linear - 1.0;
        println!(
            "p0/E* = {strain}: peak changes by {change:.2e}, the rule says {:.2e}",
            -0.5 * strain
        );
        // The rule is of first order; the difference is of second order.
        assert!((change / (-0.5 * strain) - 1.0).abs() < 0.25, "{change}");
    }
}

#[test]
fn the_plan_states_the_small_strain_error_of_every_preset_below_the_limit() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    for kind in ["fuzz_button", "sd_card", "dimm", "zif", "cylinder_on_flat"] {
        let spec = json!({"system": {"kind": kind}}).to_string();
        std::fs::write(folder.path().join("spec.json"), spec).expect("a file can be written");
        let ran = fretwear(folder.path(), &["plan", "spec.json", "--json"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let plan: Value = serde_json::from_str(&ran.stdout).expect("the plan is JSON");
        let effects = plan["plan"]["effects"].as_array().expect("a list");
        let mut effects = effects.iter();
        let effect = effects.find(|effect| effect["effect"] == "geometric_nonlinearity");
        let effect = effect.expect("it is part of every plan");
        println!("{kind}: {}", effect["reason"]);
        assert_eq!(effect["decision"], "skipped");
        assert_eq!(effect["threshold"], 0.01);
        assert!(effect["value"].as_f64() < Some(0.01), "{effect}");
    }
}
