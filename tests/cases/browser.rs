//! Requirement: in a real browser the pages show jobs, one job and several beside each other, live and after a reload, by pointer and by keyboard;
//! nothing is loaded from another host, the content policy blocks nothing and no script fails.

mod accessibility;
mod accuracy;
mod comparison;
mod draft;
mod interface;
mod job;
mod jobs;
mod motion;
mod outage;
mod pages_cost;
mod pictures;
mod study;
mod sweeps;
mod workers;

use serde_json::{Value, json};
use tempfile::TempDir;
use tests::{Browser, Server};

/// A service and a browser for its pages, in a folder of their own, which must outlive them.
async fn service_and_browser() -> (TempDir, Server, Browser) {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let browser = Browser::start(&server.base, folder.path()).await;
    (folder, server, browser)
}

/// A job of some twenty cycles with two stored ones.
fn short(name: &str) -> Value {
    json!({
        "name": name, "system": {"kind": "cylinder_on_flat"}, "cycles": 20,
        "accuracy": {"preset": "draft"}, "output": {"snapshots_at_cycles": [1, 20]}
    })
}

/// A job that is not done before a test ends it.
fn long(name: &str) -> Value {
    json!({
        "name": name, "system": {"kind": "cylinder_on_flat"}, "cycles": 1_000_000,
        "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}}
    })
}

/// Submits a job and returns its id.
async fn submitted(server: &Server, spec: &Value) -> String {
    let (status, job) = server.submit(spec.to_string()).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("a job has an id").to_owned()
}

/// Submits a sweep or an accuracy study to its collection and returns its id.
async fn batch(server: &Server, collection: &str, request: &Value) -> String {
    let url = format!("{}/v1/{collection}", server.base);
    let answer = server.client.post(url).json(request).send().await;
    let batch: Value = answer.expect("an answer").json().await.expect("JSON");
    batch["id"].as_str().expect("it has an id").to_owned()
}

/// Submits a job and waits for its end.
async fn done(server: &Server, spec: &Value) -> String {
    let id = submitted(server, spec).await;
    let ended = |job: &Value| job["finished_at"].is_string();
    server.job_when(&id, ended).await;
    id
}

/// A job with the fields of two stored cycles.
fn with_fields(name: &str) -> Value {
    let mut spec = short(name);
    spec["output"]["fields"] = json!(true);
    spec
}

/// A job that fails after some cycles: its deadline passes.
async fn failed(server: &Server, name: &str) -> String {
    let (_, job) = server.post_json("/v1/jobs?deadline_s=2", &long(name)).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let ended = |job: &Value| job["status"] == "failed";
    server.job_when(&id, ended).await;
    id
}

/// Checks what every page must hold when a test has ended with it.
async fn is_sound(browser: &Browser) {
    assert_eq!(browser.complaints().await, Vec::<String>::new());
    assert_eq!(browser.other_hosts().await, Vec::<String>::new());
}

/// Checks that a page fits a phone, and takes its pictures for people to look at.
async fn fits_a_phone(browser: &Browser, name: &str) {
    browser.picture(name).await;
    browser.emulate(1400, "dark").await;
    browser.picture(&format!("{name}-dark")).await;
    browser.emulate(400, "light").await;
    let width =
        "document.documentElement.scrollWidth <= 400 && document.documentElement.scrollWidth";
    browser.wait_for(width).await;
    browser.picture(&format!("{name}-400")).await;
    browser.emulate(1400, "light").await;
}
