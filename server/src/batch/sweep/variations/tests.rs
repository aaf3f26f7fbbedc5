//! Every value of the resolved specification of every system and dimension, set to itself and to another value.

use std::collections::BTreeMap;

use api::sweep::Changes;
use serde_json::{Value, json};

use super::vary;
use crate::spec::Resolved;

/// Values that follow another one where the specification leaves them out: the pointers that begin with the first text, of the second.
const FOLLOW: [(&str, &str); 10] = [
    ("/system/", "/system/"),
    ("/output/stations_mm", "/system/"),
    ("/output/stations_mm", "/motion/"),
    ("/output/stations_mm", "/mission/"),
    ("/output/snapshots_at_cycles", "/cycles"),
    ("/output/snapshots_at_cycles", "/mission/"),
    ("/output/snapshots_at_cycles", "/repeat"),
    ("/model/", "/system/"),
    (
        "/interface/wear/slider/hardness_mpa",
        "/materials/slider/hardness_mpa",
    ),
    (
        "/interface/wear/receptacle/hardness_mpa",
        "/materials/receptacle/hardness_mpa",
    ),
];

/// Specifications of all systems in all dimensions that they have, and of the further kinds of motion, load and plating.
fn bases() -> Vec<Value> {
    let models = [
        json!({"dimension": "plane_strain"}),
        json!({"dimension": "point"}),
        json!({"dimension": "line", "width_mm": 0.8, "crown_radius_mm": 10}),
        json!({"dimension": "extruded", "width_mm": 0.4}),
        json!({"dimension": "auto", "width_mm": 0.8, "crown_radius_mm": 10}),
    ];
    let kinds = ["fuzz_button", "sd_card", "dimm", "zif", "cylinder_on_flat"];
    // Presets of the wire and of the bench geometry carry no force over an extent.
    let in_dimensions = kinds.iter().flat_map(|kind| {
        let of = |model: &Value| {
            let width = (model["dimension"] == "plane_strain").then_some(0.8);
            // A wire as thin as a hair carries a tenth.
            let force_n = if *kind == "fuzz_button" { 0.01 } else { 0.5 };
            let load = json!({"kind": "force", "n": force_n});
            let mut base =
                json!({"system": {"kind": kind}, "model": model, "load": load, "cycles": 100});
            if let Some(width) = width {
                base["load"]["width_mm"] = json!(width);
            }
            base
        };
        models.iter().map(of).collect::<Vec<_>>()
    });
    let mut bases: Vec<Value> = kinds
        .iter()
        .map(|kind| json!({"system": {"kind": kind}}))
        .collect();
    bases.extend(in_dimensions);
    bases.extend([
        json!({"system": {"kind": "fuzz_button"}, "model": {"dimension": "ring"}, "cycles": 10}),
        json!({"system": {"kind": "fuzz_button"}, "model": {"preset": "source_extruded"}, "cycles": 10}),
        json!({"system": {"kind": "sd_card"}, "materials": {"slider": "phosphor_bronze", "receptacle": "brass"}}),
        json!({"system": {"kind": "sd_card"}, "plating": {"slider": [], "receptacle": []},
            "interface": {"wear": {"receptacle": {"law": "rhee", "wear_factor": 2e-9, "pressure_exponent": 1.2, "speed_exponent": 0.8,
                "time_exponent": 0.9}}}}),
        json!({"system": {"kind": "sd_card"}, "motion": {"kind": "insertion", "wipe_mm": 1.5}}),
        json!({"system": {"kind": "dimm"}, "motion": {"kind": "thermal_cycle", "delta_t_k": 60, "length_mm": 67,
            "expansion_mismatch_per_k": 6e-6}}),
        json!({"system": {"kind": "sd_card"}, "mission": [
            {"name": "days", "motion": {"kind": "reciprocating", "amplitude_mm": 0.02}, "cycles": 100},
            {"name": "matings", "motion": {"kind": "insertion", "wipe_mm": 1.5}, "cycles": 5}], "repeat": 4}),
        json!({"system": {"kind": "sd_card"}, "stop": [{"kind": "base_metal"}], "life": {"coefficient_of_variation": 0.5, "contacts": 9},
            "environment": {"current_a": 0.1}}),
    ]);
    bases
}

fn resolved(base: &Value) -> Resolved {
    crate::spec::read(base.to_string().as_bytes())
        .unwrap_or_else(|refused| panic!("{base}: {refused:?}"))
}

/// A resolved specification as it is written, without where its values are from.
fn document(resolved: &Resolved) -> Value {
    let mut document = serde_json::to_value(&resolved.spec).expect("JSON");
    if let Value::Object(fields) = &mut document {
        fields.remove("provenance");
    }
    document
}

/// The values that are no objects or lists, by pointer.
fn leaves(value: &Value) -> BTreeMap<String, Value> {
    fn below(value: &Value, pointer: &str, found: &mut BTreeMap<String, Value>) {
        match value {
            Value::Object(fields) => {
                for (name, value) in fields {
                    below(value, &format!("{pointer}/{name}"), found);
                }
            }
            Value::Array(items) => {
                for (index, value) in items.iter().enumerate() {
                    below(value, &format!("{pointer}/{index}"), found);
                }
            }
            value => {
                found.insert(pointer.to_owned(), value.clone());
            }
        }
    }
    let mut found = BTreeMap::new();
    below(value, "", &mut found);
    found
}

fn changed(base: &Value, known: &Value, pointer: &str, value: Value) -> Result<Resolved, String> {
    let changes = Changes::from([(pointer.to_owned(), value)]);
    let varied = vary(base, known, &changes).map(|(_, resolved)| resolved);
    varied.map_err(|faults| format!("{faults:?}"))
}

#[test]
fn a_value_that_is_set_to_itself_changes_nothing() {
    let mut failures = Vec::new();
    for base in bases() {
        let resolved = resolved(&base);
        let known = document(&resolved);
        for (pointer, value) in leaves(&known) {
            let problem = match changed(&base, &known, &pointer, value.clone()) {
                Ok(same) if same.scene != resolved.scene => "another scene".to_owned(),
                Ok(same) if document(&same) != known => "another specification".to_owned(),
                Ok(_) => continue,
                Err(faults) => faults,
            };
            failures.push(format!("{base} {pointer} = {value}: {problem}"));
        }
    }
    assert!(
        failures.is_empty(),
        "{}:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// A value some 10 % away; nothing of what is no number, and of a number that selects what there is: a layer, and a second spot, which
/// needs the diameter of the cluster that it makes.
fn another(pointer: &str, value: &Value) -> Option<Value> {
    let number = value.as_f64()?;
    if pointer.ends_with("/layer") || pointer == "/interface/spots/count" {
        return None;
    }
    if pointer.starts_with("/output/snapshots") {
        return Some(json!(value.as_u64()? * 9 / 10));
    }
    // Layers lie symmetrically.
    if pointer == "/model/layers" {
        return Some(json!(value.as_u64()? + 2));
    }
    if value.is_u64() {
        return Some(json!(value.as_u64()? + (value.as_u64()? / 10).max(1)));
    }
    // Places move inwards: an end of the block has no neighbour outwards. Shares stay below 1.
    let is_bounded = |start: &&str| pointer.starts_with(*start);
    let factor = if ["/output/", "/life/reliability/"].iter().any(is_bounded) {
        0.9
    } else {
        1.1
    };
    Some(json!(number * factor))
}

fn follows(pointer: &str, of: &str) -> bool {
    let is_one =
        |(follower, leader): &(&str, &str)| pointer.starts_with(follower) && of.starts_with(leader);
    pointer == of || FOLLOW.iter().any(is_one)
}

#[test]
fn a_value_some_percent_away_is_accepted_and_changes_what_follows_it_alone() {
    let mut failures = Vec::new();
    for base in bases() {
        let known = document(&resolved(&base));
        let before = leaves(&known);
        for (pointer, value) in &before {
            let Some(other) = another(pointer, value) else {
                continue;
            };
            let after = match changed(&base, &known, pointer, other.clone()) {
                Ok(after) => leaves(&document(&after)),
                Err(faults) => {
                    failures.push(format!("{base} {pointer} = {other}: {faults}"));
                    continue;
                }
            };
            if after.get(pointer).and_then(Value::as_f64) != other.as_f64() {
                failures.push(format!(
                    "{base} {pointer} = {other}: it stays {:?}",
                    after.get(pointer)
                ));
            }
            let names = before.keys().chain(after.keys());
            let others = names
                .filter(|name| before.get(*name) != after.get(*name) && !follows(name, pointer));
            let others: Vec<_> = others.collect();
            if !others.is_empty() {
                failures.push(format!("{base} {pointer} = {other}: {others:?} change"));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{}:\n{}",
        failures.len(),
        failures.join("\n")
    );
}
