//! Outcome and phases of a solve.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Outcome of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// All cycles were computed.
    Completed,
    /// A stop condition was met.
    StopCondition,
    /// A body was worn through almost completely.
    WornThrough,
    /// Stopped by a request.
    Stopped,
    /// The solver did not converge; `status_reason` contains its numbers.
    NotConverged,
    /// The workers of all attempts were lost.
    WorkerLost,
    /// The solve exceeded the memory limit of its process.
    OutOfMemory,
    /// The job had not ended by its deadline.
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

    /// Name of the outcome in JSON.
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

    /// Returns the outcome of that name.
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
    /// Condensation of the operators.
    Condense,
    /// Contact increments and wear.
    Cycles,
    /// Relocation of the mesh to the worn surface.
    Relocate,
}
