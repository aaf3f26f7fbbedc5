//! The solving process: started in its own process group, fed with a specification, ended with its supervisor.

use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::time::Duration;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use futures_util::StreamExt;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tokio::io::AsyncWriteExt;
use tokio::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command};
use tokio::task::JoinHandle;
use tokio_util::codec::{FramedRead, LinesCodec, LinesCodecError};
use tokio_util::task::AbortOnDropHandle;
use tracing::Instrument;

use crate::store::Claim;
use crate::worker::Rules;

/// Longest line of a solving process, bytes: a snapshot of as many surface elements as a study may have, several times.
const LINE_LIMIT: usize = 256 << 20;
/// Longest line on its standard error; more is dropped.
const WORDS_LIMIT: usize = 64 << 10;
/// How long a process may take to end that has closed its output.
const LAST_MOMENTS: Duration = Duration::from_secs(5);
/// How long the last words of an ended process are waited for.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// How the Rust runtime begins its words when an allocation fails.
pub(super) const OUT_OF_MEMORY: &str = "memory allocation of ";

/// A solving process.
#[derive(Debug)]
pub(super) struct Solving {
    child: Child,
    _input: AbortOnDropHandle<()>,
    lines: FramedRead<ChildStdout, LinesCodec>,
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
    pub(super) fn start(rules: &Rules, claim: &Claim, folder: &Path) -> std::io::Result<Self> {
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
        let stdin = child.stdin.take().ok_or_else(missing)?;
        let stdout = child.stdout.take().ok_or_else(missing)?;
        let stderr = child.stderr.take().ok_or_else(missing)?;
        let checkpoint = claim.checkpoint.as_ref();
        let checkpoint =
            checkpoint.map_or_else(String::new, |found| BASE64_STANDARD.encode(&found.state));
        let input = format!("{}\n{checkpoint}\n", claim.spec);
        Ok(Self {
            child,
            _input: AbortOnDropHandle::new(tokio::spawn(handed(stdin, input).in_current_span())),
            lines: FramedRead::new(stdout, LinesCodec::new_with_max_length(LINE_LIMIT)),
            words: tokio::spawn(logged(stderr).in_current_span()),
        })
    }

    /// The next line; nothing at its end. Safe to cancel.
    pub(super) async fn line(&mut self) -> std::io::Result<Option<String>> {
        let line = self.lines.next().await.transpose();
        line.map_err(std::io::Error::other)
    }

    /// Waits for the end; with the last line of its standard error.
    pub(super) async fn ended(&mut self) -> (Ended, Option<String>) {
        let waited = tokio::time::timeout(LAST_MOMENTS, self.child.wait()).await;
        let ended = if let Ok(ended) = waited {
            ended.map_or(Ended::Killed, Ended::from)
        } else {
            tracing::warn!("a solving process closed its output but does not end; it is killed");
            self.kill().await;
            Ended::Killed
        };
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

/// Hands its input to a process, which may be slow to read it, and holds the pipe open then: its end tells the process
/// that its supervisor is gone.
async fn handed(mut stdin: ChildStdin, input: String) {
    if let Err(error) = stdin.write_all(input.as_bytes()).await {
        tracing::warn!(%error, "a solving process did not take its input");
    }
    std::future::pending::<()>().await;
}

/// Passes what a process says on to the log; returns its last line, or the one that tells of a failed allocation.
async fn logged(stderr: ChildStderr) -> Option<String> {
    let mut lines = FramedRead::new(stderr, LinesCodec::new_with_max_length(WORDS_LIMIT));
    let mut last: Option<String> = None;
    while let Some(line) = lines.next().await {
        match line {
            Ok(line) if !line.trim().is_empty() => {
                tracing::warn!("solving process: {line}");
                last = last
                    .filter(|told| told.starts_with(OUT_OF_MEMORY))
                    .or(Some(line));
            }
            Ok(_) | Err(LinesCodecError::MaxLineLengthExceeded) => {}
            Err(LinesCodecError::Io(_)) => break,
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
