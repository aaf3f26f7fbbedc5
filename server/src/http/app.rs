//! State that the routes share, and the limits of its resources.

use std::sync::Arc;

use serde_json::Value;
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

use crate::estimate::machine::CalibrationCache;
use crate::http::access::Access;
use crate::http::slots::Slots;
use crate::http::worker_registry::WorkerRegistry;
use crate::store::Store;
use crate::supervision::Supervisor;
use crate::worker::WorkerHealth;

/// Maximum number of concurrent requests, over all connections; more wait. Event streams count until their response starts; long polls
/// have a lower limit of their own.
pub(super) const MAX_REQUESTS: usize = 1024;
/// Maximum number of waiting long polls; another one is answered at once, as if it had timed out.
pub(super) const MAX_LONG_POLLS: usize = 768;
/// Maximum number of open event streams.
pub(super) const MAX_STREAMS: usize = 1024;
/// Maximum number of concurrent archives: each occupies a thread for as long as its client takes to read it.
pub(super) const MAX_ARCHIVES: usize = 4;
/// Largest number of studies that are expanded at once: each occupies a processor for up to seconds.
pub(super) const MAX_EXPANSIONS: usize = 2;

/// State that the routes share.
#[derive(Debug, Clone)]
pub struct App {
    /// Job store.
    pub store: Arc<Store>,
    /// Cancelled at shutdown; ends streams and long polls.
    pub stopping: CancellationToken,
    /// The long-lived tasks of the service.
    pub(super) supervisor: Arc<Supervisor>,
    pub(super) access: Access,
    /// OpenAPI document of the interface.
    pub(super) document: &'static Value,
    /// Measured speed of this machine.
    pub(crate) machine: CalibrationCache,
    pub(super) archive_slots: Slots,
    /// Slots to expand a study into its jobs.
    pub(super) expansion_slots: Slots,
    pub(super) long_poll_permits: Arc<Semaphore>,
    /// Permits of requests whose body has arrived.
    pub(super) request_permits: Arc<Semaphore>,
    pub(super) stream_permits: Arc<Semaphore>,
    /// Processes with remote workers.
    pub(crate) workers: Arc<WorkerRegistry>,
    /// Health of the workers in this process.
    pub(crate) health: Arc<WorkerHealth>,
}

impl App {
    /// State over a store and the tasks of a service, with the OpenAPI document of the interface.
    pub fn new(
        store: Arc<Store>,
        access: Access,
        stopping: CancellationToken,
        supervisor: Arc<Supervisor>,
        document: &'static Value,
    ) -> Self {
        Self {
            machine: CalibrationCache::open(Some(store.machine_file())),
            store,
            stopping,
            supervisor,
            access,
            document,
            archive_slots: Slots::new(MAX_ARCHIVES),
            expansion_slots: Slots::new(MAX_EXPANSIONS),
            long_poll_permits: Arc::new(Semaphore::new(MAX_LONG_POLLS)),
            request_permits: Arc::new(Semaphore::new(MAX_REQUESTS)),
            stream_permits: Arc::new(Semaphore::new(MAX_STREAMS)),
            workers: Arc::default(),
            health: Arc::default(),
        }
    }

    /// The same with workers in this process.
    #[must_use]
    pub fn with_workers(self, health: Arc<WorkerHealth>) -> Self {
        Self { health, ..self }
    }
}
