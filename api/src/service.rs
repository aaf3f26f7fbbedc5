//! Present state of a service (`GET /v1/service`), and the labels of its jobs.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Name of the program in the answer of `GET /readyz`, by which a probe tells it from other services.
pub const SERVICE: &str = "fretwear";

/// The service in a few figures.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct ServiceOverview {
    /// Version of the program.
    pub version: String,
    /// Number of jobs by status, including statuses that no job has.
    pub jobs: BTreeMap<String, u64>,
    /// Workers.
    pub workers: Workers,
    /// Age of the job that waits longest, s; null if none waits.
    pub oldest_queued_s: Option<u64>,
    /// Free space on the disk of the database, MiB; null if it is not known.
    pub free_disk_mb: Option<u64>,
    /// True if it is about to stop and claims no job.
    pub stopping: bool,
}

/// Workers of a service.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Workers {
    /// Those that run.
    pub total: u64,
    /// Those that solve a job.
    pub busy: u64,
}

/// Labels that jobs have (`GET /v1/labels`).
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Labels {
    /// By key; of each key the most frequent values first.
    pub labels: Vec<LabelInUse>,
    /// True if there are more than these.
    pub more: bool,
}

/// A label and the number of jobs that have it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct LabelInUse {
    /// Key.
    pub key: String,
    /// Value.
    pub value: String,
    /// Jobs that have it.
    pub jobs: u64,
}

/// Demand for workers, as processes that place workers request it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Demand {
    /// Jobs that wait.
    pub queued: u64,
    /// Jobs that run.
    pub running: u64,
    /// Running jobs that remote workers solve.
    pub running_remotely: u64,
    /// Estimated processor time of the waiting jobs, s; a minute for one without an estimate.
    pub queued_cpu_s: u64,
}
