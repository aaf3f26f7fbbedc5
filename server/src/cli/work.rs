//! `fretwear work`: workers for a service elsewhere.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use crate::cli::arguments::WorkArguments;
use crate::cli::runtime::block_on;
use crate::cli::serve::until_signal;
use crate::cli::terminal::{Ended, failed, write_err};
use crate::worker;
use crate::worker::{EmployerError, Remote, WorkerProcess};

pub(super) fn run(arguments: &WorkArguments) -> Ended {
    let program = std::env::current_exe().map_err(failed)?;
    let client = arguments.client()?;
    let config = Arc::new(arguments.work.config(program));
    let scratch = Scratch::new(arguments.scratch.as_deref()).map_err(failed)?;
    block_on(async {
        let process = Arc::new(WorkerProcess::new(config.memory_mb, true));
        let slots = arguments.work.slots();
        let remote = Arc::new(Remote::new(
            (client, process.id(), slots),
            scratch.0.clone(),
            (config.lease, arguments.work.wait()),
        ));
        let stopping = CancellationToken::new();
        let mut workers = JoinSet::new();
        for _ in 0..slots {
            let shared = (Arc::clone(&process), Arc::clone(&config));
            workers.spawn(worker::work(Arc::clone(&remote), shared, stopping.clone()));
        }
        tracing::info!(
            server = arguments.server,
            slots,
            memory_mb = config.memory_mb,
            "worker started"
        );
        let ended = tokio::select! {
            ended = all(&mut workers) => ended.map_err(failed),
            signal = until_signal() => signal.map_err(failed),
        };
        // Running solves write a last checkpoint, and their jobs return to the queue.
        stopping.cancel();
        let drained = all(&mut workers).await.map_err(failed);
        tracing::info!("worker stopped");
        ended.and(drained)
    })?
}

/// Waits for all workers, or for one that is not accepted.
async fn all(workers: &mut JoinSet<Result<(), EmployerError>>) -> Result<(), EmployerError> {
    while let Some(ended) = workers.join_next().await {
        match ended {
            Ok(ended) => ended?,
            // Its job is reclaimed when the lease ends.
            Err(error) => write_err(format_args!("a worker has ended: {error}")),
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
        // What is left is of no use to another process.
        let _ = fs_err::remove_dir_all(&self.0);
    }
}
