//! The job document.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

use crate::enum_value::string_enum;
pub use crate::outcome::{Outcome, Phase, Stage};
use crate::plan::Plan;
use crate::results::Summary;
use crate::spec::Spec;

string_enum! {
    /// Status of a job.
    Status {
        /// Waiting for a worker.
        Queued = "queued",
        /// Being solved by a worker.
        Running = "running",
        /// Solved; the summary is available.
        Succeeded = "succeeded",
        /// Ended without the requested result; `outcome` and `status_reason` give the reason.
        Failed = "failed",
        /// Cancelled on request; results computed so far remain available.
        Cancelled = "cancelled",
    }
}

impl Status {
    /// Returns `true` if the status is final.
    pub fn is_terminal(self) -> bool {
        matches!(self, Self::Succeeded | Self::Failed | Self::Cancelled)
    }
}

/// Effect of a request that queues jobs again.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct RetriedJobs {
    /// Jobs that are queued again.
    pub retried: u64,
}

/// Progress of a job.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Progress {
    /// Current phase; absent before the start.
    pub phase: Option<Phase>,
    /// Current stage; absent before the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stage: Option<Stage>,
    /// Why the run has begun again at cycle 0: of the stage `refined` the errors of the first run. Absent of a run that has not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Physical cycles completed, since the run began again if it did.
    pub cycle: u64,
    /// Physical cycles requested.
    pub cycles: u64,
    /// `cycle / cycles`, 0 to 1.
    pub fraction: f64,
    /// Likely remaining time, s, from the speed so far.
    pub eta_s: Option<f64>,
    /// Remaining time, s, that is enough in nine of ten cases: also if the run restarts on finer settings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub eta_most_s: Option<f64>,
    /// Time of the last report of the solve (RFC 3339); an old one indicates a job that hangs.
    #[schema(format = DateTime)]
    pub updated_at: Option<String>,
}

/// A job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Job {
    /// Identifier; ordered by creation.
    pub id: Uuid,
    /// Status.
    pub status: Status,
    /// Reason for the status, in words.
    pub status_reason: Option<String>,
    /// Outcome of the solve.
    pub outcome: Option<Outcome>,
    /// Minutes added to its age in the order of the queue; -100 to 100.
    #[serde(default)]
    pub priority: i32,
    /// Time at which it fails unless it has ended (RFC 3339).
    #[schema(format = DateTime)]
    pub deadline_at: Option<String>,
    /// Time of acceptance (RFC 3339).
    #[schema(format = DateTime)]
    pub created_at: String,
    /// Time of the first claim by a worker (RFC 3339).
    #[schema(format = DateTime)]
    pub started_at: Option<String>,
    /// Time at which it ended (RFC 3339).
    #[schema(format = DateTime)]
    pub finished_at: Option<String>,
    /// Progress of the solve.
    pub progress: Progress,
    /// Number of claims by a worker; those ended by a graceful shutdown do not count.
    pub attempts: u32,
    /// The resolved specification.
    pub spec: Spec,
    /// The plan: simulated effects with reasons, and estimates.
    pub plan: Option<Plan>,
    /// Summary of the results, once available.
    pub summary: Option<Summary>,
    /// Links: relation to path.
    pub links: BTreeMap<String, String>,
}

/// A job in short: without specification, plan and summary.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobOverview {
    /// Identifier; ordered by creation.
    pub id: Uuid,
    /// Display name of the specification.
    pub name: Option<String>,
    /// Kind of system.
    pub system: String,
    /// Labels of the specification.
    pub labels: BTreeMap<String, String>,
    /// Status.
    pub status: Status,
    /// Reason for the status, in words.
    pub status_reason: Option<String>,
    /// Outcome of the solve.
    pub outcome: Option<Outcome>,
    /// Minutes added to its age in the order of the queue; -100 to 100.
    pub priority: i32,
    /// Time at which it fails unless it has ended (RFC 3339).
    #[schema(format = DateTime)]
    pub deadline_at: Option<String>,
    /// Time of acceptance (RFC 3339).
    #[schema(format = DateTime)]
    pub created_at: String,
    /// Time of the first claim by a worker (RFC 3339).
    #[schema(format = DateTime)]
    pub started_at: Option<String>,
    /// Time at which it ended (RFC 3339).
    #[schema(format = DateTime)]
    pub finished_at: Option<String>,
    /// Progress of the solve.
    pub progress: Progress,
    /// Number of claims by a worker; those ended by a graceful shutdown do not count.
    pub attempts: u32,
    /// The most important figures of the summary, once available.
    pub key_figures: Option<KeyFigures>,
    /// Paths of the job, its events, actions and results, by relation.
    pub links: BTreeMap<String, String>,
}

/// The most important figures of a summary.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct KeyFigures {
    /// Maximum worn depth of the receptacle, mm.
    pub receptacle_max_depth_mm: f64,
    /// Maximum worn depth of the slider, mm.
    pub slider_max_depth_mm: f64,
    /// Peak pressure at the end, MPa.
    pub peak_pressure_mpa: f64,
    /// Estimated relative error of worn depth and scar width.
    pub estimated_relative_error: f64,
    /// Cycles after which the first criterion of life was reached; null if none was.
    #[serde(default)]
    pub life_cycles: Option<f64>,
}

/// A job in a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(untagged)]
pub enum ListedJob {
    /// In full, with `?view=full`.
    Full(Box<Job>),
    /// In short.
    Short(Box<JobOverview>),
}

/// Jobs in the order that was asked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobList {
    /// The jobs of this page, in short, or in full with `?view=full`.
    pub jobs: Vec<ListedJob>,
    /// Token of the next page; absent on the last one.
    pub next_page_token: Option<String>,
    /// Jobs on all pages, with `?total=true`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub total: Option<u64>,
}
