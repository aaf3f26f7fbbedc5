//! Examples of answers, as a service sends them (`tests/cases/example_answers.rs`): one for each schema, and the first lines of texts.

use std::sync::LazyLock;

use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::examples::EXAMPLES;

/// Path of the schemas in the document.
const SCHEMAS: &str = "#/components/schemas/";

#[derive(Default, Deserialize)]
struct Answers {
    schemas: Map<String, Value>,
    texts: Map<String, Value>,
}

// A file that cannot be read would leave the examples out, which the test below does not accept.
static ANSWERS: LazyLock<Answers> =
    LazyLock::new(|| serde_json::from_str(include_str!("answers.json")).unwrap_or_default());

/// The examples of all schemas, by their names.
pub(super) fn examples() -> impl Iterator<Item = (String, Value)> {
    let example = |(schema, value): (&String, &Value)| (schema.clone(), json!({"value": value}));
    ANSWERS.schemas.iter().map(example)
}

/// Adds the examples of the answers of an operation.
pub(super) fn complete(path: &str, operation: &mut Value) {
    let responses = operation["responses"].as_object_mut();
    for (status, response) in responses.into_iter().flatten() {
        let content = response.get_mut("content").and_then(Value::as_object_mut);
        for (media_type, content) in content.into_iter().flatten() {
            if status.starts_with('2') {
                complete_content(path, media_type, content);
            }
        }
    }
}

fn complete_content(path: &str, media_type: &str, content: &mut Value) {
    if media_type == "application/json" {
        let schema = content["schema"]["$ref"].as_str();
        let schema = schema.and_then(|schema| schema.strip_prefix(SCHEMAS));
        if let Some(schema) = schema.filter(|schema| ANSWERS.schemas.contains_key(*schema)) {
            let reference = format!("{EXAMPLES}{schema}");
            content["examples"] = json!({"answer": {"$ref": reference}});
        }
    } else if is_text(media_type)
        && let Some(text) = ANSWERS.texts.get(path)
    {
        content["example"] = text.clone();
    }
}

/// Returns `true` for the media types of which lines are shown.
fn is_text(media_type: &str) -> bool {
    [
        "text/csv",
        "text/event-stream",
        "application/openmetrics-text",
    ]
    .contains(&media_type)
}

#[cfg(test)]
mod tests {
    use super::is_text;
    use crate::http::openapi::tests::responses;

    #[test]
    fn every_answer_has_an_example() {
        let (mut count, mut missing) = (0, Vec::new());
        for (name, response) in responses() {
            let content = response["content"].as_object();
            let content = content.filter(|_| name.starts_with('2'));
            for (media_type, content) in content.into_iter().flatten() {
                let is_document = content["schema"]["$ref"].is_string();
                if is_document || is_text(media_type) {
                    count += 1;
                    if content["example"].is_null() && content["examples"].is_null() {
                        missing.push(format!("{name} {media_type}"));
                    }
                }
            }
        }
        assert!(missing.is_empty(), "{missing:#?}");
        assert!(count > 40, "{count}");
    }
}
