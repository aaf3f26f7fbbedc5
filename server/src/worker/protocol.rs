//! Messages between remote workers and the service under `/v1/worker/`: JSON, between programs of the same version, which the
//! service checks. They are no part of the interface that users rely on.

use std::time::Duration;

use api::job::Status;
use api::problem::Problem;
use serde::{Deserialize, Serialize};
use uuid::Uuid;

use crate::store::{ClaimRequest, Lease, LeaseState, NewContent};

/// Program of a worker or a service: version and commit. Another one need not give the same bits.
pub const PROGRAM: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    " (",
    env!("FRETWEAR_COMMIT"),
    ")"
);

/// Longest wait for a job in one request: a third of the time after which a client takes a silent connection for broken.
pub const LONGEST_WAIT: Duration = Duration::from_secs(20);

/// Lengths of leases that a worker can have: below, it could not renew them in time; above, a lost job would wait for long. Arbitrary.
const SHORTEST_LEASE: Duration = Duration::from_secs(1);
const LONGEST_LEASE: Duration = Duration::from_mins(10);
/// Largest number of jobs that one request can claim, beside short ones ahead.
pub const MAX_SLOTS: usize = 256;

/// The length of a lease that a worker gets which asks for this one.
pub fn lease_length(asked: Duration) -> Duration {
    asked.clamp(SHORTEST_LEASE, LONGEST_LEASE)
}

/// Body of `POST claims`, answered with the claims once there is a job.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ClaimBody {
    /// [`PROGRAM`] of the worker.
    pub program: String,
    /// Name of its machine.
    pub host: String,
    /// Number of jobs that it solves at once.
    pub slots: usize,
    /// Request for jobs.
    pub request: ClaimRequest,
    /// Longest wait for a job, up to [`LONGEST_WAIT`].
    pub wait: Duration,
}

/// Body of `POST leases`, answered with the state of each.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct LeasesBody {
    /// The worker.
    pub worker: Uuid,
    /// All its leases.
    pub leases: Vec<Lease>,
    /// For how long they are renewed.
    pub length: Duration,
    /// Why it starts no solves at present.
    pub failing: Option<String>,
}

/// Largest number of leases in a heartbeat; a worker with more sends several. Arbitrary: a slot holds one job, and short ones ahead.
pub const MOST_LEASES: usize = 4096;

/// Largest number of writes in a request.
pub const MOST_WRITES: usize = 256;

/// Answer to a write. Body of `POST writes` are some, answered with one to each, in the same order; those of one job are done one after the
/// other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WriteAnswer {
    /// The lease of an update.
    Lease(LeaseState),
    /// The status of a job after its end; null if the lease was lost.
    Status(Option<Status>),
    /// The write was not done.
    Problem(Problem),
    /// The write is in progress and would delay the others; a request with it alone returns its result.
    Pending,
}

/// Body of `POST restarts`, answered with the state of the lease.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct RestartBody {
    /// The lease.
    pub lease: Lease,
    /// Number of the write.
    pub number: i64,
}

/// Answer to `PUT files/{job}/{lease}/{name}`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Taken {
    /// Where the file is, which the update that names it has to say.
    pub content: NewContent,
}
