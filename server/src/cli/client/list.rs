//! `fretwear list`: the newest jobs.

use api::job::JobOverview;
use comfy_table::Table;

use crate::cli::client::connection::{ServerOptions, interruptible, report};
use crate::cli::terminal::{Ended, printable, write_json, write_out};
use crate::client::{Client, ClientError};

/// Largest number of jobs of one answer.
const PAGE: u32 = 500;

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct ListArguments {
    /// Any of these statuses, separated by commas: queued, running, succeeded, failed, cancelled.
    #[arg(long)]
    status: Option<String>,
    /// This kind of system.
    #[arg(long)]
    system: Option<String>,
    /// This label, as key:value; can be repeated, for jobs that have all of them.
    #[arg(long)]
    label: Vec<String>,
    /// Largest number of jobs.
    #[arg(long, default_value_t = 20)]
    limit: u32,
    /// Write the documents as JSON instead of a table.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    server: ServerOptions,
}

pub(super) fn run(arguments: &ListArguments) -> Ended {
    let client = arguments.server.client()?;
    let jobs = interruptible(jobs(&client, arguments), None)?;
    let jobs = jobs.map_err(|error| report(&error))?;
    if arguments.json {
        return write_json(&jobs);
    }
    write_out(table(&jobs))
}

/// A page of the list: every job in short, as is asked for.
#[derive(serde::Deserialize)]
struct Page {
    jobs: Vec<JobOverview>,
    next_page_token: Option<String>,
}

/// Requests pages until there are enough jobs.
async fn jobs(client: &Client, arguments: &ListArguments) -> Result<Vec<JobOverview>, ClientError> {
    let (mut jobs, mut token) = (Vec::new(), None);
    loop {
        let left = arguments
            .limit
            .saturating_sub(u32::try_from(jobs.len()).unwrap_or(u32::MAX));
        if left == 0 {
            return Ok(jobs);
        }
        let options = options(arguments, left.min(PAGE), token);
        let page: Page = client.get("/v1/jobs", &options).await?;
        jobs.extend(page.jobs);
        token = page.next_page_token;
        if token.is_none() {
            return Ok(jobs);
        }
    }
}

fn options(
    arguments: &ListArguments,
    limit: u32,
    token: Option<String>,
) -> Vec<(&'static str, String)> {
    let given = [
        ("limit", Some(limit.to_string())),
        ("view", Some("short".to_owned())),
        ("status", arguments.status.clone()),
        ("system", arguments.system.clone()),
        ("page_token", token),
    ];
    let labels = arguments.label.iter().map(|label| ("label", label.clone()));
    let given = given
        .into_iter()
        .filter_map(|(name, value)| Some((name, value?)));
    given.chain(labels).collect()
}

fn table(jobs: &[JobOverview]) -> Table {
    let header = [
        "id",
        "name",
        "system",
        "status",
        "progress",
        "depth, um",
        "submitted",
    ];
    let mut table = crate::export::markdown::table(header.map(str::to_owned), 4);
    for job in jobs {
        let depth = job.key_figures.map(|figures| {
            1e3 * figures
                .receptacle_max_depth_mm
                .max(figures.slider_max_depth_mm)
        });
        table.add_row([
            job.id.to_string(),
            printable(job.name.as_deref().unwrap_or_default()).replace('\n', " "),
            job.system.clone(),
            job.status.as_str().to_owned(),
            format!("{:.0} %", 100.0 * job.progress.fraction),
            depth.map_or_else(String::new, |depth| format!("{depth:.3}")),
            job.created_at.clone(),
        ]);
    }
    table
}
