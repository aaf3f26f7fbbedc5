//! Examples of bodies of requests, each of which a test sends, and the path of all examples in the document.

use serde_json::{Value, json};

/// Path of the examples in the document.
pub(super) const EXAMPLES: &str = "#/components/examples/";

/// Adds an example to the body of a request.
pub(super) fn complete(path: &str, operation: &mut Value) {
    if let (Some(body), Some(example)) = (
        operation
            .get_mut("requestBody")
            .and_then(|body| body["content"].get_mut("application/json")),
        example(path),
    ) {
        body["example"] = example;
    }
}

/// Example of the body of an operation with one.
fn example(path: &str) -> Option<Value> {
    let base = json!({
        "system": {"kind": "sd_card"},
        "load": {"kind": "force", "n": 0.5},
        "cycles": 20000,
        "accuracy": {"preset": "draft"}
    });
    let thicknesses = json!({"/plating/slider/0/thickness_um": [0.4, 0.76, 1.3]});
    match path {
        "/v1/jobs" | "/v1/plans" => Some(base),
        "/v1/sweeps" | "/v1/sweeps/plans" => {
            Some(json!({"name": "gold of the tip", "base": base, "grid": thicknesses}))
        }
        "/v1/studies" => Some(json!({"base": base, "budget_s": 60})),
        "/v1/worker-tokens" => Some(json!({"name": "cluster"})),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::http::openapi::document;
    use crate::http::tests::Service;

    #[tokio::test]
    async fn every_body_has_an_example_that_is_accepted() {
        let service = Service::new().await;
        let mut count = 0;
        let paths = document()["paths"].as_object().expect("paths");
        for (path, methods) in paths {
            let body = &methods["post"]["requestBody"]["content"]["application/json"];
            if body.is_object() {
                let (status, _, answer) = service.post(path, &body["example"].to_string()).await;
                assert!(status.is_success(), "{path}: {answer}");
                count += 1;
            }
        }
        assert_eq!(count, 6);
    }
}
