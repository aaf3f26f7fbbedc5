//! The solving process: started in its own process group, fed with a specification, ended with its supervisor.

use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::time::Duration;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tokio::io::{AsyncBufReadExt, AsyncWriteExt, BufReader, Lines};
use tokio::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command};
use tokio::task::JoinHandle;
use tracing::Instrument;

use super::Rules;
use crate::store::Claim;

/// How long the last words of an ended process are waited for.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// How the Rust runtime begins its words when an allocation fails.
pub(super) const OUT_OF_MEMORY: &str = "memory allocation of ";

/// A solving process.
#[derive(Debug)]
pub(super) struct Solving {
    child: Child,
    /// Held open: its end tells the process that its supervisor is gone.
    _stdin: ChildStdin,
    lines: Lines<BufReader<ChildStdout>>,
    words: JoinHandle<Option<String>>,
}

/// How a solving process ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ended {
    /// By itself, with this code.
    Code(i32),
    /// By a signal that comes from outside.
    Killed,
    /// By a signal that a program brings upon itself: the same input would do so again.
    Crashed(i32),
}

impl Solving {
    /// Starts the process and hands it the specification and the checkpoint to go on from, a line each; its files go into
    /// `folder`.
    pub(super) async fn start(
        rules: &Rules,
        claim: &Claim,
        folder: &Path,
    ) -> std::io::Result<Self> {
        let mut child = Command::new(&rules.program)
            .arg("solve-child")
            .arg("--checkpoint-every-ms")
            .arg(rules.checkpoint_every.as_millis().to_string())
            .arg("--memory-limit-mb")
            .arg(rules.memory_limit_mb(claim.memory_mb).to_string())
            .arg(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .process_group(0)
            .kill_on_drop(true)
            .spawn()?;
        let missing = || std::io::Error::other("the process has no pipe");
        let mut stdin = child.stdin.take().ok_or_else(missing)?;
        let stdout = child.stdout.take().ok_or_else(missing)?;
        let stderr = child.stderr.take().ok_or_else(missing)?;
        let checkpoint = claim.checkpoint.as_ref();
        let checkpoint =
            checkpoint.map_or_else(String::new, |found| BASE64_STANDARD.encode(&found.state));
        for line in [claim.spec.as_bytes(), checkpoint.as_bytes()] {
            stdin.write_all(line).await?;
            stdin.write_all(b"\n").await?;
        }
        stdin.flush().await?;
        Ok(Self {
            child,
            _stdin: stdin,
            lines: BufReader::new(stdout).lines(),
            words: tokio::spawn(logged(stderr).in_current_span()),
        })
    }

    /// The next line; nothing at its end. Safe to cancel.
    pub(super) async fn line(&mut self) -> std::io::Result<Option<String>> {
        self.lines.next_line().await
    }

    /// Waits for the end; with the last line of its standard error.
    pub(super) async fn ended(&mut self) -> (Ended, Option<String>) {
        let ended = self.child.wait().await.map_or(Ended::Killed, Ended::from);
        let words = tokio::time::timeout(LAST_WORDS, &mut self.words).await;
        (ended, words.ok().and_then(Result::ok).flatten())
    }

    /// Asks the process to tell a checkpoint and end.
    pub(super) fn terminate(&self) {
        let id = self.child.id().and_then(|id| i32::try_from(id).ok());
        let asked = id.map(|id| kill(Pid::from_raw(id), Signal::SIGTERM));
        if let Some(Err(error)) = asked {
            tracing::warn!(%error, "a solving process could not be asked to end");
        }
    }

    /// Kills the process and waits for its end.
    pub(super) async fn kill(&mut self) {
        if let Err(error) = self.child.kill().await {
            tracing::warn!(%error, "a solving process could not be killed");
        }
    }
}

/// Passes what a process says on to the log; returns its last line, or the one that tells of a failed allocation.
async fn logged(stderr: ChildStderr) -> Option<String> {
    let mut lines = BufReader::new(stderr).lines();
    let mut last: Option<String> = None;
    while let Ok(Some(line)) = lines.next_line().await {
        if !line.trim().is_empty() {
            tracing::warn!("solving process: {line}");
            last = last
                .filter(|told| told.starts_with(OUT_OF_MEMORY))
                .or(Some(line));
        }
    }
    last
}

impl From<ExitStatus> for Ended {
    fn from(status: ExitStatus) -> Self {
        let crashes = [
            Signal::SIGABRT,
            Signal::SIGBUS,
            Signal::SIGFPE,
            Signal::SIGILL,
            Signal::SIGSEGV,
        ];
        match (status.code(), status.signal()) {
            (Some(code), _) => Self::Code(code),
            (None, Some(signal)) if crashes.iter().any(|crash| *crash as i32 == signal) => {
                Self::Crashed(signal)
            }
            (None, _) => Self::Killed,
        }
    }
}
