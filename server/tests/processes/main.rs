//! The binary as users run it: real servers, real solving processes, real kills.

mod replaced_program;
mod server;

use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::{Value, json};
use signal_hook::consts::SIGHUP;
use signal_hook::flag::register_conditional_default;
use tempfile::TempDir;

use server::{FRETWEAR, PASSWORD, POLL_INTERVAL, POLL_LIMIT, Server};

/// A specification with this number of computed cycles.
fn spec(cycles: u64) -> Value {
    json!({
        "system": {"kind": "fuzz_button"},
        "cycles": cycles,
        "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}},
        "output": {"snapshots_at_cycles": [1, cycles]}
    })
}

fn folder() -> TempDir {
    TempDir::new().expect("a temporary folder")
}

/// Returns the process ids of a server's solving processes, its children.
fn solving_processes(server: &Server) -> Vec<i32> {
    let id = server.child.id();
    let tasks = std::fs::read_dir(format!("/proc/{id}/task")).expect("a list of threads");
    let children =
        tasks.filter_map(|task| std::fs::read_to_string(task.ok()?.path().join("children")).ok());
    children
        .flat_map(|list| {
            list.split_whitespace()
                .filter_map(|id| id.parse().ok())
                .collect::<Vec<_>>()
        })
        .collect()
}

#[tokio::test]
async fn a_job_goes_from_submission_to_results() {
    let folder = folder();
    let server = Server::start(folder.path());
    let id = server.submit(&spec(3)).await;
    let job = server.until_ended(&id).await;
    assert_eq!(
        (&job["status"], &job["outcome"]),
        (&json!("succeeded"), &json!("completed")),
        "{job}"
    );
    assert_eq!(job["summary"]["cycles_done"], 3);
    let history = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    assert_eq!(history["cycle"], json!([0, 1, 2, 3]));
    let profile = server
        .get(&format!("/v1/jobs/{id}/results/profile?cycle=3"))
        .await;
    assert_eq!(profile["cycle"], 3);
    let url = format!("{}/v1/jobs/{id}/events", server.base);
    let stream = server
        .client
        .get(url)
        .send()
        .await
        .expect("a stream")
        .text()
        .await
        .expect("text");
    assert!(stream.starts_with("event: snapshot"), "{stream}");
    assert!(
        stream.contains("event: cycle") && stream.contains("event: done"),
        "{stream}"
    );
}

#[tokio::test]
async fn killing_the_server_loses_no_job() {
    let folder = folder();
    let server = Server::start(folder.path());
    let id = server.submit(&spec(500)).await;
    server.until_computing(&id).await;
    server.signal(Signal::SIGKILL);
    drop(server);
    let server = Server::start(folder.path());
    let job = server.until_ended(&id).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(2)),
        "{job}"
    );
    let history = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    let expected: Vec<u64> =
        (0..=job["summary"]["cycles_done"].as_u64().expect("a count")).collect();
    assert_eq!(history["cycle"], json!(expected));
}

#[tokio::test]
async fn a_killed_solving_process_is_tried_again() {
    let folder = folder();
    let server = Server::start(folder.path());
    let id = server.submit(&spec(500)).await;
    server.until_computing(&id).await;
    for process in solving_processes(&server) {
        kill(Pid::from_raw(process), Signal::SIGKILL).expect("a signal");
    }
    let job = server.until_ended(&id).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(2)),
        "{job}"
    );
}

#[tokio::test]
async fn solving_processes_get_no_secrets_and_end_with_a_killed_server() {
    let folder = folder();
    let server = Server::start(folder.path());
    let id = server.submit(&spec(1_000_000)).await;
    server.until_computing(&id).await;
    let processes = solving_processes(&server);
    assert_eq!(processes.len(), 1);
    let variables = |id| std::fs::read_to_string(format!("/proc/{id}/environ")).expect("text");
    let own = variables(i32::try_from(server.child.id()).expect("an id"));
    assert!(own.contains(PASSWORD));
    let inherited = variables(processes[0]);
    assert!(
        !inherited.contains(PASSWORD) && inherited.contains("RUST_LOG"),
        "{inherited}"
    );
    server.signal(Signal::SIGKILL);
    drop(server);
    let alive = || processes.iter().any(|id| is_running(*id));
    for _ in 0..POLL_LIMIT {
        if !alive() {
            return;
        }
        tokio::time::sleep(POLL_INTERVAL).await;
    }
    panic!("a solving process outlives its server");
}

/// Checks whether a process is running; a zombie is not.
fn is_running(id: i32) -> bool {
    std::fs::read_to_string(format!("/proc/{id}/stat")).is_ok_and(|stat| {
        stat.rsplit(')')
            .next()
            .is_some_and(|rest| !rest.trim_start().starts_with('Z'))
    })
}

#[tokio::test]
async fn a_cancelled_job_keeps_its_results() {
    let folder = folder();
    let server = Server::start(folder.path());
    let id = server.submit(&spec(1_000_000)).await;
    server.until_computing(&id).await;
    server
        .post(&format!("/v1/jobs/{id}/cancel"), &json!(null))
        .await;
    let job = server.until_ended(&id).await;
    assert_eq!(job["status"], "cancelled");
    let history = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    assert!(history["cycle"].as_array().expect("a list").len() > 1);
    assert_eq!(solving_processes(&server), Vec::<i32>::new());
}

#[tokio::test]
async fn a_graceful_stop_costs_no_attempt_and_ends_open_streams() {
    let folder = folder();
    let mut server = Server::start(folder.path());
    let id = server.submit(&spec(1_000_000)).await;
    server.until_computing(&id).await;
    let url = format!("{}/v1/jobs/{id}/events", server.base);
    let stream = server.client.get(url).send().await.expect("a stream");
    server.signal(Signal::SIGTERM);
    assert!(!stream.text().await.expect("an end").contains("event: done"));
    assert!(server.child.wait().expect("an end").success());
    drop(server);
    let server = Server::start(folder.path());
    let job = server.until_computing(&id).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("running"), &json!(1)),
        "{job}"
    );
}

#[tokio::test]
async fn a_service_that_still_waits_for_its_database_ends_at_a_signal() {
    let silent = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = silent.local_addr().expect("an address");
    let folder = folder();
    let mut service = Command::new(FRETWEAR)
        .args(["serve", "--listen", "127.0.0.1:0", "--database"])
        .arg(format!("postgres://nobody@{address}/none"))
        .current_dir(folder.path())
        .spawn()
        .expect("a service");
    let _connection = silent.accept().expect("a connection");
    let id = i32::try_from(service.id()).expect("a process id");
    kill(Pid::from_raw(id), Signal::SIGTERM).expect("a signal");
    assert!(service.wait().expect("an end").success());
}

#[tokio::test]
async fn a_hangup_ends_a_service_as_a_request_to_terminate_does_unless_it_is_ignored() {
    let folder = folder();
    // The default of SIGHUP for this process and those that it starts (execve(2)), also where the tests were started with it ignored.
    let always = Arc::new(AtomicBool::new(true));
    register_conditional_default(SIGHUP, always).expect("a handler");
    let mut server = Server::start(folder.path());
    let id = server.submit(&spec(1_000_000)).await;
    server.until_computing(&id).await;
    server.signal(Signal::SIGHUP);
    assert!(server.child.wait().expect("an end").success());
    drop(server);
    let mut command = Command::new("nohup");
    command.arg(FRETWEAR).stdout(Stdio::null());
    let mut server = Server::start_command(command, folder.path());
    let job = server.until_computing(&id).await;
    assert_eq!(job["attempts"], 1, "{job}");
    server.signal(Signal::SIGHUP);
    // The second signal is handled after the first one.
    server
        .until(&id, |later| {
            later["progress"]["cycle"].as_u64() > job["progress"]["cycle"].as_u64()
        })
        .await;
    server.signal(Signal::SIGTERM);
    assert!(server.child.wait().expect("an end").success());
}
