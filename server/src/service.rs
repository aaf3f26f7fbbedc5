//! The service: store, workers, maintenance and HTTP, started and stopped together.

mod maintenance;

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use crate::http;
use crate::http::{Access, App};
use crate::store::{Store, StoreError};
use crate::worker;
use crate::worker::WorkerConfig;

/// Time for open requests to end when the service stops, after the grace period of solving processes.
const GRACE: Duration = Duration::from_secs(5);

/// Configuration of the service.
#[derive(Debug, Clone)]
pub struct Config {
    /// Address to listen on; loopback unless an access token is required.
    pub listen: SocketAddr,
    /// Access control.
    pub access: Access,
    /// Address of the database, `sqlite://PATH`.
    pub database: String,
    /// Number of jobs solved at the same time.
    pub workers: usize,
    /// Largest number of attempts at a job whose workers are lost.
    pub attempts: u32,
    /// Days after which ended jobs are deleted.
    pub keep_days: Option<u32>,
    /// Configuration of the workers.
    pub worker: WorkerConfig,
}

/// Why the service cannot start.
#[derive(Debug, thiserror::Error)]
pub enum ServiceError {
    /// Listening beyond loopback requires an access token.
    #[error(
        "{0} is not a loopback address; listening elsewhere needs an access token (--token-file)"
    )]
    NotLoopback(SocketAddr),
    /// The address cannot be bound.
    #[error("cannot listen on {address}: {cause}")]
    Listen {
        /// The address.
        address: SocketAddr,
        /// The system's error.
        cause: std::io::Error,
    },
    /// The store cannot be opened.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// A running service.
#[derive(Debug)]
pub struct Service {
    /// Address that it listens on.
    pub address: SocketAddr,
    store: Arc<Store>,
    stopping: CancellationToken,
    tasks: JoinSet<()>,
    grace: Duration,
}

impl Service {
    /// Starts everything, after reclaiming the jobs of a process that has ended.
    ///
    /// # Errors
    /// [`ServiceError`]; nothing is left running.
    pub async fn start(config: Config) -> Result<Self, ServiceError> {
        if !config.listen.ip().is_loopback() && !config.access.requires_token() {
            return Err(ServiceError::NotLoopback(config.listen));
        }
        let listen = |cause| ServiceError::Listen {
            address: config.listen,
            cause,
        };
        let listener = TcpListener::bind(config.listen).await.map_err(listen)?;
        let address = listener.local_addr().map_err(listen)?;
        let store = Arc::new(Store::open_with(&config.database, config.attempts).await?);
        let worker = Arc::new(config.worker);
        let reclaimed = store.reclaim_all(worker.lease_end()).await?;
        let (queued, ending) = (reclaimed.queued, reclaimed.ending.len());
        tracing::info!(%address, database = config.database, workers = config.workers, queued, ending, "service started");
        let stopping = CancellationToken::new();
        let mut tasks = JoinSet::new();
        for _ in 0..config.workers {
            tasks.spawn(worker::work(
                Arc::clone(&store),
                Arc::clone(&worker),
                stopping.clone(),
            ));
        }
        tasks.spawn(maintenance::maintain(
            Arc::clone(&store),
            Arc::clone(&worker),
            config.keep_days,
            reclaimed,
            stopping.clone(),
        ));
        let router = http::router(App::new(
            Arc::clone(&store),
            config.access,
            stopping.clone(),
            http::openapi::document(),
        ));
        tasks.spawn(http::serve(listener, router, stopping.clone()));
        Ok(Self {
            address,
            store,
            stopping,
            tasks,
            grace: worker.grace + GRACE,
        })
    }

    /// Stops everything: streams end, running jobs return to the queue without losing an attempt.
    pub async fn stop(mut self) {
        self.stopping.cancel();
        let ended = async { while self.tasks.join_next().await.is_some() {} };
        if tokio::time::timeout(self.grace, ended).await.is_err() {
            // A client that neither sends nor receives must not block the stop.
            tracing::warn!("connections that did not end in time are aborted");
            self.tasks.shutdown().await;
        }
        self.store.close().await;
        tracing::info!("service stopped");
    }
}
