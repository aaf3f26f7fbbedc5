//! The service: store, workers, maintenance and HTTP, started and stopped together.

mod batch_endings;
mod expansions;
mod maintenance;
mod objects;
mod tasks;
mod workers;

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use tokio::net::{TcpListener, TcpSocket};
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use crate::http;
use crate::http::{Access, App, Tls};
use crate::objects::Objects;
use crate::service::tasks::Tasks;
use crate::store::{Limits, Store, StoreError, shown_address};
use crate::supervision::Supervisor;
use crate::worker::{REMOTE_LEASE, WorkerConfig};

/// Time for open requests to end when the service stops, after the grace period of solving processes.
const GRACE: Duration = Duration::from_secs(5);
/// Connections that may wait to be accepted, as far as the system allows: a client that finds no place tries again after 1 s.
const BACKLOG: u32 = 1_024;

/// Waiting jobs of a large sweep beyond which no more of it are queued, unless another number is given: those of a minute at 333 ends a
/// second.
pub const JOBS_AHEAD: u64 = 20_000;

/// Configuration of the service.
#[derive(Debug, Clone)]
pub struct Config {
    /// Address to listen on; loopback unless an access token is required.
    pub listen: SocketAddr,
    /// Access control.
    pub access: Access,
    /// Certificate and key; plain HTTP without.
    pub tls: Option<Tls>,
    /// Address of the database, `sqlite://PATH` or `postgres://USER@HOST/NAME`.
    pub database: String,
    /// Where the large results of a PostgreSQL database are: in the folder of this name with `.results` behind it.
    pub files: PathBuf,
    /// Store of objects that results are moved to.
    pub objects: Option<Objects>,
    /// Number of jobs solved at the same time.
    pub workers: usize,
    /// Limits of the store.
    pub limits: Limits,
    /// Days after which ended jobs are deleted.
    pub keep_days: Option<u32>,
    /// Waiting jobs of a large sweep beyond which no more of it are queued.
    pub jobs_ahead: u64,
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
    /// The long-lived tasks.
    pub supervisor: Arc<Supervisor>,
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
        if shows_token(config.listen, config.tls.is_some()) {
            tracing::warn!(listen = %config.listen, "the access token is sent unencrypted; use --tls-certificate, or a proxy with TLS on this machine");
        }
        let listen = |cause| ServiceError::Listen {
            address: config.listen,
            cause,
        };
        let listener = bound(config.listen).map_err(listen)?;
        let address = listener.local_addr().map_err(listen)?;
        let store = Store::open_with(&config.database, &config.files, config.limits).await?;
        let moves_results = config.objects.is_some();
        let store = Arc::new(store.with_objects(config.objects).await?);
        store.test_objects().await?;
        let worker = Arc::new(config.worker);
        let reclaimed = store.reclaim_at_start(worker.lease, REMOTE_LEASE).await?;
        let (queued, ending) = (reclaimed.queued, reclaimed.ending.len());
        tracing::info!(%address, database = shown_address(&config.database), workers = config.workers, queued, ending, "service started");
        let (stopping, supervisor) = (CancellationToken::new(), Arc::new(Supervisor::default()));
        let mut tasks = Tasks::new(&store, &supervisor, &stopping);
        let health = tasks.start_workers(config.workers, &worker);
        let app = App::new(
            Arc::clone(&store),
            config.access,
            stopping.clone(),
            Arc::clone(&supervisor),
            http::openapi::document(),
        )
        .with_workers(health);
        app.workers.exchange(&store).await;
        tasks.start_upkeep(&app, &worker, config.keep_days, reclaimed);
        if moves_results {
            tasks.start_one("objects", objects::move_results);
        }
        tasks.start_queueing(&app, config.jobs_ahead);
        let router = http::router(app);
        let (mut listener, served) = (Some(listener), stopping.clone());
        tasks.start(("listener", 0), move || {
            let tls = config.tls.clone();
            serve(
                listener.take(),
                tls,
                address,
                router.clone(),
                served.clone(),
            )
        });
        Ok(Self {
            address,
            store,
            stopping,
            supervisor,
            tasks: tasks.running,
            grace: worker.grace + GRACE,
        })
    }

    /// Returns when the service has begun to stop by itself, because another process serves its database.
    pub async fn ended(&self) {
        self.stopping.cancelled().await;
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

/// Checks whether tokens that are sent to an address can be read on the way.
fn shows_token(listen: SocketAddr, is_encrypted: bool) -> bool {
    !listen.ip().is_loopback() && !is_encrypted
}

/// Serves on the listener of the start, or on a new one at the same address.
async fn serve(
    listener: Option<TcpListener>,
    tls: Option<Tls>,
    address: SocketAddr,
    router: Router,
    stopping: CancellationToken,
) {
    let bound = match listener {
        Some(listener) => Ok(listener),
        None => bound(address),
    };
    match bound {
        Ok(listener) => http::serve(listener, tls, router, stopping).await,
        Err(error) => tracing::error!(%error, %address, "cannot listen again"),
    }
}

/// Listens at an address.
fn bound(address: SocketAddr) -> std::io::Result<TcpListener> {
    let socket = if address.is_ipv4() {
        TcpSocket::new_v4()?
    } else {
        TcpSocket::new_v6()?
    };
    // Connections of the last process that are still being closed keep the address from nobody.
    #[cfg(unix)]
    socket.set_reuseaddr(true)?;
    socket.bind(address)?;
    socket.listen(BACKLOG)
}

#[cfg(test)]
mod tests;
