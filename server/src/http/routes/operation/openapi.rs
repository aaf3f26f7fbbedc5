//! `GET /openapi.json`: the interface described by itself, OpenAPI 3.1.
//!
//! `api/openapi.json` is the same document, committed, so that a change of the interface is seen as one. After a change
//! that is meant:
//!
//! ```text
//! cargo run --release -- openapi > api/openapi.json
//! ```

use std::sync::OnceLock;

use axum::http::header;
use axum::response::IntoResponse;
use serde_json::{Value, json};
use solver::record::{Channels, CycleReport, SideReport};

/// The document, made once.
pub fn document() -> &'static Value {
    static DOCUMENT: OnceLock<Value> = OnceLock::new();
    DOCUMENT.get_or_init(|| {
        // What derives from the types can be written; were it not so, the comparison below would fail.
        let mut document = serde_json::to_value(crate::http::described().1).unwrap_or_default();
        complete(&mut document);
        document
    })
}

/// The document as it is committed.
pub fn text() -> String {
    let mut text = serde_json::to_string_pretty(document()).unwrap_or_default();
    text.push('\n');
    text
}

/// This document.
#[utoipa::path(
    get,
    path = "/openapi.json",
    tag = "operation",
    responses((status = 200, description = "The document", content_type = "application/json"))
)]
pub(in crate::http) async fn openapi() -> impl IntoResponse {
    static TEXT: OnceLock<String> = OnceLock::new();
    let text = TEXT.get_or_init(text).as_str();
    ([(header::CONTENT_TYPE, "application/json")], text)
}

/// What holds for every operation: the token, and the problems that a request may meet before it reaches its route.
fn complete(document: &mut Value) {
    document["components"]["securitySchemes"]["token"] = json!({
        "type": "http",
        "scheme": "bearer",
        "description": "The service's access token; asked for wherever one is set"
    });
    document["security"] = json!([{}, {"token": []}]);
    let schemas = &mut document["components"]["schemas"];
    describe_channels::<CycleReport>(&mut schemas["WearHistory"]);
    describe_channels::<SideReport>(&mut schemas["SideSeries"]);
    let problem = |words: &str| {
        json!({
            "description": words,
            "content": {"application/problem+json": {"schema": {"$ref": "#/components/schemas/Problem"}}}
        })
    };
    let paths = document["paths"].as_object_mut();
    let operations = paths
        .into_iter()
        .flat_map(|paths| paths.values_mut())
        .filter_map(Value::as_object_mut)
        .flat_map(|methods| methods.values_mut());
    for operation in operations {
        let Some(responses) = operation["responses"].as_object_mut() else {
            continue;
        };
        for response in responses.values_mut() {
            problem_type(response);
        }
        for (status, words) in [
            ("401", "The access token is missing or wrong"),
            ("403", "The request was made for another host"),
            (
                "503",
                "The service has too much to do at present; `Retry-After` says when to come again",
            ),
        ] {
            let missing = || problem(words);
            responses.entry(status).or_insert_with(missing);
        }
    }
}

/// Adds the channels of a report of the engine, which `api` does not know, to the schema of their columns.
fn describe_channels<R: Channels>(schema: &mut Value) {
    let mut required = schema["required"].as_array().cloned().unwrap_or_default();
    for channel in R::CHANNELS {
        required.push(channel.name.into());
        schema["properties"][channel.name] = json!({
            "type": "array",
            "description": channel.description,
            "items": {"type": "number", "format": "double"}
        });
    }
    schema["required"] = required.into();
}

/// Problem documents have a media type of their own.
fn problem_type(response: &mut Value) {
    let content = response.get_mut("content").and_then(Value::as_object_mut);
    let Some(content) = content else {
        return;
    };
    let reference = &content.get("application/json").cloned().unwrap_or_default()["schema"]["$ref"];
    if reference == "#/components/schemas/Problem"
        && let Some(described) = content.remove("application/json")
    {
        content.insert("application/problem+json".to_owned(), described);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::http::tests::Service;

    #[test]
    fn the_committed_document_is_this_one() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../api/openapi.json");
        let committed = std::fs::read_to_string(path).expect("it is committed");
        assert!(
            committed == text(),
            "the interface has changed; if it was meant to: cargo run --release -- openapi > api/openapi.json"
        );
    }

    #[tokio::test]
    async fn the_interface_describes_itself() {
        let service = Service::new().await;
        let (status, headers, document) = service.get("/openapi.json").await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "application/json");
        assert_eq!(document["openapi"], "3.1.0");
        for path in [
            "/v1/jobs",
            "/v1/jobs/{id}/events",
            "/v1/sweeps/{id}/outcomes",
            "/healthz",
        ] {
            assert!(document["paths"][path].is_object(), "{path}");
        }
        let text = document.to_string();
        for reference in text.split("#/components/schemas/").skip(1) {
            let name = reference.split('"').next().expect("a name");
            assert!(
                document["components"]["schemas"][name].is_object(),
                "{name} is not described"
            );
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
