//! Requirement: with `--log json` every line of the log is a JSON object, and lines about a job carry one span with its
//! id, lease and attempt.

use std::collections::BTreeSet;
use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tests::program::binary;

/// Polls of the log before the test fails.
const POLLS: usize = 2_000;

#[tokio::test]
async fn every_line_is_an_object_and_a_job_has_one_span() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = folder.path().join("log");
    let log = std::fs::File::create(&path).expect("a file can be made");
    let mut server = Command::new(binary())
        .args([
            "serve",
            "--listen",
            "127.0.0.1:0",
            "--workers",
            "1",
            "--log",
            "json",
        ])
        .current_dir(folder.path())
        .env("RUST_LOG", "info")
        .stderr(Stdio::from(log))
        .spawn()
        .expect("the service can be started");
    let line_with = async |words: &str| {
        for _ in 0..POLLS {
            let text = std::fs::read_to_string(&path).expect("a log");
            if let Some(line) = text.lines().find(|line| line.contains(words)) {
                return line.to_owned();
            }
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
        panic!("nobody said {words}");
    };
    let line = line_with("service started").await;
    let line: Value = serde_json::from_str(&line).expect("JSON");
    let address = line["fields"]["address"].as_str().expect("an address");
    let base = format!("http://{address}");
    let spec = json!({"system": {"kind": "cylinder_on_flat"}, "cycles": 2, "accuracy": {"preset": "draft"}});
    let request = reqwest::Client::new().post(format!("{base}/v1/jobs"));
    let job: Value = request
        .json(&spec)
        .send()
        .await
        .expect("an answer")
        .json()
        .await
        .expect("a job");
    line_with("attempt ended").await;
    server.kill().expect("the service is there");
    server.wait().expect("it ends");

    let text = std::fs::read_to_string(&path).expect("a log");
    let lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|cause| panic!("{line}: {cause}")))
        .collect();
    let spans: BTreeSet<String> = lines
        .iter()
        .filter(|line| line["span"]["name"] == "job")
        .map(|line| line["span"].to_string())
        .collect();
    let mut spans: Vec<Value> = spans
        .iter()
        .map(|span| serde_json::from_str(span).expect("JSON"))
        .collect();
    let lease = spans[0]["lease"].take();
    assert!(lease.as_i64() > Some(0), "{text}");
    let span = json!({"name": "job", "id": job["id"], "lease": null, "attempt": 1});
    assert_eq!(spans, [span], "{text}");
    for words in ["job claimed", "attempt ended"] {
        let line = lines.iter().find(|line| line["fields"]["message"] == words);
        assert_eq!(line.expect("a line")["span"]["name"], "job");
    }
}
