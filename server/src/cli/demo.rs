//! `fretwear demo`: the fuzz-button job, end to end, through the service's own HTTP API.

use std::net::SocketAddr;
use std::path::PathBuf;

use api::event::Done;
use api::job::{Job, Progress, Status};
use api::results::WearHistory;
use eventsource_stream::Eventsource;
use futures_util::StreamExt;
use uuid::Uuid;

use crate::cli::runtime::{block_on, workers};
use crate::cli::serve::until_signal;
use crate::cli::table;
use crate::cli::terminal::{Ended, bar, failed, write_err, write_out};
use crate::http::Access;
use crate::service::{Config, Service, ServiceError};
use crate::store::Limits;
use crate::worker::WorkerConfig;

/// The specification: the published fuzz button.
const SPEC: &str = include_str!("../../examples/fuzz_button.json");

/// Why the demonstration failed.
#[derive(Debug, thiserror::Error)]
enum DemoError {
    #[error("{0}")]
    Io(#[from] std::io::Error),
    #[error("{0}")]
    Service(#[from] ServiceError),
    #[error("requesting the service: {0}")]
    Http(#[from] reqwest::Error),
    #[error("the event stream broke off: {0}")]
    Stream(String),
    #[error("an event could not be read: {0}")]
    Event(#[from] serde_json::Error),
    #[error("its results cannot be shown")]
    Output,
    #[error("the job ended as {}: {}", .0.status.as_str(), .0.status_reason.as_deref().unwrap_or("no reason given"))]
    Ended(Box<Done>),
}

pub(super) fn run(listen: SocketAddr, exit: bool) -> Ended {
    block_on(demonstrate(listen, exit))?.map_err(failed)
}

async fn demonstrate(listen: SocketAddr, exit: bool) -> Result<(), DemoError> {
    let folder = PathBuf::from("fretwear-data").join(format!("demo-{}", Uuid::now_v7()));
    std::fs::create_dir_all(&folder)?;
    let database = format!("sqlite://{}", folder.join("fretwear.db").display());
    let program = std::env::current_exe()?;
    let service = Service::start(Config {
        listen,
        access: Access::default(),
        database,
        workers: workers(None),
        limits: Limits::default(),
        keep_days: None,
        worker: WorkerConfig::new(program),
    })
    .await?;
    let base = format!("http://{}", service.address);
    write_err(format_args!(
        "fretwear serves on {base}, its data in {}",
        folder.display()
    ));
    let shown = tokio::select! {
        shown = show_job(&base) => shown,
        signal = until_signal() => {
            service.stop().await;
            return Ok(signal?);
        }
    };
    if let (Ok(()), false) = (&shown, exit) {
        write_err("the service continues; press Ctrl-C to stop it");
        until_signal().await?;
    }
    service.stop().await;
    shown
}

/// Submits the job, waits for its end and shows its results.
async fn show_job(base: &str) -> Result<(), DemoError> {
    let client = reqwest::Client::new();
    let request = client
        .post(format!("{base}/v1/jobs"))
        .header("content-type", "application/json")
        .body(SPEC);
    let job: Job = received(request).await?.json().await?;
    let own = format!("{base}/v1/jobs/{}", job.id);
    let done = follow(&client, &own, job.progress.cycles).await?;
    if done.status != Status::Succeeded {
        return Err(DemoError::Ended(Box::new(done)));
    }
    let job: Job = received(client.get(&own)).await?.json().await?;
    let history = client.get(format!("{own}/results/wear-history"));
    let history: WearHistory = received(history).await?.json().await?;
    let report = table::report(&job, &history);
    for line in report.into_iter().chain(next_steps(base, &own)) {
        write_out(line).map_err(|_| DemoError::Output)?;
    }
    Ok(())
}

/// Sends a request; an error status is an error.
async fn received(request: reqwest::RequestBuilder) -> reqwest::Result<reqwest::Response> {
    request.send().await?.error_for_status()
}

/// Updates a progress bar from the event stream until `done`.
async fn follow(client: &reqwest::Client, own: &str, cycles: u64) -> Result<Done, DemoError> {
    let bar = bar(cycles);
    let response = received(client.get(format!("{own}/events"))).await?;
    let mut events = response.bytes_stream().eventsource();
    while let Some(event) = events.next().await {
        let event = event.map_err(|error| DemoError::Stream(error.to_string()))?;
        match event.event.as_str() {
            "progress" => {
                let progress: Progress = serde_json::from_str(&event.data)?;
                bar.set_position(progress.cycle);
                if let Some(phase) = progress.phase {
                    bar.set_message(phase.as_str());
                }
            }
            "done" => {
                bar.finish_and_clear();
                return Ok(serde_json::from_str(&event.data)?);
            }
            _ => {}
        }
    }
    Err(DemoError::Stream(
        "the stream ended before the job".to_owned(),
    ))
}

fn next_steps(base: &str, own: &str) -> [String; 7] {
    [
        String::new(),
        "Where to look next:".to_owned(),
        format!("  curl {own}"),
        format!("  curl -N {own}/events"),
        format!("  curl '{own}/results/wear-history?format=csv'"),
        format!("  curl '{own}/results/profile?cycle=240'"),
        format!("  curl --json @SPEC.json {base}/v1/jobs        (and {base}/openapi.json)"),
    ]
}
