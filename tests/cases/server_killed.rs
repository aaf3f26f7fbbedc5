//! Requirement: killing the server with SIGKILL during a job and restarting it completes the job.

use nix::sys::signal::Signal;
use tests::{Server, fuzz_button_with_jump};

#[tokio::test]
async fn a_job_is_completed_after_its_server_was_killed_and_restarted() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let (_, job) = server.submit(fuzz_button_with_jump(8)).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let under_way = |job: &serde_json::Value| job["progress"]["cycle"].as_u64() > Some(20);
    let before = server.job_when(&id, under_way).await;
    assert_eq!(before["status"], "running");
    server.signal(Signal::SIGKILL);
    assert_eq!(server.wait(), None);

    let server = Server::start(folder.path());
    let job = server
        .job_when(&id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(job["status"], "succeeded", "{job}");
    assert_eq!(job["attempts"], 2, "{job}");
    let (status, history) = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    assert_eq!(status, 200);
    let cycles: Vec<u64> = history["cycle"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(serde_json::Value::as_u64)
        .collect();
    assert!(
        cycles.windows(2).all(|w| w[0] < w[1]),
        "rows of both attempts are not mixed"
    );
    assert_eq!(cycles.last(), Some(&2000));
}

#[tokio::test]
async fn a_server_that_is_terminated_releases_its_job_without_using_an_attempt() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let (_, job) = server.submit(fuzz_button_with_jump(1)).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    server.job_when(&id, |job| job["status"] == "running").await;
    server.signal(Signal::SIGTERM);
    assert_eq!(server.wait(), Some(0));

    let server = Server::start(folder.path());
    let job = server.job_when(&id, |job| job["status"] == "running").await;
    assert_eq!(job["attempts"], 1, "{job}");
}

#[tokio::test]
async fn a_job_that_makes_progress_survives_more_kills_than_it_has_attempts() {
    const KILLS: u64 = 5;
    let folder = tempfile::tempdir().expect("a folder can be made");
    let options = ["--checkpoint-every-s", "0", "--attempts", "1"];
    let mut server = Server::start_with(folder.path(), &options);
    let (_, job) = server.submit(fuzz_button_with_jump(4)).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let mut done = 0;
    for _ in 0..KILLS {
        // Each attempt continues beyond what the former one had reported, with several checkpoints.
        let beyond = |job: &serde_json::Value| job["progress"]["cycle"].as_u64() > Some(done + 80);
        let job = server.job_when(&id, beyond).await;
        done = job["progress"]["cycle"].as_u64().unwrap_or(0);
        server.signal(Signal::SIGKILL);
        assert_eq!(server.wait(), None);
        server = Server::start_with(folder.path(), &options);
    }
    let job = server
        .job_when(&id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(job["status"], "succeeded", "{job}");
    assert_eq!(job["attempts"], KILLS + 1, "{job}");
}
