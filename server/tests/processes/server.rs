//! A server process, and requests to it.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

pub(crate) const FRETWEAR: &str = env!("CARGO_BIN_EXE_fretwear");
/// Interval at which a job is polled.
pub(crate) const POLL_INTERVAL: Duration = Duration::from_millis(20);
/// A variable with a secret of the service.
pub(crate) const PASSWORD: &str = "PGPASSWORD";
/// Number of polls before a test fails.
pub(crate) const POLL_LIMIT: usize = 15_000;

/// A server with a database in a temporary folder; killed on drop.
pub(crate) struct Server {
    pub(crate) child: Child,
    pub(crate) base: String,
    pub(crate) client: reqwest::Client,
}

impl Server {
    pub(crate) fn start(folder: &Path) -> Self {
        Self::start_program(Path::new(FRETWEAR), folder)
    }

    pub(crate) fn start_program(program: &Path, folder: &Path) -> Self {
        Self::start_command(Command::new(program), folder)
    }

    pub(crate) fn start_command(mut command: Command, folder: &Path) -> Self {
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

    pub(crate) fn signal(&self, signal: Signal) {
        let id = i32::try_from(self.child.id()).expect("a process id");
        kill(Pid::from_raw(id), signal).expect("a signal");
    }

    pub(crate) async fn get(&self, path: &str) -> Value {
        let response = self
            .client
            .get(format!("{}{path}", self.base))
            .send()
            .await
            .expect("an answer");
        response.json().await.expect("JSON")
    }

    pub(crate) async fn post(&self, path: &str, body: &Value) -> Value {
        let response = self
            .client
            .post(format!("{}{path}", self.base))
            .json(body)
            .send()
            .await
            .expect("an answer");
        response.json().await.expect("JSON")
    }

    pub(crate) async fn submit(&self, spec: &Value) -> String {
        let job = self.post("/v1/jobs", spec).await;
        job["id"]
            .as_str()
            .unwrap_or_else(|| panic!("{job}"))
            .to_owned()
    }

    /// Polls a job until it satisfies a condition.
    pub(crate) async fn until(&self, id: &str, condition: impl Fn(&Value) -> bool) -> Value {
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

    pub(crate) async fn until_computing(&self, id: &str) -> Value {
        self.until(id, |job| {
            job["status"] != "queued" && job["progress"]["cycle"].as_u64() > Some(0)
        })
        .await
    }

    pub(crate) async fn until_ended(&self, id: &str) -> Value {
        self.until(id, |job| !job["finished_at"].is_null()).await
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // The process may have exited already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
