//! Parameters of paths, queries and headers: which texts they accept.

use api::job::Status;
use serde_json::{Value, json};

/// Adds the accepted texts of the parameters of an operation.
pub(super) fn complete(parameters: &mut [Value]) {
    for parameter in parameters {
        let keywords = keywords(parameter["name"].as_str().unwrap_or_default());
        let Some(schema) = parameter["schema"].as_object_mut() else {
            continue;
        };
        // A parameter is absent instead of null.
        if let Some(Value::Array(types)) = schema.get("type")
            && let Some(given) = types.iter().find(|name| *name != "null").cloned()
        {
            schema.insert("type".to_owned(), given);
        }
        if let Some(Value::Object(keywords)) = keywords {
            schema.extend(keywords);
        }
    }
}

fn keywords(name: &str) -> Option<Value> {
    Some(match name {
        "status" => {
            let names = Status::ALL.map(Status::as_str).join("|");
            json!({"pattern": format!("^({names})(,({names}))*$")})
        }
        "label" => json!({"items": {"type": "string", "pattern": ":"}}),
        // Not the `int64` of the library.
        "cycle" => json!({"format": "uint64", "maximum": u64::MAX}),
        "created_from" | "created_before" => json!({"format": "date-time"}),
        // A digest of the filters, and a place in the list.
        "page_token" => json!({"pattern": "^[0-9a-f]{8}[0-9A-Za-z_-]+$"}),
        "wait" => {
            json!({"pattern": "^0*(([1-5]?[0-9]|60)s?|([1-5]?[0-9]{1,4}|60000)ms)$"})
        }
        "Idempotency-Key" => json!({"pattern": "^[!-~]([ -~]{0,253}[!-~])?$"}),
        _ => return None,
    })
}
