//! Parameter sweeps: many jobs as variations of one specification.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use utoipa::ToSchema;
use uuid::Uuid;

use crate::batch::BatchOverview;
use crate::job::{Outcome, Status};
use crate::spec::Spec;

/// Changes of one job against the base specification: JSON pointer (RFC 6901) to value.
pub type Changes = BTreeMap<String, Value>;

/// A sweep to be submitted: either a grid or a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepRequest {
    /// Name for people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The specification that is varied.
    #[schema(value_type = Spec)]
    pub base: Value,
    /// JSON pointer to values; one job per combination, the last pointer varying fastest; at most 1 000 000. Of more than 1 000, the
    /// first are queued at once and the others while these are solved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<BTreeMap<String, Vec<Value>>>,
    /// One job per entry; at most 1 000.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Vec<BTreeMap<String, Value>>>)]
    pub list: Option<Vec<Changes>>,
}

/// Expected cost of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SweepPlan {
    /// Number of its jobs.
    pub jobs: u64,
    /// Processor seconds of all jobs together, by the mean of up to 16 of them: likely (`cpu_s`) and enough in nine of ten cases
    /// (`cpu_s_most`). Absent where none of these makes a valid job, or the machine could not be calibrated.
    pub estimates: BTreeMap<String, f64>,
}

/// A job of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SweepJob {
    /// The job.
    pub id: Uuid,
    /// Number in the sweep, from 0.
    pub position: u64,
    /// Changes against the base.
    #[schema(value_type = BTreeMap<String, Value>)]
    pub overrides: Changes,
    /// Status.
    pub status: Status,
    /// How its solve ended.
    pub outcome: Option<Outcome>,
}

/// Changes that make no valid job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RefusedChanges {
    /// Their number in the sweep, from 0.
    pub position: u64,
    /// The changes against the base.
    #[schema(value_type = BTreeMap<String, Value>)]
    pub overrides: Changes,
    /// Fault of the changes.
    pub reason: String,
}

/// A sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Sweep {
    /// Id.
    pub id: Uuid,
    /// Name for people.
    pub name: Option<String>,
    /// Time of its submission (RFC 3339).
    #[schema(format = DateTime)]
    pub created_at: String,
    /// Number of its jobs by status, including statuses that no job has, without those that are still to be queued.
    pub counts: BTreeMap<String, u64>,
    /// Number of jobs that were asked for, of a sweep of more than 1 000.
    pub asked: Option<u64>,
    /// The grid that was asked for, of such a sweep.
    pub grid: Option<BTreeMap<String, Vec<Value>>>,
    /// Number of jobs that are still to be queued; 0 if it was cancelled.
    pub to_come: u64,
    /// Number of jobs that were still to be queued when it was cancelled.
    #[serde(default)]
    pub never_queued: u64,
    /// Number of combinations that made no valid job, found when they were to be queued.
    pub refused: u64,
    /// Jobs in order, or a part of them, without those that were deleted; `links.next` has the next part.
    pub jobs: Vec<SweepJob>,
    /// The first 100 combinations that made no valid job.
    pub refused_changes: Vec<RefusedChanges>,
    /// Related resources: relation to path.
    pub links: BTreeMap<String, String>,
}

/// A page of sweeps, newest first.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct SweepList {
    /// The sweeps.
    pub sweeps: Vec<BatchOverview>,
    /// Token of the next page, if there is one.
    pub next_page_token: Option<String>,
}
