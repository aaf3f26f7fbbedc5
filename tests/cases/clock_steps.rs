//! Requirement: a step of the system's clock, forwards or backwards, while the service runs, just before it is killed or while it is
//! down, ends no job before its deadline, delays no deadline, and costs no attempt.

use std::path::Path;

use nix::sys::signal::Signal;
use serde_json::{Value, json};
use tests::{Server, SteppedClock};

const TWO_HOURS: i64 = 7_200;

fn started(folder: &Path, clock: &SteppedClock) -> Server {
    Server::start_in(folder, &["--checkpoint-every-s", "1"], &clock.environment())
}

/// Submits a job of many cycles with a deadline, s; returns its id.
async fn submitted(server: &Server, deadline_s: u32) -> String {
    let spec = json!({
        "system": {"kind": "cylinder_on_flat"}, "cycles": 1_000_000,
        "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}}
    });
    let path = format!("{}/v1/jobs?deadline_s={deadline_s}", server.base);
    let request = server.client.post(path).body(spec.to_string());
    let request = request.header("content-type", "application/json");
    let answer = request.send().await.expect("an answer");
    let job: Value = answer.json().await.expect("JSON");
    job["id"].as_str().expect("a job has an id").to_owned()
}

/// Waits until a job has computed many more cycles.
async fn progress(server: &Server, id: &str) {
    let cycle = |job: &Value| job["progress"]["cycle"].as_u64().unwrap_or_default();
    let (_, now) = server.get(&format!("/v1/jobs/{id}")).await;
    let enough = cycle(&now) + 20;
    server.job_when(id, |job| cycle(job) >= enough).await;
}

/// Waits until a queued job has failed because its deadline passed.
async fn expired(server: &Server, id: &str) {
    let job = server
        .job_when(id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(job["outcome"], "deadline_exceeded", "{job}");
}

async fn status_and_attempts(server: &Server, id: &str) -> (Value, Value) {
    let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
    (job["status"].clone(), job["attempts"].clone())
}

#[tokio::test]
#[cfg_attr(not(has_cc), ignore = "needs a C compiler")]
async fn deadlines_leases_and_order_do_not_follow_steps_of_the_clock() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let clock = SteppedClock::new(folder.path());
    let server = started(folder.path(), &clock);
    let running = submitted(&server, 3_600).await;
    progress(&server, &running).await;
    let waiting = submitted(&server, 3_600).await;

    clock.set_to(TWO_HOURS);
    // The end of this job shows that deadlines were compared since.
    let short = submitted(&server, 1).await;
    expired(&server, &short).await;
    progress(&server, &running).await;
    assert_eq!(
        status_and_attempts(&server, &running).await,
        (json!("running"), json!(1))
    );
    assert_eq!(
        status_and_attempts(&server, &waiting).await,
        (json!("queued"), json!(0))
    );
    let (_, job) = server.get(&format!("/v1/jobs/{waiting}")).await;
    assert!(
        job["deadline_at"].as_str() > job["created_at"].as_str(),
        "{job}"
    );

    clock.set_to(-TWO_HOURS);
    let short = submitted(&server, 1).await;
    let (_, later) = server.get(&format!("/v1/jobs/{short}")).await;
    let is_stepped = later["created_at"].as_str() < job["created_at"].as_str();
    assert!(is_stepped, "the clock was not stepped: {later}");
    expired(&server, &short).await;
    progress(&server, &running).await;
    assert_eq!(
        status_and_attempts(&server, &running).await,
        (json!("running"), json!(1))
    );

    // The next services start with a clock that was stepped just before the end of the last one, and while there was none.
    clock.set_to(TWO_HOURS);
    server.signal(Signal::SIGKILL);
    server.wait();
    clock.set_to(-TWO_HOURS);
    let server = started(folder.path(), &clock);
    progress(&server, &running).await;
    clock.set_to(TWO_HOURS);
    server.signal(Signal::SIGTERM);
    assert_eq!(server.wait(), Some(0));
    let server = started(folder.path(), &clock);
    progress(&server, &running).await;
    let short = submitted(&server, 1).await;
    expired(&server, &short).await;
    assert_eq!(
        status_and_attempts(&server, &waiting).await,
        (json!("queued"), json!(0))
    );
    assert_eq!(
        status_and_attempts(&server, &running).await.0,
        json!("running")
    );
}
