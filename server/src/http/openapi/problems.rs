//! Problem types of each response: clients that are generated from the document know which ones an operation has.

use serde_json::{Map, Value, json};

use super::examples::EXAMPLES;
use crate::http::problem::{MEDIA_TYPE, ProblemType};

/// Names of the problem types whose resource a path has to name.
const OF_RESOURCES: [(&str, &[&str]); 7] = [
    ("/v1/jobs/", &["no-such-job"]),
    ("/v1/sweeps/", &["no-such-sweep", "sweep-active"]),
    ("/v1/studies/", &["no-such-study", "study-active"]),
    ("/v1/worker-tokens/", &["no-such-token"]),
    ("/v1/workers/", &["no-such-worker"]),
    ("/v1/systems/", &["no-such-system"]),
    ("/problems/", &["no-such-path"]),
];

/// The operation that solves a job again.
const RETRY_OF_JOB: &str = "/v1/jobs/{id}/retry";

/// Types of requests of the protocol between workers and service, which the document does not describe.
const OF_WORKERS: [&str; 4] = [
    "worker-version",
    "worker-drained",
    "lease-lost",
    "file-differs",
];

/// Adds a reference to the example of each problem type that a response can have.
pub(super) fn complete(path: &str, method: &str, operation: &mut Value) {
    let has_body = operation["requestBody"].is_object();
    let responses = operation["responses"].as_object_mut();
    for (status, response) in responses.into_iter().flatten() {
        let Some(content) = response
            .get_mut("content")
            .and_then(|content| content.get_mut(MEDIA_TYPE))
        else {
            continue;
        };
        let types = ProblemType::ALL.iter().filter(|problem| {
            problem.status.to_string() == *status
                && is_possible(problem.name, path, method, has_body)
        });
        let reference = |problem: &ProblemType| {
            let reference = format!("{EXAMPLES}{}", problem.name);
            (problem.name.to_owned(), json!({"$ref": reference}))
        };
        let examples: Map<String, Value> = types.map(reference).collect();
        content["examples"] = examples.into();
    }
}

/// An example of each problem type, by its name.
pub(super) fn examples() -> Map<String, Value> {
    ProblemType::ALL.iter().map(example).collect()
}

fn example(problem: &ProblemType) -> (String, Value) {
    let ProblemType {
        status,
        name,
        title,
        ..
    } = problem;
    let document = json!({"type": format!("/problems/{name}"), "title": title, "status": status});
    (
        (*name).to_owned(),
        json!({"summary": title, "value": document}),
    )
}

/// Returns `true` if an operation can end with a problem of a type, given its status.
fn is_possible(name: &str, path: &str, method: &str, has_body: bool) -> bool {
    if let Some((folder, _)) = OF_RESOURCES.iter().find(|(_, names)| names.contains(&name)) {
        return path.starts_with(folder);
    }
    let is_of_results = path.contains("/results");
    match name {
        // Only a job that has not succeeded is solved again, and only one that has ended is deleted or archived.
        "job-succeeded" => path == RETRY_OF_JOB,
        "job-active" => path.starts_with("/v1/jobs/") && path != RETRY_OF_JOB,
        "no-such-result" | "result-damaged" => {
            let ends = ["/base", "/picture", "/spec", "/table"];
            is_of_results || ends.iter().any(|end| path.ends_with(end))
        }
        "results-unreachable" => path.starts_with("/v1/"),
        "unreadable-body"
        | "invalid-idempotency-key"
        | "idempotency-key-reused"
        | "invalid-specification" => has_body,
        "disk-full" => method != "get" || path == "/readyz",
        "task-failing" | "workers-failing" => path == "/readyz",
        name => !OF_WORKERS.contains(&name),
    }
}

/// Checks that the document lists the problem of a response: `None` where it describes no such operation.
#[cfg(test)]
pub(in crate::http) fn is_listed(
    document: &Value,
    method: &str,
    path: &str,
    problem: &Value,
) -> Option<bool> {
    let path = path.split('?').next().unwrap_or_default();
    let paths = document["paths"].as_object()?;
    let matches = |template: &str| {
        let mut parts = template.split('/').zip(path.split('/'));
        template.matches('/').count() == path.matches('/').count()
            && parts.all(|(own, asked)| own.starts_with('{') || own == asked)
    };
    // A path without a parameter comes before one with: /v1/sweeps/plans, /v1/sweeps/{id}.
    let mut found: Vec<_> = paths.iter().filter(|(path, _)| matches(path)).collect();
    found.sort_by_key(|(path, _)| path.matches('{').count());
    let (_, methods) = found.first()?;
    let operation = methods.get(method.to_lowercase())?;
    let response = &operation["responses"][problem["status"].to_string()];
    let name = problem["type"].as_str()?.strip_prefix("/problems/")?;
    Some(response["content"][MEDIA_TYPE]["examples"][name].is_object())
}
