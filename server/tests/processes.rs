//! The binary as users run it: real servers, real solving processes, real kills.

use std::io::{BufRead, BufReader};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::{Value, json};
use tempfile::TempDir;

const FRETWEAR: &str = env!("CARGO_BIN_EXE_fretwear");
/// Interval at which a job is polled.
const POLL_INTERVAL: Duration = Duration::from_millis(20);
/// A variable with a secret of the service.
const PASSWORD: &str = "PGPASSWORD";
/// Number of polls before a test fails.
const POLL_LIMIT: usize = 15_000;

/// A server with a database in a temporary folder; killed on drop.
struct Server {
    child: Child,
    base: String,
    client: reqwest::Client,
}

impl Server {
    fn start(folder: &Path) -> Self {
        Self::start_program(Path::new(FRETWEAR), folder)
    }

    fn start_program(program: &Path, folder: &Path) -> Self {
        Self::start_command(Command::new(program), folder)
    }

    fn start_command(mut command: Command, folder: &Path) -> Self {
        let mut child = command
            .args([
                "serve",
                "--listen",
                "127.0.0.1:0",
                "--workers",
                "1",
                "--database",
            ])
            .arg(format!("sqlite://{}", folder.join("test.db").display()))
            .env("RUST_LOG", "off")
            .env(PASSWORD, "secret")
            .stderr(Stdio::piped())
            .spawn()
            .expect("a server");
        let stderr = child.stderr.take().expect("a pipe");
        let line = BufReader::new(stderr)
            .lines()
            .next()
            .expect("a line")
            .expect("text");
        let base = line
            .split_whitespace()
            .last()
            .expect("an address")
            .to_owned();
        assert!(base.starts_with("http://127.0.0.1:"), "{line}");
        Self {
            child,
            base,
            client: reqwest::Client::new(),
        }
    }

    fn signal(&self, signal: Signal) {
        let id = i32::try_from(self.child.id()).expect("a process id");
        kill(Pid::from_raw(id), signal).expect("a signal");
    }

    async fn get(&self, path: &str) -> Value {
        let response = self
            .client
            .get(format!("{}{path}", self.base))
            .send()
            .await
            .expect("an answer");
        response.json().await.expect("JSON")
    }

    async fn post(&self, path: &str, body: &Value) -> Value {
        let response = self
            .client
            .post(format!("{}{path}", self.base))
            .json(body)
            .send()
            .await
            .expect("an answer");
        response.json().await.expect("JSON")
    }

    async fn submit(&self, spec: &Value) -> String {
        let job = self.post("/v1/jobs", spec).await;
        job["id"]
            .as_str()
            .unwrap_or_else(|| panic!("{job}"))
            .to_owned()
    }

    /// Polls a job until it satisfies a condition.
    async fn until(&self, id: &str, condition: impl Fn(&Value) -> bool) -> Value {
        for _ in 0..POLL_LIMIT {
            let job = self.get(&format!("/v1/jobs/{id}")).await;
            if condition(&job) {
                return job;
            }
            tokio::time::sleep(POLL_INTERVAL).await;
        }
        panic!(
            "the job never satisfied the condition: {}",
            self.get(&format!("/v1/jobs/{id}")).await
        );
    }

    async fn until_computing(&self, id: &str) -> Value {
        self.until(id, |job| {
            job["status"] != "queued" && job["progress"]["cycle"].as_u64() > Some(0)
        })
        .await
    }

    async fn until_ended(&self, id: &str) -> Value {
        self.until(id, |job| !job["finished_at"].is_null()).await
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have exited already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

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

/// Whether a process is running; a zombie is not.
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
async fn a_hangup_ends_a_service_as_a_request_to_terminate_does_unless_it_is_ignored() {
    let folder = folder();
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

/// A copy of the program in a folder, which may be changed.
fn copied_program(folder: &Path) -> PathBuf {
    let program = folder.join("fretwear");
    std::fs::copy(FRETWEAR, &program).expect("a copy");
    program
}

#[tokio::test]
async fn a_service_whose_program_is_replaced_solves_with_the_program_that_it_is() {
    let folder = folder();
    let program = copied_program(folder.path());
    let server = Server::start_program(&program, folder.path());
    let other = folder.path().join("other");
    std::fs::write(&other, "#!/bin/sh\nexit 1\n").expect("a file");
    std::fs::rename(other, &program).expect("replaced");
    let replaced = server.submit(&spec(2)).await;
    let job = server.until_ended(&replaced).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
    std::fs::remove_file(&program).expect("removed");
    let removed = server.submit(&spec(2)).await;
    let job = server.until_ended(&removed).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
}

#[tokio::test]
async fn a_service_that_may_not_execute_its_program_fails_no_job_and_is_not_ready_until_it_may() {
    let folder = folder();
    let program = copied_program(folder.path());
    let server = Server::start_program(&program, folder.path());
    let allow = |mode| {
        let permissions = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(&program, permissions).expect("a mode");
    };
    allow(0o644);
    let mut ids = Vec::new();
    for _ in 0..5 {
        ids.push(server.submit(&spec(2)).await);
    }
    let says_why = |job: &Value| {
        let reason = job["status_reason"].as_str().unwrap_or_default();
        reason.contains("did not start: Permission denied")
    };
    server.until(&ids[0], says_why).await;
    let problem = server.get("/readyz").await;
    assert_eq!(problem["type"], "/problems/workers-failing", "{problem}");
    for id in &ids {
        let job = server.get(&format!("/v1/jobs/{id}")).await;
        assert!(
            ["queued", "running"].contains(&job["status"].as_str().expect("text")),
            "{job}"
        );
    }
    allow(0o755);
    for id in &ids {
        let job = server.until_ended(id).await;
        assert_eq!(
            (&job["status"], &job["attempts"]),
            (&json!("succeeded"), &json!(1)),
            "{job}"
        );
    }
    assert_eq!(server.get("/readyz").await["status"], "ready");
}
