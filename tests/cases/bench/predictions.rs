//! Estimates of the plan compared with measurements: every system and both published scenes at several tolerances, each
//! in a process of its own.

use std::path::Path;

use api::plan::MachineFigures;
use api::results::Summary;
use api::spec::{Accuracy, Spec, System, SystemKind};

use server::batch::accuracy::process;
use server::estimate::Estimate;
use server::spec;
use server::spec::{Refused, Resolved};

use crate::bench::cases::{FUZZ_BUTTON, MCCOLL};
use crate::bench::{BenchError, real};

/// Default tolerances: the presets and two between.
pub(crate) const TOLERANCES: [f64; 5] = [0.1, 0.05, 0.02, 0.01, 0.003];

/// An estimate and the measured value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pair {
    /// Name.
    pub(crate) what: &'static str,
    /// Estimate of the plan.
    pub(crate) expected: f64,
    /// Measured value of the run.
    pub(crate) measured: f64,
}

impl Pair {
    /// Expected over measured.
    pub(crate) fn ratio(&self) -> f64 {
        self.expected / self.measured.max(f64::MIN_POSITIVE)
    }
}

/// The comparison for a scene at a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Prediction {
    /// The scene's name.
    pub(crate) scene: String,
    /// The tolerance.
    pub(crate) tolerance: f64,
    /// Estimates and measured values.
    pub(crate) pairs: Vec<Pair>,
}

/// Returns every system and both published scenes by name.
///
/// # Errors
/// [`BenchError`] if a committed specification cannot be read.
pub(crate) fn scenes() -> Result<Vec<(String, Spec)>, BenchError> {
    let mut scenes: Vec<(String, Spec)> = SystemKind::ALL
        .iter()
        .map(|kind| {
            let spec = Spec {
                system: System::of_kind(*kind),
                ..Spec::default()
            };
            (kind.as_str().to_owned(), spec)
        })
        .collect();
    for (name, text) in [("mccoll.json", MCCOLL), ("fuzz_button.json", FUZZ_BUTTON)] {
        let resolved = spec::read(text.as_bytes())?;
        scenes.push((name.to_owned(), resolved.spec));
    }
    Ok(scenes)
}

/// Compares one scene at one tolerance; `program` is the one whose `solve-child` solves.
///
/// # Errors
/// [`BenchError`] if the solve fails.
pub(crate) fn compare(
    program: &Path,
    machine: &MachineFigures,
    (name, spec): &(String, Spec),
    tolerance: f64,
) -> Result<Prediction, BenchError> {
    let mut spec = spec.clone();
    spec.accuracy = Accuracy {
        tolerance: Some(tolerance),
        ..Accuracy::default()
    };
    Ok(Prediction {
        scene: name.clone(),
        tolerance,
        pairs: pairs(
            program,
            machine,
            &spec::resolve(&spec).map_err(Refused::Faults)?,
        )?,
    })
}

/// Compares a specification; `program` is the one whose `solve-child` solves.
///
/// # Errors
/// [`BenchError`] if it is refused, or the solve fails.
pub(crate) fn compare_specification(
    program: &Path,
    machine: &MachineFigures,
    specification: &str,
) -> Result<Vec<Pair>, BenchError> {
    pairs(program, machine, &spec::read(specification.as_bytes())?)
}

fn pairs(
    program: &Path,
    machine: &MachineFigures,
    resolved: &Resolved,
) -> Result<Vec<Pair>, BenchError> {
    let plan = Estimate::of(resolved)
        .plan(resolved, Some(machine))
        .estimates;
    let (found, cpu_s) = process::solve(program, &resolved.spec)?;
    let summary = found.map_err(BenchError::RunFailed)?.summary;
    let pair = |(what, measured): (&'static str, f64)| Pair {
        what,
        expected: plan.get(what).copied().unwrap_or_default(),
        measured,
    };
    Ok(measured(&summary, cpu_s).map(pair).to_vec())
}

/// Returns the measured values of a run by the names of the plan's estimates.
fn measured(summary: &Summary, cpu_s: f64) -> [(&'static str, f64); 6] {
    [
        ("dofs", real(summary.cost.dofs)),
        ("memory_mb", summary.cost.peak_memory_mb),
        ("computed_cycles", real(summary.accuracy.computed_cycles)),
        ("increments", real(summary.accuracy.increments)),
        ("cpu_s", cpu_s),
        ("cpu_s_most", cpu_s),
    ]
}
