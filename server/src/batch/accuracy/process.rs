//! One run in a process of its own: what it found and what it cost.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use api::results::Profile;
use api::spec::Spec;

use crate::batch::accuracy::{Found, Spent, StudyError};
use crate::solve::{Line, children_cpu_s};

/// A run of a study is not gone on with: no checkpoints, which would cost time.
const NEVER_MS: &str = "1000000000";

/// Solves a specification with the program's `solve-child` and waits for it.
pub(crate) fn solve(
    program: &Path,
    spec: &Spec,
) -> Result<(Result<Found, String>, Spent), StudyError> {
    let before = children_cpu_s();
    let mut child = Command::new(program)
        .arg("solve-child")
        .arg("--checkpoint-every-ms")
        .arg(NEVER_MS)
        .arg(std::env::temp_dir())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::inherit())
        .spawn()?;
    let missing = || std::io::Error::other("the process has no pipe");
    // Held until the process has ended: it ends when its standard input does.
    let mut stdin = child.stdin.take().ok_or_else(missing)?;
    let stdout = child.stdout.take().ok_or_else(missing)?;
    let mut line = serde_json::to_vec(spec)?;
    // The second line would be a checkpoint to go on from.
    line.extend(b"\n\n");
    stdin.write_all(&line)?;
    stdin.flush()?;
    let found = read(BufReader::new(stdout))?;
    child.wait()?;
    drop(stdin);
    let cpu_s = children_cpu_s() - before;
    let peak_memory_mb = found
        .as_ref()
        .map_or(0.0, |found| found.summary.cost.peak_memory_mb);
    let spent = Spent {
        cpu_s,
        peak_memory_mb,
    };
    Ok((found, spent))
}

fn read(lines: impl BufRead) -> Result<Result<Found, String>, StudyError> {
    let mut last: Option<Profile> = None;
    for line in lines.lines() {
        match serde_json::from_str(&line?)? {
            Line::Snapshot(snapshot) => last = Some(snapshot.profile),
            Line::Summary(summary) => {
                return Ok(Ok(Found::new(*summary, &last.unwrap_or_default())));
            }
            Line::Failed(failure) => return Ok(Err(failure.reason)),
            _ => {}
        }
    }
    Ok(Err("the process ended without a result".to_owned()))
}
