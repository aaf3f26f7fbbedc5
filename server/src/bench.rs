//! Benchmarks of the engine on this machine.
//!
//! Processor time of this process, one case after the other; the smallest of a few repetitions where a case is short.
//! Does not know the terminal.

pub mod against;
mod cases;
pub mod predictions;

use solver::SolveError;

use crate::batch::accuracy::StudyError;
use crate::estimate::machine::MachineError;
use crate::solve::{Failure, cpu_s};
use crate::spec::Refused;

pub use cases::{Case, all};

/// A measured case.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Name of the task.
    pub what: String,
    /// Size of the task.
    pub size: String,
    /// Processor seconds.
    pub cpu_s: f64,
}

/// Why a case could not be measured.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// The specification is refused.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// The engine failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A run failed.
    #[error(transparent)]
    Failed(#[from] Failure),
    /// A file or another program failed.
    #[error("{0}")]
    System(#[from] std::io::Error),
    /// The calibration failed.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// A process could not be run.
    #[error(transparent)]
    Process(#[from] StudyError),
    /// A run in a process of its own failed.
    #[error("{0}")]
    RunFailed(String),
}

/// Returns the processor seconds of a task, the smallest of `times` repetitions, and the value of the last one.
fn measured<T, E>(times: u32, mut task: impl FnMut() -> Result<T, E>) -> Result<(f64, T), E> {
    let mut once = || {
        let before = cpu_s();
        let done = task()?;
        Ok((cpu_s() - before, done))
    };
    let first = once()?;
    (1..times).try_fold(first, |(best_s, _), _| {
        let (again_s, done) = once()?;
        Ok((best_s.min(again_s), done))
    })
}
