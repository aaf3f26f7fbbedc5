//! Workers (`GET /v1/workers`), and tokens of remote ones (`/v1/worker-tokens`).

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

use crate::service::Workers;

/// A token to be made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct NewWorkerToken {
    /// Purpose, such as the name of a cluster: 1 to 100 characters, not all of them blank, none U+0000.
    #[schema(
        min_length = 1,
        max_length = 100,
        pattern = r"^[^\x00]*[^\s\x00][^\x00]*$"
    )]
    pub name: String,
}

/// A token of workers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct WorkerToken {
    /// Id.
    pub id: Uuid,
    /// Purpose, such as the name of a cluster.
    pub name: String,
    /// When it was made.
    pub created_at: String,
    /// When it was revoked; null while it is valid.
    pub revoked_at: Option<String>,
}

/// A token that was just made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct CreatedWorkerToken {
    /// Entry.
    #[serde(flatten)]
    pub entry: WorkerToken,
    /// The token itself, which is not stored and not shown again.
    pub token: String,
}

/// Tokens of workers, oldest first.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct WorkerTokens {
    /// The tokens, also revoked ones.
    pub tokens: Vec<WorkerToken>,
}

/// Workers of a service.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct WorkerList {
    /// Those in the process of the service.
    pub local: Workers,
    /// Remote processes that were in contact within the last minute, longest known first.
    pub remote: Vec<RemoteWorker>,
}

/// A process with remote workers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct RemoteWorker {
    /// Id, new with each start.
    pub id: Uuid,
    /// Name of its machine.
    pub host: String,
    /// Number of jobs that it solves at once.
    pub slots: u64,
    /// Jobs that it holds; some may wait for a slot.
    pub jobs: u64,
    /// Memory for its solves, MB.
    pub memory_mb: u64,
    /// Part of it that no solve uses, MB.
    pub free_memory_mb: u64,
    /// Time since it was last in contact, s.
    pub last_contact_s: u64,
    /// True if it takes no more jobs, and ends when it has solved those that it holds.
    pub is_draining: bool,
    /// Why it starts no solves at present, and gives the jobs back that it claims; null if its last one has started.
    pub failing: Option<String>,
}
