//! Requirement: a worker that was stopped beyond its lease writes nothing when it continues.

use std::time::Duration;

use nix::sys::signal::Signal;
use serde_json::json;
use tests::{Server, bare_preset, bits, database, merged};

/// One process serves a database, so no other can take over from a stopped one. If the lock is lost, as on a file
/// system without locks, the lease number must separate the two.
#[tokio::test]
async fn a_service_that_continues_after_another_finished_its_job_writes_nothing() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let options = ["--lease-s", "1", "--checkpoint-every-s", "0"];
    let stopped = Server::start_with(folder.path(), &options);
    let spec = merged(
        bare_preset("fuzz_button"),
        json!({
            "cycles": 600,
            "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}}
        }),
    );
    let (_, job) = stopped.submit(spec.to_string()).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    stopped
        .job_when(&id, |job| job["progress"]["cycle"].as_u64() > Some(10))
        .await;
    stopped.signal(Signal::SIGSTOP);
    std::fs::remove_file(folder.path().join("fretwear.db.lock")).expect("there is a lock file");

    let server = Server::start_with(folder.path(), &options);
    let ended = |job: &serde_json::Value| job["finished_at"].is_string();
    let job = server.job_when(&id, ended).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(2)),
        "{job}"
    );
    let before = bits::of(&server, &id).await;
    let events = "SELECT count(*) FROM events";
    let count = database::number(folder.path(), events).await;

    stopped.signal(Signal::SIGCONT);
    // The solving process may continue to its end, and the service tries to write the results, until it finds that the
    // database has another owner.
    assert_eq!(stopped.wait(), Some(1), "it gives the database up");
    assert_eq!(bits::of(&server, &id).await, before);
    assert_eq!(database::number(folder.path(), events).await, count);
    let done = bits::events(&server, &id, "done").await;
    assert_eq!(done.len(), 1);
}

#[tokio::test]
async fn a_service_that_was_paused_beyond_its_leases_continues_its_jobs() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--lease-s", "4"]);
    let spec = merged(
        bare_preset("fuzz_button"),
        json!({
            "cycles": 1000,
            "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}}
        }),
    );
    let (_, job) = server.submit(spec.to_string()).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    server
        .job_when(&id, |job| job["progress"]["cycle"].as_u64() > Some(10))
        .await;
    server.signal(Signal::SIGSTOP);
    tokio::time::sleep(Duration::from_secs(6)).await;
    server.signal(Signal::SIGCONT);
    let job = server
        .job_when(&id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
}
