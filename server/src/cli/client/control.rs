//! `fretwear cancel ID...` and `fretwear retry ID...`.

use crate::cli::client::connection::{ServerOptions, interruptible, report};
use crate::cli::terminal::{Ended, write_out};
use crate::client::WrittenId;

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct ControlArguments {
    /// The jobs; the first or last characters of an id are enough.
    #[arg(required = true)]
    ids: Vec<WrittenId>,
    #[command(flatten)]
    server: ServerOptions,
}

/// Request that is sent for each job.
#[derive(Debug, Clone, Copy)]
pub(super) enum Action {
    Cancel,
    Retry,
}

/// Sends the request for each job; one that is refused does not prevent the others.
pub(super) fn run(arguments: &ControlArguments, action: Action) -> Ended {
    let client = arguments.server.client()?;
    let mut ended = Ok(());
    for written in &arguments.ids {
        let done = async {
            let id = client.job_id(written).await?;
            match action {
                Action::Cancel => client.cancel(id).await,
                Action::Retry => client.retry(id).await,
            }
        };
        match interruptible(done, None)? {
            Ok(job) => write_out(format_args!("{} {}", job.id, job.status.as_str()))?,
            Err(error) => ended = Err(report(&error)),
        }
    }
    ended
}
