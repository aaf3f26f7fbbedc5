//! The job document.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

use crate::plan::Plan;
use crate::results::Summary;
use crate::spec::Spec;

/// Where a job stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Waiting for a worker.
    Queued,
    /// A worker solves it.
    Running,
    /// Solved; the summary is there.
    Succeeded,
    /// Ended without the asked-for result; `outcome` and `status_reason` say why.
    Failed,
    /// Ended on request; what was computed so far stays readable.
    Cancelled,
}

impl Status {
    /// Every status.
    pub const ALL: [Self; 5] = [
        Self::Queued,
        Self::Running,
        Self::Succeeded,
        Self::Failed,
        Self::Cancelled,
    ];

    /// The status as it is written.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Cancelled => "cancelled",
        }
    }

    /// The status of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.as_str() == name)
    }

    /// Whether nothing follows.
    pub fn is_terminal(self) -> bool {
        matches!(self, Self::Succeeded | Self::Failed | Self::Cancelled)
    }
}

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// All cycles were done.
    Completed,
    /// A stop condition was met.
    StopCondition,
    /// A body was nearly consumed.
    WornThrough,
    /// Stopped from outside.
    Stopped,
    /// The solver gave up; `status_reason` carries its numbers.
    NotConverged,
    /// The workers that tried it were lost.
    WorkerLost,
    /// It needed more memory than a solving process may take.
    OutOfMemory,
    /// It had not ended by its deadline.
    DeadlineExceeded,
}

impl Outcome {
    /// Every outcome.
    pub const ALL: [Self; 8] = [
        Self::Completed,
        Self::StopCondition,
        Self::WornThrough,
        Self::Stopped,
        Self::NotConverged,
        Self::WorkerLost,
        Self::OutOfMemory,
        Self::DeadlineExceeded,
    ];

    /// The outcome as it is written.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::StopCondition => "stop_condition",
            Self::WornThrough => "worn_through",
            Self::Stopped => "stopped",
            Self::NotConverged => "not_converged",
            Self::WorkerLost => "worker_lost",
            Self::OutOfMemory => "out_of_memory",
            Self::DeadlineExceeded => "deadline_exceeded",
        }
    }

    /// The outcome of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|outcome| outcome.as_str() == name)
    }
}

/// Phases of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// Geometry and meshes.
    Mesh,
    /// Condensed operators.
    Condense,
    /// Contact increments and wear.
    Cycles,
    /// Moving the mesh after the worn surface.
    Relocate,
}

/// How far a job is.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Progress {
    /// What is being done; absent before the start.
    pub phase: Option<Phase>,
    /// Physical cycles done.
    pub cycle: u64,
    /// Physical cycles asked for.
    pub cycles: u64,
    /// `cycle / cycles`, 0 to 1.
    pub fraction: f64,
    /// Estimated seconds left, from the pace so far.
    pub eta_s: Option<f64>,
    /// When the solve last told of something (RFC 3339); a job that hangs stays behind here.
    pub updated_at: Option<String>,
}

/// A job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Job {
    /// Its name in the service; ordered by creation.
    pub id: Uuid,
    /// Where it stands.
    pub status: Status,
    /// Why it stands there, in words.
    pub status_reason: Option<String>,
    /// How the solve ended.
    pub outcome: Option<Outcome>,
    /// How many minutes older it counts in the queue than it is; -100 to 100.
    #[serde(default)]
    pub priority: i32,
    /// When it fails unless it has ended (RFC 3339).
    pub deadline_at: Option<String>,
    /// When it was accepted (RFC 3339).
    pub created_at: String,
    /// When a worker first took it (RFC 3339).
    pub started_at: Option<String>,
    /// When it ended (RFC 3339).
    pub finished_at: Option<String>,
    /// How far it is.
    pub progress: Progress,
    /// How often a worker took it; a graceful shutdown does not count.
    pub attempts: u32,
    /// The resolved specification.
    pub spec: Spec,
    /// What is simulated and why.
    pub plan: Option<Plan>,
    /// The result in short, once there is one.
    pub summary: Option<Summary>,
    /// Where to go from here: relation to path.
    pub links: BTreeMap<String, String>,
}

/// Jobs, newest first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobList {
    /// The jobs of this page.
    pub jobs: Vec<Job>,
    /// Where the next page starts; absent on the last one.
    pub next_page_token: Option<String>,
}
