//! What accuracy costs: the same scene over tolerances and over a grid of contact element, increments a cycle and cycle
//! jump, compared with the Richardson extrapolation of the finest runs.
//!
//! Each run has a process of its own, one after the other, so that processor time and memory are its own. Knows the
//! wire contract and how to solve; does not know HTTP, SQL or the terminal.

mod budget;
mod errors;
mod grid;
pub(crate) mod process;
mod reference;
pub mod report;

use std::path::PathBuf;

use api::results::Summary;
use api::spec::{Accuracy, Spec};
use api::study::{Errors, Study, StudyRun};

use crate::translate::Resolved;
use budget::Budget;
use errors::Solution;
use grid::{Base, Grid, Settings};
use reference::Converged;

/// Tolerances of the study, loose to tight.
const TOLERANCES: [f64; 6] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.003];
/// The next tolerance costs about so many times as much as the one before.
const NEXT_TOLERANCE: f64 = 4.0;
/// Part of the budget that the tolerances may take.
const TOLERANCE_SHARE: f64 = 0.4;

/// Why there is no study.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A solving process could not be run.
    #[error("a solving process: {0}")]
    Process(#[from] std::io::Error),
    /// What a solving process wrote cannot be read.
    #[error("a line of a solving process: {0}")]
    Line(#[from] serde_json::Error),
    /// Nothing can be compared.
    #[error("no run succeeded: {0}")]
    NothingSolved(String),
}

/// What a study is made of.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// The scene.
    pub resolved: &'a Resolved,
    /// The program whose `solve-child` solves.
    pub program: PathBuf,
    /// Processor seconds that all runs together should take.
    pub budget_s: f64,
}

/// A run that ended.
#[derive(Debug, Clone, PartialEq)]
struct Run {
    tolerance: Option<f64>,
    settings: Settings,
    cost: Spent,
    /// What it found, or why it failed.
    found: Result<Found, String>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Spent {
    pub(crate) cpu_s: f64,
    pub(crate) peak_memory_mb: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Found {
    pub(crate) summary: Summary,
    solution: Solution,
}

/// Makes a study. `tell` hears of each run when it begins.
///
/// # Errors
/// [`StudyError`] if processes cannot be run or no run succeeds.
pub fn make(request: &Request<'_>, tell: &mut dyn FnMut(&str)) -> Result<Study, StudyError> {
    let mut runs = Vec::new();
    let mut budget = Budget::new(request.budget_s);
    tolerances(request, &mut budget, &mut runs, tell)?;
    let base = Base::of(request.resolved, &runs)?;
    let grid = settings_grid(request, &base, &mut budget, &mut runs, tell)?;
    let converged = Converged::of(&grid, &runs)?;
    let mut table: Vec<StudyRun> = runs.iter().map(|run| row(run, &converged)).collect();
    table.sort_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s));
    mark_front(&mut table);
    Ok(Study {
        spec: request.resolved.spec.clone(),
        reference: converged.reference,
        runs: table,
        left_out: budget.left_out,
    })
}

fn tolerances(
    request: &Request<'_>,
    budget: &mut Budget,
    runs: &mut Vec<Run>,
    tell: &mut dyn FnMut(&str),
) -> Result<(), StudyError> {
    let mut next_s = 0.0;
    for tolerance in TOLERANCES {
        if !budget.allows(next_s, TOLERANCE_SHARE) {
            budget.leave_out(format!("tolerance {tolerance}"), next_s);
            continue;
        }
        tell(&format!("tolerance {tolerance}"));
        let accuracy = Accuracy {
            tolerance: Some(tolerance),
            ..Accuracy::default()
        };
        let run = solve(request, accuracy, Some(tolerance), None)?;
        budget.spend(run.cost.cpu_s);
        next_s = NEXT_TOLERANCE * run.cost.cpu_s;
        runs.push(run);
    }
    Ok(())
}

/// Solves the grid, coarsest first, as far as the budget goes.
fn settings_grid(
    request: &Request<'_>,
    base: &Base,
    budget: &mut Budget,
    runs: &mut Vec<Run>,
    tell: &mut dyn FnMut(&str),
) -> Result<Grid, StudyError> {
    let mut on = |settings: Settings, budget: &mut Budget| -> Result<f64, StudyError> {
        tell(&settings.to_string());
        let run = solve(request, settings.accuracy(), None, Some(settings))?;
        let cpu_s = run.cost.cpu_s;
        budget.spend(cpu_s);
        runs.push(run);
        Ok(cpu_s)
    };
    // Fixed settings cost more than chosen ones; by how much, one coarse run tells.
    let pilot = base.pilot();
    let factor = on(pilot, budget)? / base.cost_s(pilot);
    let grid = Grid::within(base, factor, budget.left());
    for settings in grid.coarsest_first() {
        if settings == pilot {
            continue;
        }
        let expected = factor * base.cost_s(settings);
        if budget.allows(expected, 1.5) {
            on(settings, budget)?;
        } else {
            budget.leave_out(settings.to_string(), expected);
        }
    }
    Ok(grid)
}

/// Solves the scene at an accuracy, in a process of its own.
fn solve(
    request: &Request<'_>,
    accuracy: Accuracy,
    tolerance: Option<f64>,
    settings: Option<Settings>,
) -> Result<Run, StudyError> {
    let resolved = request.resolved;
    let mut spec = Spec {
        accuracy,
        ..resolved.spec.clone()
    };
    // The end is a snapshot of its own accord; any other would cut jumps short.
    spec.output.fields = Some(false);
    spec.output.snapshots_at_distance_mm = None;
    spec.output.snapshots_at_cycles = spec.cycles.map(|cycles| vec![cycles]);
    let (found, cost) = process::solve(&request.program, &spec)?;
    let settings = settings.unwrap_or_else(|| Settings::used(&spec, found.as_ref().ok()));
    Ok(Run {
        tolerance,
        settings,
        cost,
        found,
    })
}

fn row(run: &Run, converged: &Converged) -> StudyRun {
    let summary = run.found.as_ref().ok().map(|found| &found.summary);
    let errors = run.found.as_ref().ok();
    StudyRun {
        tolerance: run.tolerance,
        contact_element_mm: run.settings.contact_element_mm,
        contact_elements: summary.map_or(0, |summary| summary.accuracy.contact_elements),
        increments_per_cycle: run.settings.increments_per_cycle,
        cycle_jump: run.settings.cycle_jump,
        outcome: summary.map(|summary| summary.outcome),
        failure: run.found.as_ref().err().cloned(),
        errors: errors.map(|found| converged.errors(&found.solution)),
        cpu_s: run.cost.cpu_s,
        peak_memory_mb: run.cost.peak_memory_mb,
        on_front: false,
    }
}

/// Marks the runs, sorted by cost, that no cheaper one betters.
fn mark_front(runs: &mut [StudyRun]) {
    let mut best = f64::INFINITY;
    for run in runs {
        let error = run.errors.as_ref().map_or(f64::INFINITY, Errors::promised);
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
            cpu_s,
            peak_memory_mb: 1.0,
            on_front: false,
        }
    }

    #[test]
    fn the_front_holds_what_no_cheaper_run_betters() {
        let mut runs = [
            run(0.1, None),
            run(0.2, Some(0.1)),
            run(0.3, Some(0.2)),
            run(0.4, Some(0.05)),
            run(0.5, Some(0.05)),
        ];
        mark_front(&mut runs);
        let front = runs.map(|run| run.on_front);
        assert_eq!(front, [false, true, false, true, false]);
    }
}
