//! Comparison of the runs of a study with the converged solution: errors and Pareto front.

use api::results::Summary;
use api::spec::Spec;
use api::study::{Errors, Study, StudyRun};

use crate::batch::accuracy::error::StudyError;
use crate::batch::accuracy::grid::Grid;
use crate::batch::accuracy::reference::Converged;
use crate::batch::accuracy::run::Run;
use crate::batch::accuracy::settings::Settings;
use crate::spec;

/// Compares the runs of a study with the converged solution that the grid among them leads to.
///
/// # Errors
/// [`StudyError::NothingSolved`] if there is nothing to compare with.
pub(super) fn evaluate(
    spec: &Spec,
    grid: &Grid,
    runs: &[Run],
    left_out: Vec<String>,
) -> Result<Study, StudyError> {
    let converged = Converged::of(grid, runs)?;
    let cycles = spec::cycles(spec);
    let mut table: Vec<StudyRun> = runs
        .iter()
        .map(|run| row(run, cycles, grid, &converged))
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

fn row(run: &Run, cycles: u64, grid: &Grid, converged: &Converged) -> StudyRun {
    let found = run.found.as_ref().ok();
    let summary = found.map(|found| &found.summary);
    let errors = found.map(|found| converged.errors(&found.solution));
    let uncertainty = &converged.reference.uncertainty;
    let reached = summary.map(|summary| summary.accuracy).unwrap_or_default();
    let (tolerance, settings) = run.accuracy.parts();
    // Node planes of bodies of a width are no setting of the grid.
    let stations = || grid.finest().stations.and_then(|_| sections(summary?));
    let settings = settings.unwrap_or_else(|| Settings::used(cycles, &reached, stations()));
    StudyRun {
        tolerance,
        contact_element_mm: settings.contact_element_mm,
        contact_elements: reached.contact_elements,
        increments_per_cycle: settings.increments_per_cycle,
        cycle_jump: settings.cycle_jump,
        stations: settings.stations,
        outcome: summary.map(|summary| summary.outcome),
        failure: run.found.as_ref().err().cloned(),
        errors,
        below_uncertainty: errors.map_or_else(Vec::new, |errors| errors.below(uncertainty)),
        cpu_s: run.cpu_s,
        peak_memory_mb: summary.map_or(0.0, |summary| summary.cost.peak_memory_mb),
        on_front: false,
    }
}

/// Number of sections of a run.
fn sections(summary: &Summary) -> Option<u32> {
    u32::try_from(summary.stations.len()).ok()
}

/// Marks the Pareto front of runs that are sorted by cost: those with a smaller error than every cheaper run. Errors
/// below the uncertainty of the reference cannot be distinguished and count as equal.
fn mark_front(runs: &mut [StudyRun], uncertainty: &Errors) {
    let mut best = f64::INFINITY;
    for run in runs {
        let error = run.errors.map_or(f64::INFINITY, |errors| {
            errors.at_least(uncertainty).tolerance_error()
        });
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
            stations: None,
            outcome: None,
            failure: None,
            errors: depth.map(|depth| Errors {
                depth,
                ..Errors::default()
            }),
            below_uncertainty: Vec::new(),
            cpu_s,
            peak_memory_mb: 1.0,
            on_front: false,
        }
    }

    #[test]
    fn the_front_holds_runs_with_a_smaller_error_than_every_cheaper_one() {
        let runs = [
            run(0.1, None),
            run(0.2, Some(0.1)),
            run(0.3, Some(0.2)),
            run(0.4, Some(0.05)),
            run(0.5, Some(0.05)),
            run(0.6, Some(0.01)),
            run(0.7, Some(0.001)),
        ];
        let front = |uncertainty: f64| {
            let mut runs = runs.clone();
            let uncertainty = Errors {
                depth: uncertainty,
                ..Errors::default()
            };
            mark_front(&mut runs, &uncertainty);
            runs.map(|run| run.on_front)
        };
        assert_eq!(front(0.0), [false, true, false, true, false, true, true]);
        // Errors below the uncertainty are equal.
        assert_eq!(front(0.02), [false, true, false, true, false, true, false]);
    }
}
