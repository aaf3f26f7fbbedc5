//! A service whose tasks are killed.

use std::os::unix::fs::PermissionsExt;
use std::time::Duration;

use serde_json::Value;
use tempfile::TempDir;

use super::*;

/// Longest wait; not a measure of speed.
const TEST_TIMEOUT: Duration = Duration::from_mins(1);
/// Number of workers.
const WORKERS: usize = 2;

/// A service whose solving processes fail at once, which a worker must notice.
async fn service(folder: &TempDir) -> Service {
    let program = folder.path().join("program");
    std::fs::write(
        &program,
        "#!/bin/sh\necho '{\"event\":\"ready\"}'\nexit 3\n",
    )
    .expect("a script");
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).expect("a program");
    let config = Config {
        listen: SocketAddr::from(([127, 0, 0, 1], 0)),
        access: Access::default(),
        tls: None,
        files: folder.path().join("test"),
        database: format!("sqlite://{}", folder.path().join("test.db").display()),
        objects: None,
        workers: WORKERS,
        limits: Limits {
            attempts: 1,
            least_free_disk_mb: 0,
        },
        keep_days: None,
        jobs_ahead: 10,
        worker: WorkerConfig::new(program),
    };
    Service::start(config).await.expect("a service")
}

/// Repeats a request until its answer satisfies a condition; the listener may be between two starts.
async fn until(
    request: impl Fn() -> reqwest::RequestBuilder,
    condition: impl Fn(u16, &Value) -> bool,
) -> Value {
    let polled = async {
        loop {
            if let Ok(answer) = request().send().await {
                let status = answer.status().as_u16();
                let document = answer.json().await.unwrap_or_default();
                if condition(status, &document) {
                    return document;
                }
            }
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    tokio::time::timeout(TEST_TIMEOUT, polled)
        .await
        .expect("the condition is met in time")
}

#[tokio::test]
async fn a_service_works_after_each_of_its_tasks_was_killed() {
    let folder = TempDir::new().expect("a temporary folder");
    let service = service(&folder).await;
    let client = reqwest::Client::new();
    let url = |path: &str| format!("http://{}{path}", service.address);
    let get = |path: &str| client.get(url(path));
    let mut tasks = vec![
        ("batch endings", 0),
        ("expansions", 0),
        ("heartbeat", 0),
        ("listener", 0),
        ("maintenance", 0),
    ];
    tasks.extend((0..WORKERS).map(|number| ("worker", number)));
    tasks.push(("workers", 0));
    until(|| get("/readyz"), |status, _| status == 200).await;
    assert_eq!(service.supervisor.running(), tasks);
    for task in &tasks {
        assert!(service.supervisor.kill(*task), "{task:?} ran");
        let restarted = async {
            while service.supervisor.running() != tasks {
                tokio::time::sleep(Duration::from_millis(20)).await;
            }
        };
        tokio::time::timeout(TEST_TIMEOUT, restarted)
            .await
            .expect("it is restarted");
        let spec = r#"{"system":{"kind":"fuzz_button"}}"#;
        let submit = || {
            client
                .post(url("/v1/jobs"))
                .header("content-type", "application/json")
                .body(spec)
        };
        let job = until(submit, |status, _| status == 202).await;
        let path = format!("/v1/jobs/{}", job["id"].as_str().expect("an id"));
        until(|| get(&path), |_, job| job["finished_at"].is_string()).await;
    }
    let metrics = get("/metrics").send().await.expect("an answer");
    let metrics = metrics.text().await.expect("text");
    for line in [
        "{task=\"listener\"} 1",
        "{task=\"maintenance\"} 1",
        "{task=\"worker\"} 2",
    ] {
        let line = format!("fretwear_task_failures_total{line}");
        assert!(
            metrics.lines().any(|found| found == line),
            "{line} in {metrics}"
        );
    }
    service.stop().await;
}

#[tokio::test]
async fn a_service_whose_task_fails_repeatedly_is_not_ready_and_names_it() {
    let folder = TempDir::new().expect("a temporary folder");
    let service = service(&folder).await;
    let client = reqwest::Client::new();
    let kill = async {
        loop {
            service.supervisor.kill(("worker", 0));
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    let url = format!("http://{}/readyz", service.address);
    let not_ready = until(|| client.get(&url), |status, _| status == 503);
    let problem = tokio::select! {
        problem = not_ready => problem,
        () = kill => return,
    };
    assert_eq!(problem["type"], "/problems/task-failing", "{problem}");
    assert_eq!(
        problem["detail"], "tasks: restarted repeatedly: worker",
        "{problem}"
    );
    service.stop().await;
}

#[test]
fn tokens_are_shown_where_an_address_beyond_loopback_is_not_encrypted() {
    let at = |address: &str| address.parse().expect("an address");
    for (address, is_encrypted, expected) in [
        ("0.0.0.0:80", false, true),
        ("[::]:80", false, true),
        ("10.0.0.1:80", false, true),
        ("0.0.0.0:80", true, false),
        ("127.0.0.1:80", false, false),
        ("[::1]:80", false, false),
    ] {
        assert_eq!(
            super::shows_token(at(address), is_encrypted),
            expected,
            "{address}"
        );
    }
}
