//! The specifications that the cases change.

use serde_json::{Value, json};

/// Accepted error against closed solutions. The worst of these cases reaches 1.5 %, the others 0.9 % and better; the
/// tolerance of most of them, `draft`, is 10 %.
pub(crate) const AGREEMENT: f64 = 0.02;

/// The thesis' fuzz button, coarse enough for a test, with changes.
pub(crate) fn fuzz_button(changes: Value) -> Value {
    let base = json!({
        "system": {"kind": "fuzz_button"},
        "motion": {"kind": "reciprocating", "amplitude_mm": 0.033_868, "period_s": 16},
        "cycles": 20,
        "accuracy": {"preset": "draft"},
    });
    merged(base, changes)
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

/// Merges changes into a document, member by member.
fn merged(base: Value, changes: Value) -> Value {
    match (base, changes) {
        (Value::Object(mut base), Value::Object(changes)) => {
            for (name, change) in changes {
                let old = base.remove(&name).unwrap_or(Value::Null);
                base.insert(name, merged(old, change));
            }
            Value::Object(base)
        }
        (_, changes) => changes,
    }
}
