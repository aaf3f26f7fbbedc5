//! Evaluation of a stored study: its jobs as runs, compared as far as they have ended.

use api::study::{Study, StudyDocument, StudyJob};

use crate::batch::accuracy::evaluation::evaluate;
use crate::batch::accuracy::evaluation_plan::EvaluationPlan;
use crate::batch::accuracy::run::{Run, RunResult};
use crate::batch::accuracy::run_accuracy::RunAccuracy;
use crate::batch::error::EvaluateError;
use crate::batch::kind::Kind;
use crate::export::csv;
use crate::export::documents::DocumentError;
use crate::store::{BatchJob, StoredBatch};

/// Returns a study with its jobs and, once there is something to compare, the comparison.
///
/// # Errors
/// [`EvaluateError`] if something stored cannot be read.
pub(in crate::batch) fn document(batch: StoredBatch) -> Result<StudyDocument, EvaluateError> {
    let study = match study(&batch) {
        Err(EvaluateError::Empty(_)) => None,
        study => Some(study?),
    };
    let overview = batch.overview;
    Ok(StudyDocument {
        id: overview.id,
        name: overview.name,
        created_at: overview.created_at,
        counts: overview.counts,
        jobs: batch.jobs.iter().map(shown).collect(),
        study,
        links: Kind::AccuracyStudy.links(overview.id),
    })
}

/// Returns the runs of a study as CSV.
///
/// # Errors
/// [`EvaluateError`] if something stored cannot be read, or there is nothing to compare yet.
pub(in crate::batch) fn table(batch: &StoredBatch) -> Result<Vec<u8>, EvaluateError> {
    Ok(csv::study(&study(batch)?).map_err(DocumentError::from)?)
}

/// Compares the results of a stored study.
///
/// # Errors
/// [`EvaluateError`] if something stored cannot be read, or there is nothing to compare yet.
pub fn study(batch: &StoredBatch) -> Result<Study, EvaluateError> {
    let id = batch.overview.id;
    let plan = plan(batch)?;
    let runs = batch.jobs.iter().filter_map(|job| run(job).transpose());
    let runs = runs.collect::<Result<Vec<Run>, _>>()?;
    evaluate(&plan.spec, &plan.grid, &runs, plan.left_out).map_err(|_| EvaluateError::Empty(id))
}

/// Checks that the evaluation plan can be read.
///
/// # Errors
/// [`EvaluateError::Format`] for the plan of another version.
pub(in crate::batch) fn check_plan(batch: &StoredBatch) -> Result<(), EvaluateError> {
    plan(batch).map(drop)
}

fn plan(batch: &StoredBatch) -> Result<EvaluationPlan, EvaluateError> {
    EvaluationPlan::decode(batch.overview.id, batch.plan.as_deref().unwrap_or_default())
}

fn accuracy(job: &BatchJob) -> Option<RunAccuracy> {
    let accuracy = job.overrides.get("/accuracy")?;
    RunAccuracy::of(&serde_json::from_value(accuracy.clone()).ok()?)
}

fn shown(job: &BatchJob) -> StudyJob {
    let (tolerance, settings) = accuracy(job).map_or((None, None), RunAccuracy::parts);
    StudyJob {
        id: job.id,
        tolerance,
        contact_element_mm: settings.map(|settings| settings.contact_element_mm),
        increments_per_cycle: settings.map(|settings| settings.increments_per_cycle),
        cycle_jump: settings.map(|settings| settings.cycle_jump),
        stations: settings.and_then(|settings| settings.stations),
        status: job.status,
        outcome: job.outcome,
    }
}

/// Returns a job that has ended as a run of the study.
fn run(job: &BatchJob) -> Result<Option<Run>, EvaluateError> {
    let Some(accuracy) = accuracy(job).filter(|_| job.status.is_terminal()) else {
        return Ok(None);
    };
    let profile = job.profile.as_deref().map(serde_json::from_str).transpose();
    let profile = profile.map_err(|cause| EvaluateError::Corrupt {
        id: job.id,
        what: "profile",
        cause,
    })?;
    let summary = job.summary.as_ref();
    let found = if let (Some(summary), Some(profile)) = (summary, profile) {
        Ok(RunResult::new(summary.clone(), &profile))
    } else {
        let reason = job.status_reason.as_deref();
        Err(reason.unwrap_or(job.status.as_str()).to_owned())
    };
    Ok(Some(Run {
        accuracy,
        cpu_s: summary.map_or(0.0, |summary| summary.cost.cpu_s),
        found,
    }))
}
