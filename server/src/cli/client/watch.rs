//! `fretwear watch ID`: follows a job to its end; its tables or the summary on standard output.

use std::process::ExitCode;

use api::event::Done;
use api::job::{Progress, Stage, Status};
use uuid::Uuid;

use crate::cli::client::connection::{CANCELLED, ServerOptions, interruptible, job_id, report};
use crate::cli::summary;
use crate::cli::summary::Format;
use crate::cli::terminal::{Ended, bar, failed, write_err};
use crate::client::{Client, ClientError, Followed, WrittenId};

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct WatchArguments {
    /// The job; the first or last characters of its id are enough.
    id: WrittenId,
    /// Write the summary as JSON instead of tables.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    server: ServerOptions,
}

pub(super) fn run(arguments: &WatchArguments) -> Ended {
    let client = arguments.server.client()?;
    let id = job_id(&client, &arguments.id)?;
    let format = Format::json_if(arguments.json);
    interruptible(watch(&client, id, format), Some(id))?
}

/// Follows a job, and writes its summary.
pub(super) async fn watch(client: &Client, id: Uuid, format: Format) -> Ended {
    let followed = follow(client, id).await;
    let done = followed.map_err(|error| report(&error))?;
    if let Some(summary) = &done.summary {
        let job = client.job(id).await.map_err(|error| report(&error))?;
        summary::write(&job.spec, summary, format, &[])?;
    }
    ended(&done)
}

/// Follows a job to its end with a progress bar.
pub(in crate::cli) async fn follow(client: &Client, id: Uuid) -> Result<Done, ClientError> {
    let bar = bar(0);
    let (mut interrupted, mut said) = (false, None);
    let followed = client.follow(id, |news| match news {
        Followed::Progress(progress) => {
            interrupted = false;
            bar.set_length(progress.cycles);
            bar.set_position(progress.cycle);
            bar.set_message(part(progress));
            if progress.reason.is_some() && progress.reason != said {
                bar.suspend(|| write_err(format_args!("fretwear: {}", again(progress))));
                said.clone_from(&progress.reason);
            }
        }
        Followed::Interrupted(error) => {
            if !interrupted {
                bar.suspend(|| write_err(format_args!("fretwear: {error}; trying again")));
            }
            interrupted = true;
        }
    });
    let followed = followed.await;
    bar.finish_and_clear();
    followed
}

/// The part of the solve that the bar shows, in a word.
fn part(progress: &Progress) -> &'static str {
    match progress.stage {
        Some(stage @ Stage::Refined) => stage.as_str(),
        _ => progress.phase.map_or("waiting", |phase| phase.as_str()),
    }
}

/// Why the run has begun again at cycle 0.
fn again(progress: &Progress) -> String {
    let reason = progress.reason.as_deref().unwrap_or_default();
    match progress.stage {
        Some(Stage::Refined) => format!("the run is refined from cycle 0 on: {reason}"),
        _ => format!("the run begins again at cycle 0: {reason}"),
    }
}

/// Reports how a job has ended, unless it has succeeded; the exit code of its status.
fn ended(done: &Done) -> Ended {
    let reason = done.status_reason.as_deref().unwrap_or("no reason given");
    match done.status {
        Status::Succeeded => Ok(()),
        Status::Cancelled => {
            write_err(format_args!("fretwear: the job was cancelled: {reason}"));
            Err(ExitCode::from(CANCELLED))
        }
        status => Err(failed(format_args!(
            "the job {}: {reason}",
            status.as_str()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_begins_again_is_named_with_its_reason() {
        let mut progress = Progress {
            stage: Some(Stage::Refined),
            reason: Some("8 % off".to_owned()),
            ..Progress::default()
        };
        assert_eq!(part(&progress), "refined");
        assert_eq!(
            again(&progress),
            "the run is refined from cycle 0 on: 8 % off"
        );
        progress.stage = None;
        assert_eq!(part(&progress), "waiting");
        assert_eq!(again(&progress), "the run begins again at cycle 0: 8 % off");
    }
}
