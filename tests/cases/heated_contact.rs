//! Requirement: heat of the current and of friction is simulated where a specification requires it, and its temperature is in the
//! results; where it matters nothing, nothing of it is there.

use std::path::Path;

use serde_json::{Value, json};
use tests::fretwear;

fn solved(folder: &Path, spec: &Value) -> Value {
    std::fs::write(folder.join("spec.json"), spec.to_string()).expect("a file");
    let ran = fretwear(
        folder,
        &["solve", "spec.json", "--json", "--out", "results"],
    );
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    serde_json::from_str(&ran.stdout).expect("a summary")
}

fn header(folder: &Path) -> String {
    let csv = folder.join("results/wear-history.csv");
    let text = std::fs::read_to_string(csv).expect("the history is there");
    text.lines().next().unwrap_or_default().to_owned()
}

/// An SD card through whose contact a current flows.
fn conducting(current_a: f64) -> Value {
    json!({
        "system": {"kind": "sd_card"},
        "environment": {"current_a": current_a},
        "cycles": 200,
        "accuracy": {"preset": "draft", "estimate_errors": false}
    })
}

#[test]
fn a_current_heats_a_contact_and_a_weak_one_does_not() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let folder = folder.path();
    let warm = solved(folder, &conducting(20.0));
    let temperature = warm["contact_temperature_c"]["final"]
        .as_f64()
        .expect("a temperature");
    assert_eq!(warm["effects"]["joule_heating"], "simulated");
    // sqrt(T^2 + V^2/(4 L)) with the voltage over the constriction at the end.
    let parts = &warm["contact_resistance_mohm"]["parts"];
    let part = |name: &str| parts[name].as_f64().expect("a part");
    let constriction = part("slider_constriction") + part("receptacle_constriction") + part("film");
    let voltage: f64 = 1e-3 * constriction * 20.0;
    let expected = (293.15_f64.powi(2) + voltage * voltage / (4.0 * 2.44e-8)).sqrt() - 273.15;
    // A computed cycle has the resistance of the one before.
    assert!(
        (temperature / expected - 1.0).abs() < 0.01,
        "{temperature} {expected}"
    );
    assert!(header(folder).contains("contact_temperature_c"));
    let cold = solved(folder, &conducting(0.01));
    assert!(cold.get("contact_temperature_c").is_none(), "{cold}");
    assert!(!header(folder).contains("contact_temperature_c"));
    let depth = |summary: &Value| summary["slider"]["max_depth_mm"].as_f64().expect("a depth");
    assert!(
        depth(&warm) > 1.02 * depth(&cold),
        "{} {}",
        depth(&warm),
        depth(&cold)
    );
}

/// A motion with an inner loop, fast enough to heat the contact.
#[test]
fn a_periodic_motion_heats_its_contact_too() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let spec = json!({
        "system": {"kind": "cylinder_on_flat"},
        "motion": {
            "kind": "fourier",
            "terms": [{"order": 1, "sine_mm": 0.03}, {"order": 3, "sine_mm": 0.03}],
            "frequency_hz": 1000
        },
        "cycles": 100,
        "accuracy": {"preset": "draft", "estimate_errors": false}
    });
    let summary = solved(folder.path(), &spec);
    let temperature = summary["contact_temperature_c"]["highest"].as_f64();
    assert!(
        temperature.is_some_and(|found| (30.0..500.0).contains(&found)),
        "{summary}"
    );
    let mut molten = spec;
    molten["motion"] = json!({"kind": "reciprocating", "amplitude_mm": 0.5, "frequency_hz": 50000});
    std::fs::write(folder.path().join("spec.json"), molten.to_string()).expect("a file");
    let ran = fretwear(folder.path(), &["solve", "spec.json"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stdout);
    assert!(
        ran.stderr.contains("a material of it melts"),
        "{}",
        ran.stderr
    );
}
