//! The running service: store, workers, maintenance and HTTP, started and stopped together.

mod upkeep;

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
use crate::worker::Rules;

/// How long a stop waits for open requests, beyond what solving processes are given.
const GRACE: Duration = Duration::from_secs(5);

/// How the service is to run.
#[derive(Debug, Clone)]
pub struct Config {
    /// Where it listens; a loopback address unless a token is asked for.
    pub listen: SocketAddr,
    /// Who may ask.
    pub access: Access,
    /// Its database, `sqlite://PATH`.
    pub database: String,
    /// How many jobs are solved at once.
    pub workers: usize,
    /// How often a job is tried whose workers are lost.
    pub attempts: u32,
    /// After how many days ended jobs are deleted, if they are.
    pub keep_days: Option<u32>,
    /// How workers work.
    pub rules: Rules,
}

/// Why the service cannot run.
#[derive(Debug, thiserror::Error)]
pub enum ServiceError {
    /// Listening elsewhere than on loopback is not safe without a token.
    #[error(
        "{0} is not a loopback address; listening elsewhere needs an access token (--token-file)"
    )]
    NotLoopback(SocketAddr),
    /// The address cannot be taken.
    #[error("cannot listen on {address}: {cause}")]
    Listen {
        /// The address.
        address: SocketAddr,
        /// Why.
        cause: std::io::Error,
    },
    /// The store cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// A running service.
#[derive(Debug)]
pub struct Service {
    /// Where it listens.
    pub address: SocketAddr,
    store: Arc<Store>,
    stopping: CancellationToken,
    tasks: JoinSet<()>,
    grace: Duration,
}

impl Service {
    /// Starts everything. Jobs that an ended process left running are queued again first.
    ///
    /// # Errors
    /// [`ServiceError`]; nothing keeps running then.
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
        let rules = Arc::new(config.rules);
        let rescued = store.rescue_all(rules.lease_end()).await?;
        let (queued, ending) = (rescued.queued, rescued.ending.len());
        tracing::info!(%address, database = config.database, workers = config.workers, queued, ending, "service started");
        let stopping = CancellationToken::new();
        let mut tasks = JoinSet::new();
        for _ in 0..config.workers {
            tasks.spawn(worker::work(
                Arc::clone(&store),
                Arc::clone(&rules),
                stopping.clone(),
            ));
        }
        tasks.spawn(upkeep::maintain(
            Arc::clone(&store),
            Arc::clone(&rules),
            config.keep_days,
            rescued,
            stopping.clone(),
        ));
        let router = http::router(App::new(
            Arc::clone(&store),
            config.access,
            stopping.clone(),
        ));
        tasks.spawn(http::serve(listener, router, stopping.clone()));
        Ok(Self {
            address,
            store,
            stopping,
            tasks,
            grace: rules.grace + GRACE,
        })
    }

    /// Stops everything: streams end, running jobs go back to the queue without costing an attempt.
    pub async fn stop(mut self) {
        self.stopping.cancel();
        let ended = async { while self.tasks.join_next().await.is_some() {} };
        if tokio::time::timeout(self.grace, ended).await.is_err() {
            // A client that neither sends nor receives must not keep the service alive.
            tracing::warn!("connections that would not end are broken off");
            self.tasks.shutdown().await;
        }
        self.store.close().await;
        tracing::info!("service stopped");
    }
}
