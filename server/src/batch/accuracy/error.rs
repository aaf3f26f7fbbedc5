//! Errors of making an accuracy study.

use crate::batch::accuracy::run_plan::RunPlanError;

/// Why a study cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A solving process could not be run.
    #[error("a solving process: {0}")]
    Process(#[from] std::io::Error),
    /// A line of a solving process cannot be read.
    #[error("a line of a solving process: {0}")]
    Line(#[from] serde_json::Error),
    /// No run can be made.
    #[error(transparent)]
    RunPlan(#[from] RunPlanError),
    /// Nothing can be compared.
    #[error("no run succeeded: {0}")]
    NothingSolved(String),
}
