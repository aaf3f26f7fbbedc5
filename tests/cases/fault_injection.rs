//! Requirement: an interrupted job resumes from its last checkpoint and reaches the same bits; a damaged checkpoint is
//! detected; a stalled store uses no attempt; a job that exceeds its memory limit ends without affecting others.

use std::path::Path;
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use serde_json::{Value, json};
use tests::{Disk, MemoryGroup, Server, bare_preset, bits, database, merged};

/// Checkpoints after every computed cycle.
const EVERY_CYCLE: [&str; 2] = ["--checkpoint-every-s", "0"];

/// A job of so many computed cycles; interrupted ones have enough to be found running after a poll, also where other
/// programs occupy the processors.
fn spec(cycles: u64) -> Value {
    merged(
        bare_preset("fuzz_button"),
        json!({
            "cycles": cycles,
            "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}},
            "output": {"snapshots_at_cycles": [1, 20, cycles], "fields": true}
        }),
    )
}

async fn submitted(server: &Server, spec: &Value) -> String {
    let (status, job) = server.submit(spec.to_string()).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("a job has an id").to_owned()
}

async fn ended(server: &Server, id: &str) -> Value {
    server
        .job_when(id, |job| job["finished_at"].is_string())
        .await
}

async fn computing(server: &Server, id: &str, from: u64) {
    server
        .job_when(id, |job| job["progress"]["cycle"].as_u64() > Some(from))
        .await;
}

/// The bits of an uninterrupted run.
async fn uninterrupted(spec: &Value) -> Value {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let id = submitted(&server, spec).await;
    ended(&server, &id).await;
    bits::of(&server, &id).await
}

/// Runs a job that is interrupted by a signal to its service, with damage before the restart; returns its bits, the
/// job's attempts, and the cycles from which they started.
async fn interrupted(
    spec: &Value,
    signal: Signal,
    damage: impl AsyncFnOnce(&Path),
) -> (Value, Value, Vec<u64>) {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &EVERY_CYCLE);
    let id = submitted(&server, spec).await;
    computing(&server, &id, 25).await;
    server.signal(signal);
    server.wait();
    damage(folder.path()).await;
    let server = Server::start_with(folder.path(), &EVERY_CYCLE);
    let job = ended(&server, &id).await;
    let attempts = bits::events(&server, &id, "attempt").await;
    let began = attempts.iter().filter_map(|a| a["from_cycle"].as_u64());
    let began = began.collect();
    (bits::of(&server, &id).await, job["attempts"].clone(), began)
}

#[tokio::test]
async fn an_interrupted_job_reaches_the_bits_of_an_uninterrupted_one() {
    let spec = spec(300);
    let expected = uninterrupted(&spec).await;

    let (found, attempts, began) = interrupted(&spec, Signal::SIGKILL, async |_| {}).await;
    assert_eq!((&found, attempts), (&expected, json!(2)), "killed");
    assert!(began.len() == 2 && began[1] > 1, "{began:?}");

    let (found, attempts, began) = interrupted(&spec, Signal::SIGTERM, async |_| {}).await;
    assert_eq!((&found, attempts), (&expected, json!(1)), "asked to end");
    assert!(began.len() == 2 && began[1] > 1, "{began:?}");

    let (found, attempts, began) = interrupted(&spec, Signal::SIGKILL, async |folder| {
        assert_eq!(database::damage_checkpoints(folder).await, 1);
    })
    .await;
    assert_eq!((&found, attempts), (&expected, json!(2)), "damaged");
    assert_eq!(began, [0, 0]);
}

#[tokio::test]
async fn a_store_that_stalls_across_the_end_of_a_job_uses_no_attempt() {
    let spec = spec(40);
    let expected = uninterrupted(&spec).await;
    let folder = tempfile::tempdir().expect("a folder can be made");
    // The stall is longer than a lease, which is longer than a busy machine takes for a renewal.
    let server = Server::start_with(folder.path(), &["--lease-s", "4"]);
    let id = submitted(&server, &spec).await;
    computing(&server, &id, 5).await;
    database::stall(folder.path(), Duration::from_secs(10)).await;
    let job = ended(&server, &id).await;
    assert_eq!(job["attempts"], 1, "{job}");
    assert_eq!(bits::of(&server, &id).await, expected);
    let done = bits::events(&server, &id, "done").await;
    assert_eq!(done.len(), 1);
}

/// A job of elements so small, mm, that it needs much memory: 92 MB at 50 nm, 192 MB at 30 nm.
fn large(contact_element_mm: f64) -> Value {
    let fine = json!({
        "accuracy": {"preset": "fine", "overrides": {"contact_element_mm": contact_element_mm}}
    });
    merged(bare_preset("fuzz_button"), fine)
}

/// Checks that a job fails in its first attempt, with words in its reason, and that the next job is solved.
async fn out_of_memory_alone(server: &Server, large: &Value, words: &str) {
    let id = submitted(server, large).await;
    let job = ended(server, &id).await;
    assert_eq!(
        (&job["status"], &job["outcome"], &job["attempts"]),
        (&json!("failed"), &json!("out_of_memory"), &json!(1)),
        "{job}"
    );
    let reason = job["status_reason"].as_str().expect("a reason");
    assert!(reason.contains(words), "{reason}");
    let small = json!({"system": {"kind": "cylinder_on_flat"}, "cycles": 1, "accuracy": {"preset": "draft"}});
    let id = submitted(server, &small).await;
    assert_eq!(ended(server, &id).await["status"], "succeeded");
}

#[tokio::test]
async fn a_job_beyond_its_memory_limit_ends_alone_with_the_reason() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--job-memory-mb", "64"]);
    out_of_memory_alone(&server, &large(5e-5), "memory allocation of").await;
}

/// More memory than the service has, and less than the large job needs, bytes.
const GROUP_BYTES: u64 = 120_000_000;

#[tokio::test]
#[cfg_attr(
    not(has_memory_groups),
    ignore = "needs control groups with a memory limit, and to be root"
)]
async fn a_solve_that_the_kernel_kills_because_memory_runs_out_is_not_tried_again() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let group = MemoryGroup::with_limit(GROUP_BYTES).expect("a group");
    let server = Server::start(folder.path());
    // The service has seen the memory of the machine.
    let process = server.id().as_raw().unsigned_abs();
    group.add(process).expect("a process can be moved");
    out_of_memory_alone(&server, &large(3e-5), "killed by the kernel").await;
}

#[tokio::test]
async fn a_solve_that_exceeds_the_grace_time_is_killed_without_using_an_attempt() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let options = ["--checkpoint-every-s", "0", "--grace-s", "0.5"];
    let server = Server::start_with(folder.path(), &options);
    let spec = spec(300);
    let id = submitted(&server, &spec).await;
    computing(&server, &id, 10).await;
    for child in server.solving() {
        kill(child, Signal::SIGSTOP).expect("a solving process");
    }
    server.signal(Signal::SIGTERM);
    assert_eq!(server.wait(), Some(0));
    let server = Server::start_with(folder.path(), &options);
    let job = ended(&server, &id).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
}

#[tokio::test]
async fn a_job_that_waits_for_disk_space_states_the_reason() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--least-free-disk-mb", "1000000000"]);
    let id = submitted(&server, &spec(30)).await;
    let states_the_reason = |job: &Value| {
        let reason = job["status_reason"].as_str().unwrap_or_default();
        reason.starts_with("waiting for disk space: ")
    };
    let job = server.job_when(&id, states_the_reason).await;
    assert_eq!(job["status"], "queued", "{job}");
}

#[tokio::test]
async fn a_running_job_ends_at_its_deadline_and_retains_its_results() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let request = server
        .client
        .post(format!("{}/v1/jobs?deadline_s=2", server.base))
        .header("content-type", "application/json")
        .body(spec(1_000_000).to_string());
    let job: Value = request
        .send()
        .await
        .expect("an answer")
        .json()
        .await
        .expect("JSON");
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let job = ended(&server, &id).await;
    assert_eq!(
        (&job["status"], &job["outcome"]),
        (&json!("failed"), &json!("deadline_exceeded")),
        "{job}"
    );
    let (status, _) = server
        .get(&format!("/v1/jobs/{id}/results/profile?cycle=1"))
        .await;
    assert_eq!(status, 200);
}

#[tokio::test]
#[cfg_attr(not(has_mount), ignore = "needs the right to mount a disk")]
async fn a_disk_that_is_full_while_fields_are_written_uses_no_attempt() {
    let disk = Disk::new(256);
    let cycles: Vec<u64> = (1..=30).collect();
    let spec = merged(
        bare_preset("fuzz_button"),
        json!({
            "cycles": 30,
            "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}},
            "output": {"snapshots_at_cycles": cycles, "fields": true}
        }),
    );
    let expected = uninterrupted(&spec).await;
    let server = Server::start_with(disk.path(), &["--least-free-disk-mb", "0"]);
    let id = submitted(&server, &spec).await;
    computing(&server, &id, 2).await;
    disk.fill_for(Duration::from_secs(2)).await;
    let job = ended(&server, &id).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
    assert_eq!(bits::of(&server, &id).await, expected);
}
