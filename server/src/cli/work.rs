//! `fretwear work`: workers for a remote service.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use crate::cli::arguments::WorkArguments;
use crate::cli::runtime::block_on;
use crate::cli::signals::until_signal;
use crate::cli::terminal::{Ended, failed};
use crate::program;
use crate::worker;
use crate::worker::{JobSourceError, Remote, RemoteOptions, WorkerProcess};

/// Rounds of declined attempts in a row after which the process ends, so that whoever has started it learns that it does not work: some two
/// minutes.
const MOST_DECLINED: usize = 8;
/// Pause before a worker is started for one that has panicked.
const RESTART_PAUSE: Duration = Duration::from_secs(1);

pub(super) fn run(arguments: &WorkArguments) -> Ended {
    let client = arguments.service.client()?;
    let config = Arc::new(arguments.work.config(program::own()));
    let scratch = Scratch::new(arguments.scratch.as_deref()).map_err(failed)?;
    block_on(async {
        let signal = until_signal();
        let process = Arc::new(WorkerProcess::new(config.memory_mb, true));
        let slots = arguments.work.slots();
        let remote = Arc::new(Remote::new(RemoteOptions {
            client,
            worker: process.id(),
            health: Arc::clone(process.health()),
            slots,
            scratch: scratch.0.clone(),
            lease: config.lease,
            wait: arguments.work.wait(),
        }));
        let stopping = CancellationToken::new();
        let start = || {
            let (process, config) = (Arc::clone(&process), Arc::clone(&config));
            worker::work(Arc::clone(&remote), process, config, stopping.clone())
        };
        let mut workers: JoinSet<_> = (0..slots).map(|_| start()).collect();
        tracing::info!(
            server = arguments.service.server,
            slots,
            memory_mb = config.memory_mb,
            "worker started"
        );
        let ended = tokio::select! {
            ended = all(&mut workers, start) => ended.map_err(failed),
            cause = process.health().declined_in_a_row(MOST_DECLINED) => Err(failed(format_args!(
                "no job could be solved here {MOST_DECLINED} times in a row; the last time: {cause}"
            ))),
            signal = signal => signal.map_err(failed),
        };
        // Running solves write a last checkpoint, and their jobs return to the queue.
        stopping.cancel();
        let drained = all(&mut workers, start).await.map_err(failed);
        tracing::info!("worker stopped");
        ended.and(drained)
    })?
}

/// Waits for all workers, or for one that is not accepted; starts another for one that has panicked.
async fn all<F>(
    workers: &mut JoinSet<Result<(), JobSourceError>>,
    start: impl Fn() -> F,
) -> Result<(), JobSourceError>
where
    F: Future<Output = Result<(), JobSourceError>> + Send + 'static,
{
    while let Some(ended) = workers.join_next().await {
        if let Ok(ended) = ended {
            ended?;
        } else {
            // The job of the worker is reclaimed when the lease ends.
            tracing::error!("a worker has ended by a panic; another one is started");
            tokio::time::sleep(RESTART_PAUSE).await;
            workers.spawn(start());
        }
    }
    Ok(())
}

/// A folder of this process, removed when it is dropped.
struct Scratch(PathBuf);

impl Scratch {
    fn new(folder: Option<&Path>) -> std::io::Result<Self> {
        let parent = folder.map_or_else(std::env::temp_dir, Path::to_owned);
        let path = parent.join(format!("fretwear-work-{}", std::process::id()));
        fs_err::create_dir_all(&path)?;
        Ok(Self(path))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // Another process has no use for the remaining files.
        let _ = fs_err::remove_dir_all(&self.0);
    }
}
