//! Tokens of workers elsewhere (`/v1/worker-tokens`).

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

/// A token to be made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct NewWorkerToken {
    /// What it is for, such as the name of a cluster: 1 to 100 characters, not all of them blank.
    #[schema(min_length = 1, max_length = 100, pattern = r"\S")]
    pub name: String,
}

/// A token of workers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct WorkerToken {
    /// Its id.
    pub id: Uuid,
    /// What it is for.
    pub name: String,
    /// When it was made.
    pub created_at: String,
    /// When it was revoked; null while it is valid.
    pub revoked_at: Option<String>,
}

/// A token that was just made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct CreatedWorkerToken {
    /// Its entry.
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
