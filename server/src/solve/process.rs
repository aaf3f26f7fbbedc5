//! The solving process: started in a process group of its own, given its input, ended with its supervisor.

use std::ffi::OsStr;
use std::fmt;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::time::Duration;

use futures_util::StreamExt;
use nix::sys::signal::Signal::{self, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV};
use nix::sys::signal::kill;
use nix::unistd::Pid;
use tokio::io::AsyncWriteExt;
use tokio::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command};
use tokio::task::JoinHandle;
use tokio_util::codec::{FramedRead, LinesCodec, LinesCodecError};
use tokio_util::task::AbortOnDropHandle;
use tracing::Instrument;

use crate::control_group::memory_kills;
use crate::solve::ChildMessage;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::solve::protocol::{COMMAND, Input};

/// Name of the process in lists of processes, whatever the path of its program.
pub(crate) const NAME: &str = "fretwear";
/// Longest line of a solving process, bytes: several times a snapshot with the largest allowed number of surface
/// elements.
pub(crate) const LINE_LIMIT: usize = 256 << 20;
/// Longest line on its standard error, bytes; longer ones are dropped.
const STDERR_LINE_LIMIT: usize = 64 << 10;
/// Longest time between the end of a process's output and its exit.
const EXIT_TIMEOUT: Duration = Duration::from_secs(5);
/// Longest wait for the standard error of a process that has exited.
const STDERR_TIMEOUT: Duration = Duration::from_secs(1);

/// Beginning of the Rust runtime's message about a failed allocation.
const FAILED_ALLOCATION: &str = "memory allocation of ";

/// Signals that a process causes itself.
const CRASHES: [Signal; 5] = [SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV];

/// Variables that a solving process inherits, by the beginnings of their names: no others, which may be secrets (tokens, passwords of databases
/// and of stores of objects).
const INHERITED: [&str; 8] = [
    "HOME", "LANG", "LC_", "LD_", "PATH", "RUST_", "TMPDIR", "TZ",
];

/// How a solving process is started.
#[derive(Debug)]
pub(crate) struct SolveCommand<'a> {
    /// The binary that has the command `solve-child`.
    pub(crate) program: &'a Path,
    /// Folder of the files that the process writes.
    pub(crate) folder: &'a Path,
    /// The resolved specification, JSON.
    pub(crate) spec: &'a str,
    /// The checkpoint to resume from.
    pub(crate) checkpoint: Option<&'a EncodedCheckpoint>,
    /// Time between two checkpoints.
    pub(crate) checkpoint_every: Duration,
    /// Threads that the solve is to keep busy.
    pub(crate) threads: usize,
    /// Memory limit, MB.
    pub(crate) memory_limit_mb: Option<i64>,
    /// The process waits while the disk of the folder is full; otherwise it ends.
    pub(crate) waits_for_disk: bool,
    /// True if it gets a process group of its own; otherwise the signals of a terminal reach it too.
    pub(crate) own_group: bool,
}

/// A solving process; killed when it is dropped.
#[derive(Debug)]
pub(crate) struct SolveProcess {
    child: Child,
    /// Kills by the kernel before it was started.
    memory_kills: Option<u64>,
    _stdin: AbortOnDropHandle<()>,
    lines: FramedRead<ChildStdout, LinesCodec>,
    stderr: JoinHandle<String>,
}

/// A line of a solving process.
#[derive(Debug)]
pub(crate) struct ReceivedLine {
    /// The line.
    pub(crate) line: ChildMessage,
    /// Length.
    pub(crate) bytes: usize,
}

/// Why a line was not received.
#[derive(Debug, thiserror::Error)]
pub(crate) enum LineError {
    /// The pipe failed, or the line is longer than allowed.
    #[error("the solver's output cannot be read: {0}")]
    Read(std::io::Error),
    /// The line is not a [`ChildMessage`].
    #[error("the solver wrote something that cannot be read: {0}")]
    Malformed(serde_json::Error),
}

/// Why a solving process ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ExitCause {
    /// Exited with this code.
    Code(i32),
    /// Killed from outside.
    Killed,
    /// Killed by the kernel, because memory ran out.
    KilledForMemory,
    /// Crashed by a signal that the process caused itself: the same input would do so again.
    Crashed(i32),
}

/// The end of a solving process.
#[derive(Debug)]
pub(crate) struct Exit {
    /// Why it ended.
    pub(crate) cause: ExitCause,
    /// The last line of its standard error, or the one about a failed allocation; empty if there was none.
    pub(crate) stderr: String,
}

impl Exit {
    /// Returns `true` if the process reported a failed allocation.
    pub(crate) fn is_out_of_memory(&self) -> bool {
        self.stderr.starts_with(FAILED_ALLOCATION)
    }

    /// Last standard error as the end of a sentence.
    pub(crate) fn details(&self) -> String {
        match self.stderr.as_str() {
            "" => String::new(),
            line => format!(": {line}"),
        }
    }
}

impl fmt::Display for Exit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.cause {
            ExitCause::Code(code) => write!(f, "ended with code {code}")?,
            ExitCause::Killed => f.write_str("was killed")?,
            ExitCause::KilledForMemory => f.write_str(
                "was killed by the kernel, because the memory of the machine or of its control group ran out",
            )?,
            ExitCause::Crashed(signal) => write!(f, "crashed with signal {signal}")?,
        }
        f.write_str(&self.details())
    }
}

impl SolveCommand<'_> {
    /// Starts the process and sends its input. Needs a tokio runtime.
    pub(crate) fn spawn(&self) -> std::io::Result<SolveProcess> {
        let every_ms = self.checkpoint_every.as_millis().to_string();
        let mut command = Command::new(self.program);
        command.arg0(NAME);
        command.args([COMMAND, "--checkpoint-every-ms", &every_ms]);
        command.args(["--threads", &self.threads.to_string()]);
        if let Some(limit) = self.memory_limit_mb {
            command.args(["--memory-limit-mb", &limit.to_string()]);
        }
        if self.waits_for_disk {
            command.arg("--waits-for-disk");
        }
        command
            .arg(self.folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .kill_on_drop(true);
        if self.own_group {
            command.process_group(0);
        }
        let is_inherited = |name: &OsStr| {
            let name = name.to_string_lossy();
            INHERITED
                .iter()
                .any(|beginning| name.starts_with(beginning))
        };
        let variables = std::env::vars_os().filter(|(name, _)| is_inherited(name));
        command.env_clear().envs(variables);
        let input = Input::lines(self.spec, self.checkpoint)?;
        let memory_kills = memory_kills();
        let mut child = command.spawn()?;
        end_before_service(child.id());
        let missing = || std::io::Error::other("the process has no pipe");
        let stdin = child.stdin.take().ok_or_else(missing)?;
        let stdout = child.stdout.take().ok_or_else(missing)?;
        let stderr = child.stderr.take().ok_or_else(missing)?;
        let sending = tokio::spawn(send_input(stdin, input).in_current_span());
        Ok(SolveProcess {
            child,
            memory_kills,
            _stdin: AbortOnDropHandle::new(sending),
            lines: FramedRead::new(stdout, LinesCodec::new_with_max_length(LINE_LIMIT)),
            stderr: tokio::spawn(log_stderr(stderr).in_current_span()),
        })
    }
}

/// Preference of the kernel for a solving process where memory runs out, of 1 000: far above that for a service of its size.
const OOM_SCORE: &str = "500";

/// Lets the kernel end a solving process before the service where memory runs out; systems without this file choose by size alone.
fn end_before_service(process: Option<u32>) {
    let file = process.map(|id| format!("/proc/{id}/oom_score_adj"));
    if let Some(Err(error)) = file.map(|file| fs_err::write(file, OOM_SCORE)) {
        tracing::debug!(%error, "the kernel chooses by size alone where memory runs out");
    }
}

impl SolveProcess {
    /// Returns the next line, or `None` at the end of the output. Safe to cancel.
    pub(crate) async fn next_line(&mut self) -> Result<Option<ReceivedLine>, LineError> {
        let text = self.lines.next().await.transpose();
        let text = text.map_err(|cause| LineError::Read(std::io::Error::other(cause)))?;
        text.map(|text| {
            let line = serde_json::from_str(&text).map_err(LineError::Malformed)?;
            let bytes = text.len();
            Ok(ReceivedLine { line, bytes })
        })
        .transpose()
    }

    /// Waits for the exit of a process whose output has ended; kills one that does not exit.
    pub(crate) async fn wait(&mut self) -> Exit {
        let waited = tokio::time::timeout(EXIT_TIMEOUT, self.child.wait()).await;
        let cause = if let Ok(status) = waited {
            match status.map_or(ExitCause::Killed, ExitCause::from) {
                ExitCause::Killed if has_killed_since(self.memory_kills) => {
                    ExitCause::KilledForMemory
                }
                cause => cause,
            }
        } else {
            tracing::warn!("a solving process closed its output but did not exit; it is killed");
            self.kill().await;
            ExitCause::Killed
        };
        let stderr = tokio::time::timeout(STDERR_TIMEOUT, &mut self.stderr).await;
        let stderr = stderr.ok().and_then(Result::ok).unwrap_or_default();
        Exit { cause, stderr }
    }

    /// Asks the process for a last checkpoint and its exit.
    pub(crate) fn terminate(&self) {
        let id = self.child.id().and_then(|id| i32::try_from(id).ok());
        let sent = id.map(|id| kill(Pid::from_raw(id), Signal::SIGTERM));
        if let Some(Err(error)) = sent {
            tracing::warn!(%error, "a solving process could not be asked to end");
        }
    }

    /// Kills the process and waits for its exit.
    pub(crate) async fn kill(&mut self) {
        if let Err(error) = self.child.kill().await {
            tracing::warn!(%error, "a solving process could not be killed");
        }
    }
}

/// Checks whether the kernel has killed a process for lack of memory since a number of kills was read.
fn has_killed_since(before: Option<u64>) -> bool {
    let kills = memory_kills().zip(before);
    kills.is_some_and(|(now, before)| now > before)
}

/// Writes the input of a process, which may be slow to read it, and then holds the pipe open: its end informs the process
/// that its supervisor has ended.
async fn send_input(mut stdin: ChildStdin, input: String) {
    if let Err(error) = stdin.write_all(input.as_bytes()).await {
        tracing::warn!(%error, "a solving process did not read its input");
    }
    std::future::pending::<()>().await;
}

/// Logs the standard error of a process; returns its last line, or the one about a failed allocation.
async fn log_stderr(stderr: ChildStderr) -> String {
    let mut lines = FramedRead::new(stderr, LinesCodec::new_with_max_length(STDERR_LINE_LIMIT));
    let mut last = String::new();
    while let Some(line) = lines.next().await {
        match line {
            Ok(line) if !line.trim().is_empty() => {
                tracing::warn!("solving process: {line}");
                if !last.starts_with(FAILED_ALLOCATION) {
                    last = line;
                }
            }
            Ok(_) | Err(LinesCodecError::MaxLineLengthExceeded) => {}
            Err(LinesCodecError::Io(_)) => break,
        }
    }
    last
}

impl From<ExitStatus> for ExitCause {
    fn from(status: ExitStatus) -> Self {
        match (status.code(), status.signal()) {
            (Some(code), _) => Self::Code(code),
            (None, Some(signal)) if CRASHES.iter().any(|crash| *crash as i32 == signal) => {
                Self::Crashed(signal)
            }
            (None, _) => Self::Killed,
        }
    }
}
