//! The specifications that the cases change.

use serde_json::{Value, json};
use tests::{bare_preset, merged};

/// Accepted error against closed solutions. The worst of these cases reaches 1.5 %, the others 0.9 % and better; the
/// tolerance of most of them, `draft`, is 10 %.
pub(crate) const AGREEMENT: f64 = 0.02;

/// The thesis' fuzz button, coarse enough for a test, with changes.
pub(crate) fn fuzz_button(changes: Value) -> Value {
    let short = json!({
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.033_868, "period_s": 16},
        "cycles": 20,
        "accuracy": {"preset": "draft"},
    });
    merged(merged(bare_preset("fuzz_button"), short), changes)
}

/// McColl's cylinder of 6 mm on a flat, coarse enough for a test, with changes.
pub(crate) fn cylinder(changes: Value) -> Value {
    let steel = json!({"youngs_modulus_mpa": 200_000, "poisson_ratio": 0.3});
    let base = json!({
        "system": {"kind": "cylinder_on_flat"},
        "materials": {"slider": steel, "receptacle": steel},
        "interface": {
            "friction": {"law": "coulomb", "coefficient": 0.9},
            "wear": {"slider": null, "receptacle": {"law": "archard", "k_over_h_per_mpa": 2.9e-8}},
        },
        "load": {"kind": "line_force", "n_per_mm": 18.5},
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.025, "period_s": 0.05},
        "cycles": 100,
        "accuracy": {"preset": "draft"},
    });
    merged(base, changes)
}

/// The thesis' ring of wire under 0.834 N on five sections, with changes.
pub(crate) fn ring(changes: Value) -> Value {
    let base = json!({
        "system": {"kind": "fuzz_button"},
        "model": {"dimension": "ring", "outer_diameter_mm": 1.016, "top": "rigid"},
        "materials": {"slider": "copper", "receptacle": "copper"},
        "plating": {"slider": [], "receptacle": []},
        "interface": {
            "friction": {"law": "coulomb", "coefficient": 1.21},
            "wear": {"slider": null, "receptacle": {"law": "archard", "k_over_h_per_mpa": 2.576e-5}},
        },
        "load": {"kind": "force", "n": 0.834},
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.033_868, "period_s": 16},
        "cycles": 20,
        "accuracy": {"preset": "draft", "overrides": {"stations": 5}},
    });
    merged(base, changes)
}

/// The spring of a memory card, 0.4 mm round along the motion, under 0.5 N, as a model, with changes.
pub(crate) fn spring(model: Value, changes: Value) -> Value {
    let base = json!({
        "system": {"kind": "sd_card"},
        "load": {"kind": "force", "n": 0.5},
        "plating": {"slider": [], "receptacle": []},
        "interface": {
            "friction": {"law": "coulomb", "coefficient": 0.3},
            "wear": {"slider": null, "receptacle": {"law": "archard", "k_over_h_per_mpa": 5.9e-9}},
        },
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.02, "frequency_hz": 20},
        "cycles": 200,
        "accuracy": {"preset": "draft"},
    });
    let mut spec = merged(base, changes);
    spec["model"] = model;
    spec
}
