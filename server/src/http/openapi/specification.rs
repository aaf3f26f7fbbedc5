//! Schemas of what clients submit: the limits of their fields, and no fields but these.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use crate::spec::schema;

/// Schemas of the bodies of requests.
const BODIES: [&str; 3] = ["Spec", "StudyRequest", "SweepRequest"];
const COMPONENTS: &str = "#/components/schemas/";

/// Adds them to the schemas of the document.
pub(super) fn complete(schemas: &mut Value) {
    for name in submitted(schemas) {
        if schemas[&name]["properties"].is_object() {
            schemas[&name]["additionalProperties"] = json!(false);
        }
    }
    for entry in schema::keywords() {
        let property = &mut schemas[entry.object]["properties"][entry.field];
        if let (Value::Object(property), Value::Object(keywords)) = (property, entry.values) {
            property.extend(keywords);
        }
    }
    schemas["Stop"]["anyOf"] = json!([{"required": ["worn_depth_mm"]}, {"required": ["kind"]}]);
    require(
        &mut schemas["MaterialProperties"],
        &["youngs_modulus_mpa", "poisson_ratio"],
    );
    let materials = schemas["Material"]["oneOf"].as_array_mut();
    for variant in materials.into_iter().flatten() {
        if variant["type"] == "string" {
            variant["enum"] = json!(schema::material_names());
        }
    }
}

/// Requires numbers of an object.
fn require(schema: &mut Value, fields: &[&str]) {
    schema["required"] = json!(fields);
    for field in fields {
        schema["properties"][field]["type"] = json!("number");
    }
}

/// Names of the schemas that bodies of requests refer to.
fn submitted(schemas: &Value) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut left: Vec<String> = BODIES.map(str::to_owned).to_vec();
    while let Some(name) = left.pop() {
        if found.insert(name.clone()) {
            add_references(&schemas[&name], &mut left);
        }
    }
    found
}

fn add_references(schema: &Value, names: &mut Vec<String>) {
    match schema {
        Value::Object(fields) => {
            let reference = fields.get("$ref").and_then(Value::as_str);
            let name = reference.and_then(|reference| reference.strip_prefix(COMPONENTS));
            names.extend(name.map(str::to_owned));
            fields
                .values()
                .for_each(|field| add_references(field, names));
        }
        Value::Array(items) => items.iter().for_each(|item| add_references(item, names)),
        _ => {}
    }
}
