//! What accuracy costs: the same scene over tolerances and over a grid of contact element, increments a cycle and cycle
//! jump, compared with the Richardson extrapolation of the finest runs.
//!
//! `RunPlan` chooses the runs, `evaluate` compares what they found; both are pure. Between them runs are made either by
//! processes, one after the other (`make`), or as jobs of the service (`http::submit_study`). Knows the wire contract and
//! how to solve; does not know HTTP, SQL or the terminal.

mod budget;
mod errors;
mod grid;
pub(crate) mod process;
mod reference;
pub mod report;
pub mod request;
mod run_plan;

use std::path::PathBuf;

use api::plan::MachineFigures;
use api::results::{Profile, Summary};
use api::spec::Spec;
use api::study::{Errors, Study, StudyRun};

use crate::spec;
use crate::spec::Resolved;
use budget::Budget;
use errors::Solution;
use reference::Converged;

pub use grid::{Grid, Settings};
pub use run_plan::{Accept, Asked, RunPlan, RunPlanError, Wanted};

/// Processor seconds that all runs of a study together should take, unless told otherwise.
pub const BUDGET_S: f64 = 180.0;

/// Why there is no study.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A solving process could not be run.
    #[error("a solving process: {0}")]
    Process(#[from] std::io::Error),
    /// What a solving process wrote cannot be read.
    #[error("a line of a solving process: {0}")]
    Line(#[from] serde_json::Error),
    /// There are no runs to be made.
    #[error(transparent)]
    RunPlan(#[from] RunPlanError),
    /// Nothing can be compared.
    #[error("no run succeeded: {0}")]
    NothingSolved(String),
}

/// What a study is made of.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// The scene.
    pub resolved: &'a Resolved,
    /// What this machine takes for the engine's work.
    pub machine: &'a MachineFigures,
    /// The program whose `solve-child` solves.
    pub program: PathBuf,
    /// Processor seconds that all runs together should take.
    pub budget_s: f64,
}

/// A run that ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// What it asked for.
    pub asked: Asked,
    /// What it cost.
    pub spent: Spent,
    /// What it found, or why it failed.
    pub found: Result<Found, String>,
}

/// What a run cost.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Spent {
    /// Processor seconds.
    pub cpu_s: f64,
    /// Largest resident memory, MiB.
    pub peak_memory_mb: f64,
}

/// What a run found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    pub(crate) summary: Summary,
    solution: Solution,
}

impl Found {
    /// The end of a run.
    pub fn new(summary: Summary, last: &Profile) -> Self {
        let solution = Solution::of(&summary, last);
        Self { summary, solution }
    }
}

/// Makes a study by processes of its own, so that processor time and memory are each run's own. `tell` hears of each
/// run when it begins.
///
/// # Errors
/// [`StudyError`] if processes cannot be run or no run succeeds.
pub fn make(request: &Request<'_>, tell: &mut dyn FnMut(&str)) -> Result<Study, StudyError> {
    let Request {
        resolved,
        machine,
        program,
        budget_s,
    } = request;
    let programme = RunPlan::within(resolved, machine, *budget_s, &|_| Ok(()))?;
    let mut left_out = programme.left_out;
    let mut runs = Vec::new();
    let mut budget = Budget::new(*budget_s);
    for wanted in &programme.runs {
        let likely_s = budget.likely_s(wanted.expected_s);
        if !budget.allows(likely_s) {
            left_out.push(format!("{}: about {likely_s:.0} s", wanted.asked));
            continue;
        }
        tell(&wanted.asked.to_string());
        let (found, spent) = process::solve(program, &wanted.resolved.spec)?;
        budget.spend(wanted.expected_s, spent.cpu_s);
        runs.push(Run {
            asked: wanted.asked,
            spent,
            found,
        });
    }
    evaluate(&resolved.spec, &programme.grid, &runs, left_out)
}

/// Compares the runs of a study with the converged solution that the grid among them leads to.
///
/// # Errors
/// [`StudyError::NothingSolved`] if there is nothing to compare with.
pub fn evaluate(
    spec: &Spec,
    grid: &Grid,
    runs: &[Run],
    left_out: Vec<String>,
) -> Result<Study, StudyError> {
    let converged = Converged::of(grid, runs)?;
    let cycles = spec::cycles(spec);
    let mut table: Vec<StudyRun> = runs
        .iter()
        .map(|run| row(run, cycles, &converged))
        .collect();
    table.sort_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s));
    mark_front(&mut table, &converged.reference.uncertainty);
    Ok(Study {
        spec: spec.clone(),
        reference: converged.reference,
        runs: table,
        left_out,
    })
}

fn row(run: &Run, cycles: u64, converged: &Converged) -> StudyRun {
    let found = run.found.as_ref().ok();
    let summary = found.map(|found| &found.summary);
    let errors = found.map(|found| converged.errors(&found.solution));
    let doubt = &converged.reference.uncertainty;
    let used = || {
        let reached = summary.map(|summary| summary.accuracy);
        Settings::used(cycles, &reached.unwrap_or_default())
    };
    let (tolerance, settings) = match run.asked {
        Asked::Tolerance(tolerance) => (Some(tolerance), used()),
        Asked::Fixed(settings) => (None, settings),
    };
    StudyRun {
        tolerance,
        contact_element_mm: settings.contact_element_mm,
        contact_elements: summary.map_or(0, |summary| summary.accuracy.contact_elements),
        increments_per_cycle: settings.increments_per_cycle,
        cycle_jump: settings.cycle_jump,
        outcome: summary.map(|summary| summary.outcome),
        failure: run.found.as_ref().err().cloned(),
        errors,
        below_doubt: errors.map_or_else(Vec::new, |errors| errors.below(doubt)),
        cpu_s: run.spent.cpu_s,
        peak_memory_mb: run.spent.peak_memory_mb,
        on_front: false,
    }
}

/// Marks the runs, sorted by cost, that no cheaper one betters. Errors below the doubt about the reference cannot be told
/// apart: the cheapest of them is as good as any.
fn mark_front(runs: &mut [StudyRun], doubt: &Errors) {
    let mut best = f64::INFINITY;
    for run in runs {
        let error = run
            .errors
            .map_or(f64::INFINITY, |errors| errors.at_least(doubt).promised());
        run.on_front = error < best;
        best = best.min(error);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(cpu_s: f64, depth: Option<f64>) -> StudyRun {
        StudyRun {
            tolerance: None,
            contact_element_mm: 0.01,
            contact_elements: 10,
            increments_per_cycle: 40,
            cycle_jump: 1.0,
            outcome: None,
            failure: None,
            errors: depth.map(|depth| Errors {
                depth,
                ..Errors::default()
            }),
            below_doubt: Vec::new(),
            cpu_s,
            peak_memory_mb: 1.0,
            on_front: false,
        }
    }

    #[test]
    fn the_front_holds_what_no_cheaper_run_betters() {
        let runs = [
            run(0.1, None),
            run(0.2, Some(0.1)),
            run(0.3, Some(0.2)),
            run(0.4, Some(0.05)),
            run(0.5, Some(0.05)),
            run(0.6, Some(0.01)),
            run(0.7, Some(0.001)),
        ];
        let front = |doubt: f64| {
            let mut runs = runs.clone();
            let doubt = Errors {
                depth: doubt,
                ..Errors::default()
            };
            mark_front(&mut runs, &doubt);
            runs.map(|run| run.on_front)
        };
        assert_eq!(front(0.0), [false, true, false, true, false, true, true]);
        // What lies below the doubt is not better than what lies below it too.
        assert_eq!(front(0.02), [false, true, false, true, false, true, false]);
    }
}
