//! The solving process: started in its own process group, fed with a specification, killed with its supervisor.

use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{ExitStatus, Stdio};

use nix::sys::signal::Signal;

use tokio::io::{AsyncWriteExt, BufReader, Lines};
use tokio::process::{Child, ChildStdin, ChildStdout, Command};

/// A solving process.
#[derive(Debug)]
pub(super) struct Solving {
    child: Child,
    /// Held open: its end tells the process that its supervisor is gone.
    _stdin: ChildStdin,
    lines: Lines<BufReader<ChildStdout>>,
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
    /// Starts the process and hands it the specification (JSON, one line); its files go into `folder`.
    pub(super) async fn start(program: &Path, spec: &str, folder: &Path) -> std::io::Result<Self> {
        let mut child = Command::new(program)
            .arg("solve-child")
            .arg(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .process_group(0)
            .kill_on_drop(true)
            .spawn()?;
        let missing = || std::io::Error::other("the process has no pipe");
        let mut stdin = child.stdin.take().ok_or_else(missing)?;
        let stdout = child.stdout.take().ok_or_else(missing)?;
        stdin.write_all(spec.as_bytes()).await?;
        stdin.write_all(b"\n").await?;
        stdin.flush().await?;
        let lines = tokio::io::AsyncBufReadExt::lines(BufReader::new(stdout));
        Ok(Self {
            child,
            _stdin: stdin,
            lines,
        })
    }

    /// The next line; nothing at its end. Safe to cancel.
    pub(super) async fn line(&mut self) -> std::io::Result<Option<String>> {
        self.lines.next_line().await
    }

    /// Waits for the end.
    pub(super) async fn ended(&mut self) -> std::io::Result<Ended> {
        Ok(self.child.wait().await?.into())
    }

    /// Kills the process and waits for its end.
    pub(super) async fn kill(&mut self) {
        if let Err(error) = self.child.kill().await {
            tracing::warn!(%error, "a solving process could not be killed");
        }
    }
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
