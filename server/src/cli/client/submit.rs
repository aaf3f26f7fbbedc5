//! `fretwear submit SPEC`: queues a job.

use std::path::PathBuf;

use uuid::Uuid;

use crate::cli::client::connection::{ServerOptions, interruptible, report_of};
use crate::cli::client::{fetch, watch};
use crate::cli::specification::Document;
use crate::cli::summary::Format;
use crate::cli::terminal::{Ended, write_err, write_json, write_out};
use crate::cli::{destination, specification};
use crate::http::idempotency_key;

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct SubmitArguments {
    /// The specification, JSON; `-` is standard input.
    spec: PathBuf,
    #[command(flatten)]
    server: ServerOptions,
    /// Minutes added to the job's age in the order of the queue, -100 to 100.
    #[arg(long, allow_negative_numbers = true)]
    priority: Option<i32>,
    /// The job fails if it has not ended so many seconds after its submission.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    deadline_s: Option<u32>,
    /// Requests with the same key queue one job, also from another terminal; a new key unless given. 1 to 255 printable ASCII characters.
    #[arg(long, value_parser = idempotency_key::checked)]
    key: Option<String>,
    /// Follow the job to its end, as `watch` does.
    #[arg(long)]
    watch: bool,
    /// Follow the job and write its files into this folder, as `fetch` does.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Write the job, or the summary of a job that is followed, as JSON.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &SubmitArguments) -> Ended {
    let client = arguments.server.client()?;
    let Document { name, json } = specification::read(&arguments.spec)?;
    let out = arguments.out.as_deref();
    out.map_or(Ok(()), destination::folder)?;
    let key = arguments.key.clone();
    let key = key.unwrap_or_else(|| Uuid::now_v7().to_string());
    let options = [
        (
            "priority",
            arguments.priority.map(|given| given.to_string()),
        ),
        (
            "deadline_s",
            arguments.deadline_s.map(|given| given.to_string()),
        ),
    ];
    let options: Vec<_> = options
        .into_iter()
        .filter_map(|(name, value)| Some((name, value?)))
        .collect();
    let submitted = interruptible(client.submit(json, &options, &key), None)?;
    let job = submitted.map_err(|error| report_of(&name, &error))?;
    for warning in job.plan.iter().flat_map(|plan| &plan.warnings) {
        write_err(format_args!(
            "fretwear: warning: {}: {}",
            warning.field, warning.detail
        ));
    }
    if !arguments.watch && arguments.out.is_none() {
        return if arguments.json {
            write_json(&job)
        } else {
            write_out(job.id)
        };
    }
    // Standard output is for the summary.
    write_err(format_args!("job {}", job.id));
    let format = Format::json_if(arguments.json);
    let ended = interruptible(watch::watch(&client, job.id, format), Some(job.id))?;
    match out {
        // The results of a job that failed show why.
        Some(folder) => fetch::fetch(&client, job.id, &[], folder).and(ended),
        None => ended,
    }
}
