//! A real `fretwear serve` on a free loopback port, killed when it goes out of scope.

use std::fs::File;
use std::io::{BufRead, BufReader, Lines, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, Command, Stdio};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

use crate::program::binary;
use crate::served_database::address_of_database;

/// Timeout of every wait; no measure of speed.
pub(crate) const PATIENCE: Duration = Duration::from_mins(4);

/// File that the logs of services are appended to.
const KEPT: &str = "FRETWEAR_TEST_LOG";

/// A running service.
#[derive(Debug)]
pub struct Server {
    child: Child,
    /// Address, `http://127.0.0.1:PORT` unless it was asked to listen elsewhere.
    pub base: String,
    /// A client.
    pub client: reqwest::Client,
    /// Log, if nobody reads it.
    unread: Option<Lines<BufReader<ChildStderr>>>,
}

/// Destination of the log of a service.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Log {
    /// A pipe that is read; the lines are discarded.
    Read,
    /// A pipe that nobody reads; all lines are written.
    Unread,
    /// A pipe that is closed.
    Closed,
    /// A file.
    File(PathBuf),
}

impl Server {
    /// Starts a service with its database in a folder.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start(folder: &Path) -> Self {
        Self::start_with(folder, &[])
    }

    /// The same with further options; one worker unless they name another number.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start_with(folder: &Path, options: &[&str]) -> Self {
        Self::start_in(folder, options, &[])
    }

    /// The same with variables of its environment.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start_in(folder: &Path, options: &[&str], environment: &[(&str, &Path)]) -> Self {
        let mut command = serve(folder, options);
        command
            .env("RUST_LOG", "info")
            .envs(environment.iter().copied());
        let (server, lines) = Self::started(command);
        // Further output is read, so that the service never blocks on a full pipe, and is appended to a file if one is given.
        let mut kept = std::env::var_os(KEPT).map(|path| {
            let file = File::options().create(true).append(true).open(path);
            file.expect("a file for the logs")
        });
        std::thread::spawn(move || {
            for line in lines.map_while(Result::ok) {
                if let Some(kept) = &mut kept {
                    writeln!(kept, "{line}").expect("the log can be written");
                }
            }
        });
        server
    }

    /// The same with a level of the log; returns the lines of its standard error after the one that names its address. It is
    /// closed when they are dropped, and fills where they are not read.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start_with_log(
        folder: &Path,
        options: &[&str],
        level: &str,
    ) -> (Self, Lines<impl BufRead + use<>>) {
        let mut command = serve(folder, options);
        command.env("RUST_LOG", level);
        Self::started(command)
    }

    /// The same with a place where its log goes; none if it ends before it serves.
    ///
    /// # Panics
    /// If it cannot be started.
    pub fn start_logging(
        folder: &Path,
        options: &[&str],
        environment: &[(&str, &Path)],
        log: &Log,
    ) -> Option<Self> {
        let mut command = serve(folder, options);
        let level = if *log == Log::Unread { "trace" } else { "info" };
        command
            .env("RUST_LOG", level)
            .envs(environment.iter().copied());
        if let Log::File(path) = log {
            return Self::started_logging_to(command, path);
        }
        let (mut server, lines) = Self::serving(command)?;
        match log {
            Log::Unread => server.unread = Some(lines),
            Log::Closed => drop(lines),
            _ => drop(std::thread::spawn(move || lines.for_each(drop))),
        }
        Some(server)
    }

    fn started_logging_to(mut command: Command, path: &Path) -> Option<Self> {
        let log = File::create(path).expect("the log can be made");
        let mut child = command
            .stderr(log)
            .spawn()
            .expect("the service can be started");
        loop {
            let lines = std::fs::read_to_string(path).expect("the log can be read");
            if let Some(base) = lines.lines().find_map(address) {
                return Some(Self::at(child, base));
            }
            if child.try_wait().expect("it can be asked for").is_some() {
                return None;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    fn started(command: Command) -> (Self, Lines<impl BufRead + use<>>) {
        Self::serving(command).expect("the service says where it serves")
    }

    /// Starts a service; none if it ends before it says where it serves.
    fn serving(mut command: Command) -> Option<(Self, Lines<BufReader<ChildStderr>>)> {
        let started = command.stderr(Stdio::piped()).spawn();
        let mut child = started.expect("the service can be started");
        let mut lines = BufReader::new(child.stderr.take().expect("a pipe was asked for")).lines();
        loop {
            let Some(line) = lines.next() else {
                child.wait().expect("it can be waited for");
                return None;
            };
            if let Some(base) = address(&line.expect("its words are text")) {
                return Some((Self::at(child, base), lines));
            }
        }
    }

    fn at(child: Child, base: String) -> Self {
        Self {
            child,
            base,
            client: reqwest::Client::new(),
            unread: None,
        }
    }

    /// Sends a signal to the service alone, not to its children.
    ///
    /// # Panics
    /// If it has already ended.
    pub fn signal(&self, signal: Signal) {
        kill(self.id(), signal).expect("the service is there");
    }

    /// Process id.
    ///
    /// # Panics
    /// If the id is out of range.
    pub fn id(&self) -> Pid {
        Pid::from_raw(i32::try_from(self.child.id()).expect("process ids are small"))
    }

    /// Waits for the service to end; returns its exit code.
    ///
    /// # Panics
    /// If it cannot be waited for.
    pub fn wait(mut self) -> Option<i32> {
        self.child
            .wait()
            .expect("the service can be waited for")
            .code()
    }

    /// Submits a specification; returns status and body.
    ///
    /// # Panics
    /// If the service does not answer.
    pub async fn submit(&self, body: impl Into<reqwest::Body>) -> (u16, Value) {
        let request = self.client.post(format!("{}/v1/jobs", self.base));
        let request = request
            .header("content-type", "application/json")
            .body(body);
        answer(request).await
    }

    /// Gets a path; returns status and body.
    ///
    /// # Panics
    /// If the service does not answer.
    pub async fn get(&self, path: &str) -> (u16, Value) {
        answer(self.client.get(format!("{}{path}", self.base))).await
    }

    /// Gets a path, again if the service does not answer; returns status and body.
    ///
    /// # Panics
    /// If it does not in four minutes.
    pub async fn get_in_the_end(&self, path: &str) -> (u16, Value) {
        self.read_in_the_end(path, |status, body| {
            Some((status, serde_json::from_slice(body).ok()?))
        })
        .await
    }

    /// Gets the bytes of a path, again if the service does not answer with them.
    ///
    /// # Panics
    /// If it does not in four minutes.
    pub async fn bytes_in_the_end(&self, path: &str) -> Vec<u8> {
        self.read_in_the_end(path, |status, body| (status == 200).then(|| body.to_vec()))
            .await
    }

    async fn read_in_the_end<T>(&self, path: &str, read: impl Fn(u16, &[u8]) -> Option<T>) -> T {
        let start = Instant::now();
        loop {
            let request = self.client.get(format!("{}{path}", self.base));
            let request = request.timeout(Duration::from_secs(20));
            if let Ok(response) = request.send().await {
                let status = response.status().as_u16();
                let body = response.bytes().await;
                if let Some(found) = body.ok().and_then(|body| read(status, &body)) {
                    return found;
                }
            }
            assert!(start.elapsed() < PATIENCE, "the service answers");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Posts an empty body to a path; returns status and body.
    ///
    /// # Panics
    /// If the service does not answer.
    pub async fn post(&self, path: &str) -> (u16, Value) {
        answer(self.client.post(format!("{}{path}", self.base))).await
    }

    /// Posts a JSON document to a path; returns status and body.
    ///
    /// # Panics
    /// If the service does not answer.
    pub async fn post_json(&self, path: &str, document: &Value) -> (u16, Value) {
        let request = self.client.post(format!("{}{path}", self.base));
        answer(request.json(document)).await
    }
}

/// The command of a service with its database in a folder; one worker unless the options name another number.
fn serve(folder: &Path, options: &[&str]) -> Command {
    let mut command = Command::new(binary());
    command.args([
        "serve",
        "--database",
        &address_of_database(folder),
        "--files",
    ]);
    command.arg(folder.join("fretwear"));
    if !options.contains(&"--listen") {
        command.args(["--listen", "127.0.0.1:0"]);
    }
    if !options.contains(&"--workers") {
        command.args(["--workers", "1"]);
    }
    command.args(options);
    command
}

/// The address in a line of the log, if it has one.
fn address(line: &str) -> Option<String> {
    let (_, address) = line.split_once(" serves on ")?;
    Some(address.trim().to_owned())
}

async fn answer(request: reqwest::RequestBuilder) -> (u16, Value) {
    let response = request.send().await.expect("the service answers");
    let status = response.status().as_u16();
    let text = response.text().await.expect("the answer is text");
    (
        status,
        serde_json::from_str(&text).unwrap_or(Value::String(text)),
    )
}

impl Drop for Server {
    fn drop(&mut self) {
        // An error means that it has already ended.
        if self.child.kill().is_ok() {
            let _ = self.child.wait();
        }
    }
}
