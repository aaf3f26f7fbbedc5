//! Requirement: while the data disk is full, jobs, readiness and problems say so, and a cancel request is accepted; once
//! there is space, the service continues by itself.

use serde_json::{Value, json};
use tests::{Disk, RemoteWorker, Server, fuzz_button_with_jump};

/// Size of the disk, MB.
const SIZE_MB: usize = 64;
const REASON: &str = "waiting for disk space: no space left on the data disk";

/// Fills the disk until the service has noticed it, also what it frees itself.
async fn fill(disk: &Disk, server: &Server) {
    loop {
        disk.fill();
        let (status, problem) = server.get("/readyz").await;
        if problem["type"] == "/problems/disk-full" {
            assert_eq!(status, 503);
            let detail = problem["detail"].as_str().expect("a detail");
            assert!(detail.starts_with("disk: no space left"), "{detail}");
            return;
        }
        assert_eq!(status, 200, "{problem}");
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    }
}

fn waits(job: &Value) -> bool {
    let reason = job["status_reason"].as_str().unwrap_or_default();
    reason.starts_with(REASON)
}

async fn submitted(server: &Server) -> String {
    let (status, job) = server.submit(fuzz_button_with_jump(1)).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("a job has an id").to_owned()
}

#[tokio::test]
#[cfg_attr(not(has_mount), ignore = "needs the right to mount a disk")]
async fn a_full_disk_is_named_and_does_not_prevent_cancelling() {
    let disk = Disk::new(SIZE_MB);
    let options = ["--workers", "1", "--least-free-disk-mb", "0"];
    let server = Server::start_with(disk.path(), &options);
    let jobs = [submitted(&server).await, submitted(&server).await];
    let [running, queued] = &jobs;
    server
        .job_when(running, |job| job["progress"]["cycle"].as_u64() > Some(1))
        .await;

    fill(&disk, &server).await;
    for id in &jobs {
        let job = server.job_when(id, waits).await;
        assert_ne!(job["finished_at"], json!(true), "{job}");
    }
    let (status, problem) = server.submit(fuzz_button_with_jump(1)).await;
    assert_eq!(
        (status, &problem["type"]),
        (503, &json!("/problems/disk-full"))
    );

    let (status, job) = server.post(&format!("/v1/jobs/{queued}/cancel")).await;
    assert_eq!(
        (status, &job["status"]),
        (202, &json!("cancelled")),
        "{job}"
    );
    let (status, job) = server.post(&format!("/v1/jobs/{running}/cancel")).await;
    assert_eq!(status, 202, "{job}");
    let job = server
        .job_when(running, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(job["status"], "cancelled", "{job}");
    // The space of the cancelled job can be freed.
    let path = format!("{}/v1/jobs/{running}", server.base);
    let deleted = server.client.delete(path).send().await;
    assert_eq!(deleted.expect("an answer").status(), 204);

    disk.free();
    let next = loop {
        let (status, job) = server.submit(fuzz_button_with_jump(1)).await;
        if status == 202 {
            break job["id"].as_str().expect("a job has an id").to_owned();
        }
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    };
    server
        .job_when(&next, |job| job["status"] == "running")
        .await;
    assert_eq!(server.get("/readyz").await.0, 200);
}

/// The disk is that of the worker: it is not waited for, because another worker may have one with space.
#[tokio::test]
#[cfg_attr(not(has_mount), ignore = "needs the right to mount a disk")]
async fn a_worker_whose_disk_is_full_gives_its_job_back_without_an_attempt() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let scratch = Disk::new(8);
    scratch.fill();
    let _worker = RemoteWorker::start(scratch.path(), &server.base, &[]);
    let spec = json!({
        "system": {"kind": "sd_card"}, "cycles": 2, "accuracy": {"preset": "draft"},
        "output": {"fields": true, "snapshots_at_cycles": [0, 2]}
    });
    let (status, job) = server.submit(spec.to_string()).await;
    assert_eq!(status, 202, "{job}");
    let id = job["id"].as_str().expect("an id");
    let is_given_back = |job: &Value| {
        let reason = job["status_reason"].as_str().unwrap_or_default();
        reason.contains("no disk space for its files")
    };
    let job = server.job_when(id, is_given_back).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("queued"), &json!(0)),
        "{job}"
    );
    scratch.free();
    let job = server
        .job_when(id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
}

#[tokio::test]
#[cfg_attr(not(has_mount), ignore = "needs the right to mount a disk")]
async fn a_service_starts_on_a_disk_that_is_full_to_the_last_byte_and_deletes_jobs() {
    let disk = Disk::new(SIZE_MB);
    let options = ["--workers", "0", "--least-free-disk-mb", "0"];
    let server = Server::start_with(disk.path(), &options);
    let id = submitted(&server).await;
    server.post(&format!("/v1/jobs/{id}/cancel")).await;
    server.signal(nix::sys::signal::Signal::SIGTERM);
    assert_eq!(server.wait(), Some(0));

    disk.fill();
    let server = Server::start_with(disk.path(), &options);
    let (_, problem) = server.get("/readyz").await;
    assert_eq!(problem["type"], "/problems/disk-full", "{problem}");
    let path = format!("{}/v1/jobs/{id}", server.base);
    let deleted = server.client.delete(path).send().await;
    assert_eq!(deleted.expect("an answer").status(), 204);
    assert_eq!(server.get(&format!("/v1/jobs/{id}")).await.0, 404);
}
