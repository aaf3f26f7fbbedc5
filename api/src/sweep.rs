//! Sweeps: many jobs as variations of one specification.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;
use uuid::Uuid;

use crate::job::{Outcome, Status};
use crate::spec::Spec;

/// What one job changes in the base specification: JSON pointer (RFC 6901) to value.
pub type Changes = BTreeMap<String, Value>;

/// A sweep as it is submitted: either a grid or a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepRequest {
    /// A name for people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The specification that all jobs start from.
    #[schema(value_type = Spec)]
    pub base: Value,
    /// JSON pointer to values; one job for each combination, the last pointer varying fastest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<BTreeMap<String, Vec<Value>>>,
    /// One job for each entry.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Vec<BTreeMap<String, Value>>>)]
    pub list: Option<Vec<Changes>>,
}

/// A job of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SweepJob {
    /// The job.
    pub id: Uuid,
    /// What sets it apart.
    #[schema(value_type = BTreeMap<String, Value>)]
    pub overrides: Changes,
    /// Where it stands.
    pub status: Status,
    /// How its solve ended.
    pub outcome: Option<Outcome>,
}

/// A sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Sweep {
    /// Its name in the service.
    pub id: Uuid,
    /// Its name for people.
    pub name: Option<String>,
    /// When it was accepted (RFC 3339).
    pub created_at: String,
    /// Number of its jobs by status; every status is there.
    pub counts: BTreeMap<String, u64>,
    /// Its jobs in order; deleted ones are gone from here too.
    pub jobs: Vec<SweepJob>,
    /// Where to go from here: relation to path.
    pub links: BTreeMap<String, String>,
}

/// A sweep without its jobs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct SweepOverview {
    /// Its name in the service.
    pub id: Uuid,
    /// Its name for people.
    pub name: Option<String>,
    /// When it was accepted (RFC 3339).
    pub created_at: String,
    /// Number of its jobs by status; every status is there.
    pub counts: BTreeMap<String, u64>,
    /// Where to go from here: relation to path.
    pub links: BTreeMap<String, String>,
}

/// A page of sweeps, newest first.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct SweepList {
    /// The sweeps.
    pub sweeps: Vec<SweepOverview>,
    /// Where the next page starts, if there is one.
    pub next_page_token: Option<String>,
}
