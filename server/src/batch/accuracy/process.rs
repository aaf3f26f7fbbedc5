//! One run in a process of its own: its solution and its cost.

use std::path::Path;
use std::time::Duration;

use api::results::Profile;
use api::spec::Spec;

use crate::batch::accuracy::{RunResult, StudyError};
use crate::solve::process::{LineError, SolveCommand};
use crate::solve::{ChildMessage, children_cpu_s};

/// Time between two checkpoints: longer than any run, because a run of a study is never resumed.
const NO_CHECKPOINTS: Duration = Duration::from_secs(1_000_000);

/// Solves a specification with the program's `solve-child`; blocks until the process has exited. Returns its solution,
/// or why there is none, and its processor seconds.
///
/// # Errors
/// [`StudyError`] if the process cannot be started or its output cannot be read.
pub fn solve(program: &Path, spec: &Spec) -> Result<(Result<RunResult, String>, f64), StudyError> {
    let spec = serde_json::to_string(spec)?;
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    let before = children_cpu_s();
    let found = runtime
        .block_on(run(program, &spec))
        .map_err(|error| match error {
            LineError::Read(cause) => StudyError::Process(cause),
            LineError::Malformed(cause) => StudyError::Line(cause),
        })?;
    Ok((found, children_cpu_s() - before))
}

async fn run(program: &Path, spec: &str) -> Result<Result<RunResult, String>, LineError> {
    let command = SolveCommand {
        program,
        folder: &std::env::temp_dir(),
        spec,
        checkpoint: None,
        checkpoint_every: NO_CHECKPOINTS,
        threads: 1,
        memory_limit_mb: None,
        waits_for_disk: false,
        own_group: false,
    };
    let mut process = command.spawn().map_err(LineError::Read)?;
    let (mut profile, mut found) = (Profile::default(), None);
    while let Some(received) = process.next_line().await? {
        match received.line {
            ChildMessage::Snapshot(snapshot) => profile = snapshot.profile,
            ChildMessage::Summary(summary) => found = Some(Ok(RunResult::new(*summary, &profile))),
            ChildMessage::Failed(failure) => found = Some(Err(failure.reason)),
            _ => {}
        }
    }
    let details = process.wait().await.details();
    Ok(found.unwrap_or_else(|| Err(format!("the process ended without a result{details}"))))
}
