//! Accuracy studies: the same scene over tolerances and over a grid of contact element, increments per cycle and cycle
//! jump, compared with the Richardson extrapolation of the finest runs.
//!
//! `RunPlan` chooses the runs, `evaluate` compares their results; both are pure. Between them the runs are solved
//! either by processes, one after the other (`make`), or as jobs of the service.

mod budget;
mod error;
mod errors;
mod evaluation;
mod evaluation_plan;
mod grid;
pub(in crate::batch) mod outcomes;
pub mod process;
mod reference;
pub mod report;
pub(in crate::batch) mod request;
mod run;
mod run_accuracy;
mod run_plan;
mod settings;

use std::path::PathBuf;

use api::plan::MachineFigures;
use api::study::Study;

use crate::spec::Resolved;
use budget::Budget;
use evaluation::evaluate;

pub use error::StudyError;
pub use outcomes::study;
pub use run::{Run, RunResult};
pub use run_plan::{BUDGET_S, Base, RunPlan, RunPlanError};

/// A study on this machine.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// The scene.
    pub resolved: &'a Resolved,
    /// Calibration of this machine.
    pub machine: &'a MachineFigures,
    /// The program whose `solve-child` solves.
    pub program: PathBuf,
    /// Budget of all runs together, processor seconds.
    pub budget_s: f64,
}

/// Makes a study with one process per run, so that processor time and memory are measured per run. Calls `on_run` at
/// the beginning of each run.
///
/// # Errors
/// [`StudyError`] if processes cannot be run or no run succeeds.
pub fn make(request: &Request<'_>, on_run: &mut dyn FnMut(&str)) -> Result<Study, StudyError> {
    let (resolved, budget_s) = (request.resolved, request.budget_s);
    // A specification can be serialized.
    let sent = serde_json::to_value(&resolved.spec).unwrap_or_default();
    let base = Base {
        sent: &sent,
        resolved,
    };
    let run_plan = RunPlan::within(base, request.machine, budget_s, &|_| Ok(()))?;
    let mut left_out = run_plan.left_out;
    let mut runs = Vec::new();
    let mut budget = Budget::new(budget_s);
    for planned in &run_plan.runs {
        let likely_s = budget.likely_s(planned.expected_s);
        if !budget.allows(likely_s) {
            left_out.push(format!("{}: about {likely_s:.0} s", planned.accuracy));
            continue;
        }
        on_run(&planned.accuracy.to_string());
        let (found, cpu_s) = process::solve(&request.program, &planned.resolved.spec)?;
        budget.spend(planned.expected_s, cpu_s);
        runs.push(Run {
            accuracy: planned.accuracy,
            cpu_s,
            found,
        });
    }
    evaluate(&resolved.spec, &run_plan.grid, &runs, left_out)
}
