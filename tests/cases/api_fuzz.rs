//! Requirement: requests generated from the OpenAPI document, valid and malformed, are never answered with a 5xx, with
//! a status that the document does not name, or with a body that it does not describe; what the document forbids is
//! refused, and what it allows is accepted. The requests come from schemathesis, an independent program that reads the
//! document.
//!
//! Ids are generated too, so most requests name jobs that do not exist; a second run requests a job that has ended, whose
//! event stream therefore ends.

use std::path::Path;
use std::process::Command;

use serde_json::json;
use tests::Server;

/// Checks of every answer.
const CHECKS: &str = "all";
/// Answers to requests that the document allows, beside those of success and of missing jobs: a specification may have fields
/// that contradict each other, a page token may be of another list, a column may have no such name, a range may lie beyond the file.
const EXPECTED: &str = r#"
[[operations]]
include-method = "POST"
exclude-name = "POST /v1/jobs/retry"
checks.positive_data_acceptance.expected-statuses = ["2xx", "404", "409", "422"]

[[operations]]
include-name = ["GET /v1/jobs", "POST /v1/jobs/retry", "GET /v1/sweeps", "GET /v1/studies", "GET /v1/histories"]
checks.positive_data_acceptance.expected-statuses = ["2xx", "400"]

[[operations]]
include-name = "GET /v1/jobs/{id}/results/files/{name}"
checks.positive_data_acceptance.expected-statuses = ["2xx", "304", "404", "416"]
"#;

/// A stream that has no end: each request would wait for its time limit.
const ENDLESS: &str = "/v1/events";

/// Which requests are sent.
#[derive(Clone, Copy)]
struct Requests {
    /// Values at the limits of each field and parameter (`coverage`), random ones (`fuzzing`), or both.
    phases: &'static str,
    /// Random ones of an operation, at most.
    random: &'static str,
}

/// Sends requests to every chosen operation.
fn fuzzed(server: &Server, folder: &Path, requests: Requests, chosen: &[&str]) {
    let output = Command::new(env!("FRETWEAR_PYTHON"))
        .args(["-m", "schemathesis.cli", "run"])
        .arg(format!("{}/openapi.json", server.base))
        .args(["--checks", CHECKS])
        .args(["--phases", requests.phases, "--seed", "7"])
        .args(["--max-examples", requests.random])
        .args(["--exclude-path", ENDLESS])
        // A request may wait for a job for 60 s.
        .args([
            "--request-timeout",
            "90",
            "--max-response-time",
            "90",
            "--no-color",
        ])
        .args(chosen)
        .current_dir(folder)
        .output()
        .expect("schemathesis can be started");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{text}");
    let operations = |name: &str| -> u32 {
        let (_, after) = text.split_once(name).expect("a number of operations");
        let mut numbers = after.split(|c: char| !c.is_ascii_digit());
        let number = numbers.find(|number| !number.is_empty());
        number
            .and_then(|number| number.parse().ok())
            .expect("a number")
    };
    assert_eq!(operations("Tested:"), operations("Selected:"), "{text}");
}

fn configured(folder: &Path, more: &str) {
    let config = format!("{more}\n[reports]\ndirectory = \"reports\"\n{EXPECTED}");
    std::fs::write(folder.join("schemathesis.toml"), config).expect("a file can be written");
}

/// Requests of all operations, then of those about one job.
async fn every_answer_conforms([all, of_a_job]: [Requests; 2]) {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    configured(folder.path(), "");
    fuzzed(&server, folder.path(), all, &[]);

    let spec = json!({
        "system": {"kind": "fuzz_button"}, "cycles": 2,
        "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}}
    });
    let (_, job) = server.submit(spec.to_string()).await;
    let id = job["id"].as_str().expect("a job has an id");
    let ended = |job: &serde_json::Value| job["finished_at"].is_string();
    server.job_when(id, ended).await;
    let known = format!("[parameters]\n\"path.id\" = \"{id}\"\n\"path.name\" = \"summary.json\"\n");
    configured(folder.path(), &known);
    let about_the_job = [
        "--include-path-regex",
        "^/v1/jobs/",
        "--include-method",
        "GET",
    ];
    fuzzed(&server, folder.path(), of_a_job, &about_the_job);
    // On a new connection: the service may be closing the idle one.
    let alive = reqwest::get(format!("{}/healthz", server.base)).await;
    assert_eq!(alive.expect("the service answers").status(), 200);
}

#[tokio::test]
#[cfg_attr(
    not(has_schemathesis),
    ignore = "needs the Python package schemathesis"
)]
async fn every_answer_to_a_generated_request_conforms_to_the_openapi_document() {
    let all = Requests {
        phases: "fuzzing",
        random: "3",
    };
    let of_a_job = Requests {
        phases: "coverage,fuzzing",
        ..all
    };
    every_answer_conforms([all, of_a_job]).await;
}

mod long {
    use super::{Requests, every_answer_conforms};

    #[tokio::test]
    #[ignore = "long: takes 100 s; needs the Python package schemathesis"]
    async fn every_answer_to_many_requests_conforms_to_the_openapi_document() {
        let all = Requests {
            phases: "coverage,fuzzing",
            random: "20",
        };
        every_answer_conforms([all; 2]).await;
    }
}
