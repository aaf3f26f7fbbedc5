//! Benchmarks of the engine on this machine: processor time of this process, one case after the other; the smallest of a few repetitions
//! where a case is short. `night` prints the tables of the documents.

mod against;
mod cases;
mod night;
pub(crate) mod predictions;

use solver::SolveError;

use server::batch::accuracy::StudyError;
use server::estimate::machine::MachineError;
use server::solve::{Failure, cpu_s};
use server::spec::Refused;

/// A measured case.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Row {
    /// Name of the task.
    pub(crate) what: String,
    /// Size of the task.
    pub(crate) size: String,
    /// Processor seconds.
    pub(crate) cpu_s: f64,
}

/// Why a case could not be measured.
#[derive(Debug, thiserror::Error)]
pub(crate) enum BenchError {
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

/// A count as a real number.
fn real(count: impl TryInto<u32>) -> f64 {
    f64::from(count.try_into().unwrap_or(u32::MAX))
}
