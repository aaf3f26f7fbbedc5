//! Batches, which are parameter sweeps or accuracy studies, as lists show them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

/// A batch without its jobs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct BatchOverview {
    /// Id.
    pub id: Uuid,
    /// Name for people.
    pub name: Option<String>,
    /// Time of its submission (RFC 3339).
    #[schema(format = DateTime)]
    pub created_at: String,
    /// Number of its jobs by status, including statuses that no job has, without those that are still to be queued.
    pub counts: BTreeMap<String, u64>,
    /// Number of jobs that are still to be queued.
    pub to_come: u64,
    /// Related resources: relation to path.
    pub links: BTreeMap<String, String>,
}
