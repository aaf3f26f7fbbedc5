//! `fretwear list`: the newest jobs.

use api::job::JobOverview;
use comfy_table::Table;

use crate::cli::client::connection::{ServerOptions, interruptible, report};
use crate::cli::terminal::{Ended, printable, write_json, write_out};

#[derive(Debug, clap::Args)]
pub(in crate::cli) struct ListArguments {
    /// Any of these statuses, separated by commas: queued, running, succeeded, failed, cancelled.
    #[arg(long)]
    status: Option<String>,
    /// This kind of system.
    #[arg(long)]
    system: Option<String>,
    /// This label, as key=value or key:value; can be repeated, for jobs that have all of them.
    #[arg(long, value_parser = label)]
    label: Vec<String>,
    /// Largest number of jobs.
    #[arg(long, default_value_t = 20)]
    limit: usize,
    /// Write the documents as JSON instead of a table.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    server: ServerOptions,
}

pub(super) fn run(arguments: &ListArguments) -> Ended {
    let client = arguments.server.client()?;
    let filters = filters(arguments);
    let jobs = interruptible(client.jobs(&filters, arguments.limit), None)?;
    let jobs = jobs.map_err(|error| report(&error))?;
    if arguments.json {
        return write_json(&jobs);
    }
    write_out(table(&jobs))
}

/// The filters of the arguments.
fn filters(arguments: &ListArguments) -> Vec<(&'static str, String)> {
    let given = [
        ("status", arguments.status.clone()),
        ("system", arguments.system.clone()),
    ];
    let labels = arguments.label.iter().map(|label| ("label", label.clone()));
    let given = given
        .into_iter()
        .filter_map(|(name, value)| Some((name, value?)));
    given.chain(labels).collect()
}

/// Reads `key=value` or `key:value`, as the service has it: the key ends at the first of both signs.
fn label(text: &str) -> Result<String, &'static str> {
    let (key, value) = text
        .split_once([':', '='])
        .ok_or("expected key=value or key:value")?;
    Ok(format!("{key}:{value}"))
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

#[cfg(test)]
mod tests {
    use super::label;

    #[test]
    fn labels_have_an_equals_sign_or_a_colon() {
        for (text, label_of_service) in [
            ("lot=7", "lot:7"),
            ("lot:7", "lot:7"),
            ("formula=a:b", "formula:a:b"),
            ("formula:a=b", "formula:a=b"),
            ("lot=", "lot:"),
        ] {
            assert_eq!(label(text).as_deref(), Ok(label_of_service));
        }
        assert!(label("lot").is_err());
    }
}
