//! Commands that use a service elsewhere: `submit`, `list`, `watch`, `fetch`, `spec`, `cancel`, `retry` and `worker-token`.
//!
//! Exit codes: 0, the job succeeded, or what was asked for was done; 1, the job failed, or another error; 2, the
//! arguments cannot be used, or the service refused the request; 3, the job was cancelled; 4, the service could not be reached; 130, interrupted (Ctrl-C).

mod connection;
mod control;
mod fetch;
mod list;
mod spec;
mod submit;
mod watch;
mod worker_token;

use clap::Subcommand;

use crate::cli::client::control::Action;
use crate::cli::terminal::Ended;

pub(in crate::cli) use watch::follow;

/// Commands that use a service.
#[derive(Debug, Subcommand)]
pub(super) enum ClientCommand {
    /// Queue a job at a service, and write its id to standard output.
    Submit(submit::SubmitArguments),
    /// List the newest jobs of a service.
    List(list::ListArguments),
    /// Follow a job with a progress bar to its end; Ctrl-C leaves it running.
    Watch(watch::WatchArguments),
    /// Write the files of a job into a folder, and compare their SHA-256.
    Fetch(fetch::FetchArguments),
    /// Write the specification of a job as it was sent to standard output, to be changed and submitted again.
    Spec(spec::SpecArguments),
    /// Cancel jobs; results computed so far remain.
    Cancel(control::ControlArguments),
    /// Queue failed or cancelled jobs again, from their last checkpoints.
    Retry(control::ControlArguments),
    /// Make, list and revoke tokens of remote workers.
    #[command(subcommand)]
    WorkerToken(worker_token::TokenAction),
}

pub(super) fn run(command: ClientCommand) -> Ended {
    match command {
        ClientCommand::Submit(arguments) => submit::run(&arguments),
        ClientCommand::List(arguments) => list::run(&arguments),
        ClientCommand::Watch(arguments) => watch::run(&arguments),
        ClientCommand::Fetch(arguments) => fetch::run(&arguments),
        ClientCommand::Spec(arguments) => spec::run(&arguments),
        ClientCommand::Cancel(arguments) => control::run(&arguments, Action::Cancel),
        ClientCommand::Retry(arguments) => control::run(&arguments, Action::Retry),
        ClientCommand::WorkerToken(action) => worker_token::run(&action),
    }
}
