//! JSON Schema of a specification with one contact system: the schema of all specifications, restricted to the
//! dimensions of this system.

use std::collections::BTreeSet;

use api::spec::SystemKind;
use serde_json::{Map, Value, json};

use crate::spec;

const COMPONENTS: &str = "#/components/schemas/";
const DEFINITIONS: &str = "#/$defs/";

/// Returns the JSON Schema of a specification with this contact system, from the OpenAPI document.
pub(crate) fn of(kind: SystemKind, document: &Value) -> Value {
    let components = &document["components"]["schemas"];
    let mut definitions = Map::new();
    let mut names = BTreeSet::new();
    let mut schema = component(components, "Spec", &mut names);
    while let Some(name) = names.pop_first() {
        if !definitions.contains_key(&name) {
            let definition = component(components, &name, &mut names);
            definitions.insert(name, definition);
        }
    }
    definitions.insert("System".to_owned(), system(kind, &components["System"]));
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!(format!("A job with a {} contact", kind.as_str()));
    schema["$defs"] = Value::Object(definitions);
    schema
}

/// A component of the OpenAPI document with local references; adds the names that it refers to. Objects have no
/// additional properties, because unknown fields are rejected.
fn component(components: &Value, name: &str, names: &mut BTreeSet<String>) -> Value {
    let mut schema = components[name].clone();
    make_local(&mut schema, names);
    schema
}

fn make_local(schema: &mut Value, names: &mut BTreeSet<String>) {
    match schema {
        Value::Object(fields) => {
            if let Some(Value::String(reference)) = fields.get_mut("$ref")
                && let Some(name) = reference.strip_prefix(COMPONENTS)
            {
                names.insert(name.to_owned());
                *reference = format!("{DEFINITIONS}{name}");
            }
            if fields.contains_key("properties") {
                fields.insert("additionalProperties".to_owned(), json!(false));
            }
            for field in fields.values_mut() {
                make_local(field, names);
            }
        }
        Value::Array(items) => {
            for item in items {
                make_local(item, names);
            }
        }
        _ => {}
    }
}

/// Schema of the system, restricted to a kind.
fn system(kind: SystemKind, all: &Value) -> Value {
    let mut properties = Map::new();
    properties.insert("kind".to_owned(), json!({"const": kind.as_str()}));
    for name in spec::system_definition(kind).dimension_names() {
        properties.insert(name.to_owned(), all["properties"][name].clone());
    }
    json!({
        "type": "object",
        "description": all["description"],
        "required": ["kind"],
        "properties": properties,
        "additionalProperties": false
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::http::openapi::document;

    #[test]
    fn references_are_defined_and_only_own_dimensions_are_listed() {
        for kind in SystemKind::ALL {
            let schema = of(kind, document());
            let text = schema.to_string();
            assert!(!text.contains(COMPONENTS));
            for reference in text.split(DEFINITIONS).skip(1) {
                let name = reference.split('"').next().expect("a name");
                assert!(schema["$defs"][name].is_object(), "{name}");
            }
            assert_eq!(
                schema["$defs"]["System"]["properties"]["kind"]["const"],
                kind.as_str()
            );
        }
        let loads = &of(SystemKind::Dimm, document())["$defs"]["LoadKind"]["enum"];
        assert_eq!(loads, &json!(["pressure", "line_force", "force"]));
        let dimm = &of(SystemKind::Dimm, document())["$defs"]["System"]["properties"];
        assert_eq!(dimm["pad_length_mm"]["type"], json!(["number", "null"]));
        assert!(dimm["wire_diameter_mm"].is_null());
        let zif = &of(SystemKind::Zif, document())["$defs"]["System"]["properties"];
        assert!(
            zif["pin_radius_mm"].is_object(),
            "optional dimensions are listed too"
        );
    }
}
