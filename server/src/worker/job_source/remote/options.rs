//! Options of workers of a remote service.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use uuid::Uuid;

use crate::client::Client;
use crate::worker::health::WorkerHealth;

/// A process with workers, and the service that they work for.
#[derive(Debug, Clone)]
pub struct RemoteOptions {
    /// Reaches the service.
    pub client: Client,
    /// The process.
    pub worker: Uuid,
    /// Health of its workers.
    pub health: Arc<WorkerHealth>,
    /// Number of jobs that are solved at once.
    pub slots: usize,
    /// Folder of the files of attempts until they are sent.
    pub scratch: PathBuf,
    /// For how long leases are renewed.
    pub lease: Duration,
    /// How long a claim waits for a job.
    pub wait: Duration,
}
