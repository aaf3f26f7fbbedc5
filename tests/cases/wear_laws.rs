//! Requirement: a contact wears by the law that its specification names for each part, and what no one has published is asked for by
//! name. Each law of the history, of time and of speed is solved from a specification once.

use std::path::Path;

use serde_json::{Value, json};
use tests::fretwear;

/// A card that wears by a law for so many cycles.
fn card(law: &Value, cycles: u64) -> Value {
    json!({
        "system": {"kind": "sd_card"},
        "plating": {"slider": [], "receptacle": []},
        "interface": {"wear": {"slider": null, "receptacle": law}},
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.02, "period_s": 0.05},
        "cycles": cycles,
        "accuracy": {"preset": "draft", "estimate_errors": false}
    })
}

fn solved(folder: &Path, spec: &Value) -> Value {
    std::fs::write(folder.join("spec.json"), spec.to_string()).expect("a file");
    let ran = fretwear(folder, &["solve", "spec.json", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    serde_json::from_str(&ran.stdout).expect("a summary")
}

/// A tenth of the tolerance: jumps differ from law to law.
const SAME: f64 = 0.01;

fn depth(summary: &Value) -> f64 {
    let depth = summary["receptacle"]["max_depth_mm"].as_f64();
    depth.expect("a depth")
}

#[test]
fn laws_of_the_history_differ_from_archards_as_they_say() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let run = |law: Value| depth(&solved(folder.path(), &card(&law, 200)));
    let archard = run(json!({"law": "archard", "k_over_h_per_mpa": 2e-7}));
    let barwell = |course: &str, dose: f64| {
        run(
            json!({"law": "barwell", "k_over_h_per_mpa": 2e-7, "course": course, "characteristic_dose_mpa_mm": dose}),
        )
    };
    for course in ["decelerating", "accelerating"] {
        let same = barwell(course, 1e12);
        assert!((same / archard - 1.0).abs() < SAME, "{same} {archard}");
    }
    let (slower, faster) = (
        barwell("decelerating", 300.0),
        barwell("accelerating", 300.0),
    );
    assert!(
        slower < 0.9 * archard && faster > 1.1 * archard,
        "{slower} {archard} {faster}"
    );
    let rhee = json!({"law": "rhee", "wear_factor": 2e-7, "pressure_exponent": 1, "speed_exponent": 1, "time_exponent": 1});
    let same = run(rhee);
    assert!((same / archard - 1.0).abs() < SAME, "{same} {archard}");
}

#[test]
fn laws_of_time_wear_by_the_period() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let strain = json!({"law": "strain_hardening", "wear_factor": 1e-9, "pressure_exponent": 2, "strain_exponent": -0.5,
        "activation_temperature_k": 1000, "contact_temperature_c": 26.85, "reference_length_mm": 1e-3});
    let quinn = json!({"law": "quinn", "asperity_diameter_um": 20, "arrhenius_constant_kg2_m4s": 1.5e10,
        "activation_energy_j_mol": 208e3, "contact_temperature_c": 400, "critical_film_um": 1, "oxide_density_kg_m3": 5240,
        "oxygen_fraction": 0.3006, "hardness_mpa": 1700});
    for law in [quinn, strain] {
        let run = |period: f64, cycles: u64| {
            let mut spec = card(&law, cycles);
            spec["motion"]["period_s"] = json!(period);
            solved(folder.path(), &spec)
        };
        let (slow, fast) = (run(0.1, 100), run(0.05, 200));
        let ratio = depth(&slow) / depth(&fast);
        assert!(
            depth(&fast) > 0.0 && (ratio - 1.0).abs() < 0.1,
            "{law}: {ratio}"
        );
    }
}

#[test]
fn repetitions_of_the_load_wear_by_their_number_whatever_the_period() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let law = json!({"law": "load_repetition", "wear_factor": 1e-6, "pressure_exponent": 1.5, "repetition_exponent": 0.8,
        "reference_length_mm": 1e-3});
    let run = |period: f64| {
        let mut spec = card(&law, 100);
        spec["motion"]["period_s"] = json!(period);
        depth(&solved(folder.path(), &spec))
    };
    let (slow, fast) = (run(1.0), run(0.01));
    assert!(
        fast > 0.0 && (slow / fast - 1.0).abs() < 1e-12,
        "{slow} {fast}"
    );
}

#[test]
fn a_law_outside_of_its_range_is_warned_of_in_the_plan_and_one_without_constants_is_refused() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let severe = json!({"law": "severe_oxidation", "molten_fraction": 0.01, "latent_heat_j_m3": 2e9, "heat_share": 0.5,
        "oxide_conductivity_w_mk": 3.2, "oxide_melting_temperature_c": 1487, "contact_temperature_c": 20, "diffusion_distance_um": 10});
    let file = folder.path().join("spec.json");
    std::fs::write(&file, card(&severe, 10).to_string()).expect("a file");
    let plan = fretwear(folder.path(), &["plan", "spec.json"]);
    assert!(
        plan.stderr.contains("nothing wears: the oxide melts from"),
        "{}",
        plan.stderr
    );
    std::fs::write(&file, card(&json!({"law": "rhee"}), 10).to_string()).expect("a file");
    let refused = fretwear(folder.path(), &["plan", "spec.json"]);
    assert_eq!(refused.code, Some(2));
    for field in [
        "wear_factor",
        "pressure_exponent",
        "speed_exponent",
        "time_exponent",
    ] {
        assert!(
            refused.stderr.contains(field),
            "{field}: {}",
            refused.stderr
        );
    }
}
