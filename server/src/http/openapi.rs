//! OpenAPI 3.1 document of the interface.
//!
//! `api/openapi.json` is the same document, committed, so that a diff shows every change of the interface. After an
//! intended change:
//!
//! ```text
//! cargo run --release -- openapi > api/openapi.json
//! ```

mod answers;
mod examples;
mod parameters;
pub(in crate::http) mod problems;
mod specification;

use std::sync::OnceLock;

use crate::http::problem::MEDIA_TYPE;
use serde_json::{Map, Value, json};
use solver::record::{Channels, CycleReport, ResistanceReport, SideReport, TemperatureReport};

/// Status and description of the problems of operations with a body, which is always a specification or contains one.
const BODY_PROBLEMS: [(&str, &str); 5] = [
    (
        "400",
        "The body, the `Idempotency-Key` or a query parameter is not valid.",
    ),
    ("408", "The body did not arrive in time."),
    ("413", "The body is too large."),
    ("415", "The body is not declared as JSON."),
    (
        "422",
        "The specification has faults, or the `Idempotency-Key` was used with another body.",
    ),
];
/// Problems of operations with a query.
const QUERY_PROBLEMS: [(&str, &str); 1] = [("400", "A query parameter is not valid")];
/// Problems of requests that do not reach their route.
const COMMON_PROBLEMS: [(&str, &str); 4] = [
    ("401", "The access token is missing or wrong"),
    (
        "403",
        "The request was sent for another host or from another origin",
    ),
    ("500", "An error of the service or of its machine"),
    (
        "503",
        "The service cannot take the request at present; `Retry-After` says when to send it again",
    ),
];

/// The document, built once.
pub fn document() -> &'static Value {
    static DOCUMENT: OnceLock<Value> = OnceLock::new();
    DOCUMENT.get_or_init(|| {
        // Cannot fail for types with derived schemas; if it did, the test below would.
        let mut document =
            serde_json::to_value(crate::http::table::routes_and_document().1).unwrap_or_default();
        complete(&mut document);
        document
    })
}

/// The document as text, as it is committed.
pub fn text() -> String {
    let mut text = serde_json::to_string_pretty(document()).unwrap_or_default();
    text.push('\n');
    text
}

/// Adds what operations share: the access token, the id in their path, and problems.
fn complete(document: &mut Value) {
    document["components"]["securitySchemes"]["token"] = json!({
        "type": "http",
        "scheme": "bearer",
        "description": "Access token of the service; required if one is configured"
    });
    let examples = problems::examples().into_iter().chain(answers::examples());
    document["components"]["examples"] = examples.collect::<Map<_, _>>().into();
    document["security"] = json!([{}, {"token": []}]);
    let schemas = &mut document["components"]["schemas"];
    specification::complete(schemas);
    describe_channels::<CycleReport>(&mut schemas["WearHistory"], true);
    describe_channels::<ResistanceReport>(&mut schemas["WearHistory"], false);
    describe_channels::<TemperatureReport>(&mut schemas["WearHistory"], false);
    describe_channels::<SideReport>(&mut schemas["SideSeries"], true);
    let paths = document["paths"].as_object_mut().into_iter().flatten();
    for (path, methods) in paths {
        for (method, operation) in methods.as_object_mut().into_iter().flatten() {
            complete_operation(identified(path), operation);
            problems::complete(path, method, operation);
            examples::complete(path, operation);
            answers::complete(path, operation);
        }
    }
}

/// Adds the parameter `id` of an operation whose path identifies a `noun`, and the problems that follow from its
/// parameters and body.
fn complete_operation(noun: Option<&str>, operation: &mut Value) {
    let mut parameters = operation["parameters"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    let has_query = parameters
        .iter()
        .any(|parameter| parameter["in"] == "query");
    let has_body = operation["requestBody"].is_object();
    if let Some(noun) = noun {
        let id = json!({
            "name": "id",
            "in": "path",
            "required": true,
            "description": format!("The {noun}"),
            "schema": {"type": "string", "format": "uuid"}
        });
        parameters.insert(0, id);
    }
    if !parameters.is_empty() {
        parameters::complete(&mut parameters);
        operation["parameters"] = parameters.into();
    }
    let Some(responses) = operation["responses"].as_object_mut() else {
        return;
    };
    responses.values_mut().for_each(set_problem_media_type);
    let mut add = |status: &str, description: &str| {
        responses.entry(status).or_insert_with(|| {
            json!({
                "description": description,
                "content": {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
            })
        });
    };
    if let Some(noun) = noun {
        add("404", &format!("No such {noun}"));
    }
    let groups = [
        (has_body, &BODY_PROBLEMS[..]),
        (has_query, &QUERY_PROBLEMS),
        (true, &COMMON_PROBLEMS),
    ];
    let groups = groups.into_iter().filter(|(applies, _)| *applies);
    for (status, description) in groups.flat_map(|(_, problems)| problems) {
        add(status, description);
    }
}

/// Noun of the resource that the id in a path identifies, if it has one.
fn identified(path: &str) -> Option<&'static str> {
    let nouns = [
        ("jobs", "job"),
        ("sweeps", "sweep"),
        ("studies", "study"),
        ("worker-tokens", "token"),
        ("workers", "worker"),
    ];
    let is_in = |collection| path.starts_with(&format!("/v1/{collection}/{{id}}"));
    nouns
        .into_iter()
        .find_map(|(collection, noun)| is_in(collection).then_some(noun))
}

/// Adds the channels of a report of the engine, which `api` does not know, to the schema of their columns. Those of a report that every
/// run has are always there.
fn describe_channels<R: Channels>(schema: &mut Value, is_always_there: bool) {
    let mut required = schema["required"].as_array().cloned().unwrap_or_default();
    for channel in R::CHANNELS {
        if is_always_there {
            required.push(channel.name.into());
        }
        schema["properties"][channel.name] = json!({
            "type": "array",
            "description": channel.description,
            "items": {"type": "number", "format": "double"}
        });
    }
    schema["required"] = required.into();
}

/// Sets the media type of problem documents.
fn set_problem_media_type(response: &mut Value) {
    let content = response.get_mut("content").and_then(Value::as_object_mut);
    let Some(content) = content else {
        return;
    };
    let reference = &content.get("application/json").cloned().unwrap_or_default()["schema"]["$ref"];
    if reference == "#/components/schemas/Problem"
        && let Some(body) = content.remove("application/json")
    {
        content.insert(MEDIA_TYPE.to_owned(), body);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All responses, named by status, method and path.
    pub(super) fn responses() -> Vec<(String, &'static Value)> {
        let mut found = Vec::new();
        for (path, methods) in document()["paths"].as_object().expect("paths") {
            for (method, operation) in methods.as_object().expect("methods") {
                for (status, response) in operation["responses"].as_object().expect("responses") {
                    found.push((format!("{status} {method} {path}"), response));
                }
            }
        }
        found
    }

    #[test]
    fn the_committed_document_is_up_to_date() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../api/openapi.json");
        let committed = std::fs::read_to_string(path).expect("it is committed");
        assert!(
            committed == text(),
            "the interface has changed; if that is intended: cargo run --release -- openapi > api/openapi.json"
        );
    }

    #[test]
    fn every_problem_of_every_operation_has_a_type() {
        for (name, response) in responses() {
            let content = &response["content"][MEDIA_TYPE];
            let examples = content["examples"].as_object();
            let is_typed = examples.is_some_and(|examples| !examples.is_empty());
            assert!(content.is_null() || is_typed, "{name}");
        }
    }

    #[test]
    fn every_problem_has_its_media_type() {
        let text = document().to_string();
        assert!(!text.contains(
            r##""application/json":{"schema":{"$ref":"#/components/schemas/Problem"}}"##
        ));
    }
}
