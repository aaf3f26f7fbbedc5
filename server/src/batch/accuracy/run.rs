//! A run of an accuracy study: its setting, cost and result.

use api::results::{Profile, Summary};

use crate::batch::accuracy::errors::Solution;
use crate::batch::accuracy::run_accuracy::RunAccuracy;

/// A run of a study that has ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Accuracy setting.
    pub accuracy: RunAccuracy,
    /// Processor seconds.
    pub cpu_s: f64,
    /// Result, or why it failed.
    pub found: Result<RunResult, String>,
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunResult {
    /// Summary of the run.
    pub summary: Summary,
    pub(super) solution: Solution,
}

impl RunResult {
    /// From the summary and the last profile of a run.
    pub fn new(summary: Summary, last: &Profile) -> Self {
        let solution = Solution::of(&summary, last);
        Self { summary, solution }
    }
}
