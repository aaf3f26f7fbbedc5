//! `fretwear demo`: the fuzz-button job, end to end, through the service's own HTTP API.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::pin::pin;

use api::event::Done;
use api::job::Status;
use api::results::WearHistory;
use uuid::Uuid;

use crate::cli::client::follow;
use crate::cli::runtime::{block_on, or_processors};
use crate::cli::signals::until_signal;
use crate::cli::table;
use crate::cli::terminal::{Ended, failed, write_err, write_out};
use crate::client::{Client, ClientError};
use crate::http::Access;
use crate::program;
use crate::service::{Config, JOBS_AHEAD, Service, ServiceError};
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
    #[error("{0}")]
    Client(#[from] ClientError),
    #[error("its results cannot be shown")]
    Output,
    #[error("the job ended as {}: {}", .0.status.as_str(), .0.status_reason.as_deref().unwrap_or("no reason given"))]
    Ended(Box<Done>),
}

pub(super) fn run(listen: SocketAddr, exit: bool) -> Ended {
    block_on(demonstrate(listen, exit))?.map_err(failed)
}

async fn demonstrate(listen: SocketAddr, exit: bool) -> Result<(), DemoError> {
    let mut signal = pin!(until_signal());
    let folder = PathBuf::from("fretwear-data").join(format!("demo-{}", Uuid::now_v7()));
    fs_err::create_dir_all(&folder)?;
    let database = format!("sqlite://{}", folder.join("fretwear.db").display());
    let start = Service::start(Config {
        listen,
        tls: None,
        access: Access::default(),
        files: folder.join("fretwear"),
        database,
        objects: None,
        workers: or_processors(None),
        limits: Limits::default(),
        keep_days: None,
        jobs_ahead: JOBS_AHEAD,
        worker: WorkerConfig::new(program::own()),
    });
    let service = tokio::select! {
        service = start => service?,
        signal = &mut signal => return Ok(signal?),
    };
    let base = format!("http://{}", service.address);
    write_err(format_args!(
        "fretwear serves on {base}, its data in {}",
        folder.display()
    ));
    let shown = tokio::select! {
        shown = show_job(&base) => shown,
        signal = &mut signal => {
            service.stop().await;
            return Ok(signal?);
        }
    };
    if let (Ok(()), false) = (&shown, exit) {
        write_err("the service continues; press Ctrl-C to stop it");
        signal.await?;
    }
    service.stop().await;
    shown
}

/// Submits the job, waits for its end and shows its results.
async fn show_job(base: &str) -> Result<(), DemoError> {
    let client = Client::new(base, None, None)?;
    let key = Uuid::now_v7().to_string();
    let id = client.submit(SPEC.into(), &[], &key).await?.id;
    let done = follow(&client, id).await?;
    if done.status != Status::Succeeded {
        return Err(DemoError::Ended(Box::new(done)));
    }
    let job = client.job(id).await?;
    let history: WearHistory = client
        .get(&format!("/v1/jobs/{id}/results/wear-history"), &[])
        .await?;
    let report = table::report(&job, &history);
    for line in report.into_iter().chain(next_steps(base, id)) {
        write_out(line).map_err(|_| DemoError::Output)?;
    }
    Ok(())
}

fn next_steps(base: &str, id: Uuid) -> [String; 9] {
    let own = format!("{base}/v1/jobs/{id}");
    [
        String::new(),
        "Where to look next:".to_owned(),
        format!("  curl {own}"),
        format!("  curl -N {own}/events"),
        format!("  curl '{own}/results/wear-history?format=csv'"),
        format!("  curl '{own}/results/profile?cycle=240'"),
        format!("  fretwear fetch {id} --out results --server {base}"),
        format!("  fretwear submit SPEC.json --watch --server {base}"),
        format!("  curl --json @SPEC.json {base}/v1/jobs        (and {base}/openapi.json)"),
    ]
}
