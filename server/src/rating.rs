//! Ratings: the wear coefficients that a rated number of cycles implies.
//!
//! A depth depends on a wear coefficient k and the number of cycles N by their product k N, as long as one cycle wears little.
//! All coefficients of a specification are therefore multiplied by one factor until the criterion of the rating is reached
//! after the rated cycles: the first factor is the one of a closed form, the next ones follow from runs of the engine, and the
//! last run has reached the criterion after the rated cycles within the tolerance. How the coefficients of layers and
//! bodies relate is not known from one rating: their ratios stay as given.

use std::ops::{ControlFlow, RangeInclusive};

use api::job::Outcome;
use api::problem::Fault;
use api::rating::{Rating, RatingRun};
use api::results::LifeStatus;
use api::spec::{Criterion, LifeSettings, Spec, Stop};
use solver::closed_form::expected_wear;
use solver::scene::Scene;

use crate::number::real;
use crate::solve;
use crate::solve::{ChildMessage, Failure};
use crate::spec::{self, Refused, Resolved, coefficients, scatter};

/// Cycles that a contact may be rated for.
pub const RATED_CYCLES: RangeInclusive<u64> = 1..=100_000_000;
/// Part of the contacts that may have failed by then.
pub const FAILING: RangeInclusive<f64> = 1e-6..=0.999_999;
/// Most runs: one corrects the closed form, the next ones what does not depend on k N alone.
const MOST_RUNS: usize = 6;
/// Cycles of a run over the life that is sought: by so much the closed form may be off.
const MARGIN: f64 = 10.0;

/// A rated life.
#[derive(Debug, Clone, PartialEq)]
pub struct Request<'a> {
    /// The contact; the ratios of its wear coefficients stay as given.
    pub resolved: &'a Resolved,
    /// Criterion that ends the life.
    pub criterion: Criterion,
    /// The rated cycles.
    pub cycles: u64,
    /// Part of the contacts that may have failed by then.
    pub failing: f64,
}

/// Reason for which no coefficients can be given.
#[derive(Debug, thiserror::Error)]
pub enum RatingError {
    /// The criterion does not fit the contact, or a coefficient would leave its range.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// A run failed.
    #[error("the run with {factor:.4e} times the coefficients failed: {failure}")]
    Failed {
        /// Factor on the given coefficients.
        factor: f64,
        /// The failure.
        failure: Failure,
    },
    /// A run ended before the criterion was reached.
    #[error(
        "with {factor:.4e} times the coefficients the criterion was not reached: {outcome} after {cycles} cycles"
    )]
    NotReached {
        /// Factor on the given coefficients.
        factor: f64,
        /// How the run ended.
        outcome: &'static str,
        /// Cycles.
        cycles: u64,
    },
    /// The runs do not approach the rated cycles.
    #[error("after {MOST_RUNS} runs the life is {cycles:.1} cycles instead of {median_cycles:.1}")]
    Diverged {
        /// Life of the last run.
        cycles: f64,
        /// Life that was sought.
        median_cycles: f64,
    },
}

/// Finds the coefficients. Calls `on_progress` after each computed cycle.
///
/// # Errors
/// [`RatingError`].
pub fn coefficients(
    request: &Request<'_>,
    on_progress: &mut dyn FnMut(&str),
) -> Result<Rating, RatingError> {
    let settings = &request.resolved.spec.life;
    let median_cycles = scatter::median(real(request.cycles), request.failing, settings);
    let given = until_criterion(request, median_cycles)?;
    let tolerance = given.scene.accuracy.tolerance;
    let endless = Scene {
        cycles: u64::MAX,
        ..given.scene
    };
    let mut factor = real(expected_wear::expected_end(&endless)) / median_cycles;
    let mut runs = Vec::new();
    while runs.len() < MOST_RUNS {
        let number = runs.len() + 1;
        let mut on_cycle = |cycle| {
            on_progress(&format!(
                "run {number}, {factor:.4e} times the coefficients: cycle {cycle}"
            ));
        };
        let run = solved(&given.spec, factor, &mut on_cycle)?;
        runs.push(run);
        let relative = run.cycles / median_cycles;
        if run.is_reached && (relative - 1.0).abs() <= tolerance {
            let mut spec = request.resolved.spec.clone();
            let coefficients = coefficients::scale(&mut spec, factor);
            return Ok(Rating {
                criterion: request.criterion.clone(),
                rated_cycles: request.cycles,
                failing: request.failing,
                median_cycles,
                factor,
                coefficients,
                runs,
                spec: resolve(&spec)?.spec,
            });
        }
        factor *= relative;
    }
    let cycles = runs.last().map_or(f64::NAN, |run| run.cycles);
    Err(RatingError::Diverged {
        cycles,
        median_cycles,
    })
}

/// The contact of a request, whose run ends at the criterion.
fn until_criterion(request: &Request<'_>, median_cycles: f64) -> Result<Resolved, RatingError> {
    if !request.resolved.spec.mission.is_empty() {
        let detail = "a rating counts cycles of one motion: give `motion` instead".to_owned();
        let pointer = "/mission".to_owned();
        return Err(Refused::Faults(vec![Fault { pointer, detail }]).into());
    }
    if request.resolved.spec.cycles.is_none() {
        let detail = "a continuous motion has no cycles".to_owned();
        let pointer = "/motion/kind".to_owned();
        return Err(Refused::Faults(vec![Fault { pointer, detail }]).into());
    }
    let mut spec = request.resolved.spec.clone();
    let mut cycles = request.cycles;
    while real(cycles) < MARGIN * median_cycles && cycles < *spec::CYCLES.end() {
        cycles = (2 * cycles).min(*spec::CYCLES.end());
    }
    spec.cycles = Some(cycles);
    spec.stop = vec![Stop::from(request.criterion.clone())];
    spec.life = LifeSettings {
        criteria: Some(vec![request.criterion.clone()]),
        ..spec.life
    };
    spec.output.snapshots_at_cycles = Some(Vec::new());
    spec.output.fields = None;
    let resolved = spec::resolve(&spec).map_err(|faults| {
        // The criterion stands at two places of the specification, and at none of the request.
        let faults = faults.into_iter();
        let faults = faults.filter(|fault| !fault.pointer.starts_with("/life/criteria"));
        let faults = faults.map(|fault| Fault {
            pointer: fault.pointer.replacen("/stop/0", "criterion", 1),
            ..fault
        });
        Refused::Faults(faults.collect())
    })?;
    Ok(resolved)
}

fn resolve(spec: &Spec) -> Result<Resolved, Refused> {
    spec::resolve(spec).map_err(Refused::Faults)
}

/// The run with coefficients multiplied by a factor.
fn solved(
    spec: &Spec,
    factor: f64,
    on_cycle: &mut dyn FnMut(u64),
) -> Result<RatingRun, RatingError> {
    let mut spec = spec.clone();
    coefficients::scale(&mut spec, factor);
    let resolved = resolve(&spec)?;
    let solved = solve::run((&resolved).into(), &mut |line| {
        if let ChildMessage::Cycle(report) = line {
            on_cycle(report.cycle);
        }
        ControlFlow::Continue(())
    });
    let summary = solved.map_err(|failure| RatingError::Failed { factor, failure })?;
    let reached = summary.life.iter();
    let reached = reached.filter(|entry| entry.status == LifeStatus::Reached);
    let first = reached.filter_map(|entry| entry.cycles).reduce(f64::min);
    let run = |cycles, is_reached| RatingRun {
        factor,
        cycles,
        is_reached,
    };
    if let Some(first) = first {
        return Ok(run(first, true));
    }
    let done = summary.life.iter();
    let done = done.filter_map(|entry| Some(entry.value? / entry.limit?));
    let furthest = done.fold(0.0, f64::max);
    if summary.outcome == Outcome::Completed && furthest > 0.0 {
        return Ok(run(real(summary.cycles_done) / furthest, false));
    }
    Err(RatingError::NotReached {
        factor,
        outcome: summary.outcome.as_str(),
        cycles: summary.cycles_done,
    })
}
