//! Presets whose bodies are bare: cases that are about one surface that wears below an unworn one.

use serde_json::{Value, json};

/// The preset of a kind without its platings. The slider does not wear; a pad wears by the coefficient of silver and the hardness of
/// hard gold, that of the fuzz button, the base scene of the thesis, as copper on copper.
pub fn bare_preset(kind: &str) -> Value {
    match kind {
        "fuzz_button" => json!({
            "system": {"kind": kind},
            "materials": {"slider": "copper", "receptacle": "copper"},
            "plating": {"slider": [], "receptacle": []},
            "interface": {
                "friction": {"law": "coulomb", "coefficient": 1.21},
                "wear": {"slider": null, "receptacle": {"law": "archard", "k": 0.011, "hardness_mpa": 427}},
            },
        }),
        "cylinder_on_flat" => json!({"system": {"kind": kind}}),
        _ => json!({
            "system": {"kind": kind},
            "plating": {"slider": [], "receptacle": []},
            "interface": {
                "wear": {"slider": null, "receptacle": {"law": "archard", "k": 0.004, "hardness_mpa": 1700}},
            },
        }),
    }
}

/// A document with changes, member by member; a specific wear rate takes the place of a coefficient and a hardness.
#[must_use]
pub fn merged(base: Value, changes: Value) -> Value {
    match (base, changes) {
        (Value::Object(mut base), Value::Object(changes)) => {
            if changes.contains_key("k_over_h_per_mpa") {
                base.remove("k");
                base.remove("hardness_mpa");
            }
            for (name, change) in changes {
                let old = base.remove(&name).unwrap_or(Value::Null);
                base.insert(name, merged(old, change));
            }
            Value::Object(base)
        }
        (_, changes) => changes,
    }
}
