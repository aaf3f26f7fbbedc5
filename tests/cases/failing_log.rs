//! Requirement: a log that cannot be written costs log lines, nothing else.

use std::fs::File;
use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};
use tests::{Log, Server, SteppedClock, binary};

/// Enough jobs that every worker logs several lines.
const JOBS: u64 = 4;

fn spec(cycles: u64) -> String {
    let accuracy = json!({"preset": "draft", "overrides": {"cycle_jump": 1}});
    json!({"system": {"kind": "fuzz_button"}, "cycles": cycles, "accuracy": accuracy}).to_string()
}

/// Submits jobs and a cancel request; all must be carried out.
async fn works(server: &Server) {
    let mut jobs = Vec::new();
    for i in 0..JOBS {
        let (status, job) = server.submit(spec(3 + i)).await;
        assert_eq!(status, 202, "{job}");
        jobs.push(job["id"].as_str().expect("a job has an id").to_owned());
    }
    let (_, endless) = server.submit(spec(1_000_000)).await;
    let endless = endless["id"].as_str().expect("a job has an id").to_owned();
    let ended = |job: &Value| job["finished_at"].is_string();
    for id in &jobs {
        let job = server.job_when(id, ended).await;
        assert_eq!(job["status"], "succeeded", "{job}");
    }
    server
        .job_when(&endless, |job| job["status"] == "running")
        .await;
    server.post(&format!("/v1/jobs/{endless}/cancel")).await;
    let job = server.job_when(&endless, ended).await;
    assert_eq!(job["status"], "cancelled", "{job}");
    assert_eq!(server.get("/readyz").await.0, 200);
}

#[tokio::test]
async fn jobs_are_solved_after_the_reader_of_the_log_has_gone() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let (server, lines) = Server::start_with_log(folder.path(), &["--workers", "2"], "info");
    drop(lines);
    works(&server).await;
}

#[tokio::test]
async fn jobs_are_solved_while_the_log_is_not_read() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let (server, lines) = Server::start_with_log(folder.path(), &["--workers", "2"], "trace");
    works(&server).await;
    drop(lines);
}

#[tokio::test]
#[cfg_attr(not(has_cc), ignore = "needs a C compiler")]
async fn tasks_may_panic_while_the_log_is_not_read() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let clock = SteppedClock::new(folder.path());
    let environment = clock.environment();
    let options = ["--workers", "2"];
    let server = Server::start_logging(folder.path(), &options, &environment, &Log::Unread);
    let server = server.expect("it serves");
    // The lines of the log fill the pipe.
    works(&server).await;
    for _ in 0..10 {
        clock.fail_once();
        server.get_in_the_end("/v1/jobs").await;
    }
    clock.forget_failure();
    works(&server).await;
}

/// A service whose standard error is a file.
struct Logging(Child);

impl Logging {
    fn start(folder: &Path, port: u16, log: File) -> Self {
        let database = format!("sqlite://{}", folder.join("fretwear.db").display());
        let listen = format!("127.0.0.1:{port}");
        let child = Command::new(binary())
            .args(["serve", "--listen", &listen, "--database", &database])
            .stderr(Stdio::from(log))
            .spawn()
            .expect("the service can be started");
        Self(child)
    }
}

impl Drop for Logging {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[tokio::test]
async fn a_service_starts_whose_log_is_full() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let free = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
    let port = free.expect("a free port").port();
    let full = File::options().write(true).open("/dev/full");
    let mut service = Logging::start(folder.path(), port, full.expect("a device that is full"));
    let client = reqwest::Client::new();
    let health = format!("http://127.0.0.1:{port}/readyz");
    loop {
        let ended = service.0.try_wait().expect("it can be asked for");
        assert!(ended.is_none(), "the service ended: {ended:?}");
        match client.get(&health).send().await {
            Ok(answer) if answer.status() == 200 => break,
            _ => tokio::time::sleep(std::time::Duration::from_millis(20)).await,
        }
    }
}
