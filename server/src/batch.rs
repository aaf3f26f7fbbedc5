//! Batches: many jobs of one question.
//!
//! A batch is expanded (a request into the specifications of its jobs; that of a large sweep portion by portion), run (as ordinary jobs of the queue) and
//! evaluated (the stored jobs into a document and a table). Parameter sweeps and accuracy studies are its two kinds.
//! Does not know HTTP, SQL or the terminal.

pub mod accuracy;
mod error;
mod kind;
mod sweep;
mod variation;

use std::collections::BTreeMap;
use std::ops::Range;

use api::plan::MachineFigures;
use api::study::{StudyDocument, StudyRequest};
use api::sweep::{Sweep, SweepPlan, SweepRequest};
use serde::Serialize;
use uuid::Uuid;

use crate::batch::sweep::Expanded;
use crate::estimate::expected_time::ExpectedTime;
use crate::queue;
use crate::spec::Refused;
use crate::store::{
    BatchDetail, BatchJob, BatchPart, NewBatch, NewBatchJob, NewExpansion, NewJob, Portion,
    StoredBatch, SubmitOptions,
};

pub use error::{EvaluateError, ExpandError};
pub use kind::Kind;
pub use variation::{Accept, Variation};

/// A submitted batch.
#[derive(Debug, Clone, PartialEq)]
pub enum Request {
    /// A parameter sweep.
    Sweep(SweepRequest),
    /// An accuracy study.
    AccuracyStudy(StudyRequest),
}

/// A batch with its jobs, as it is shown.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Document {
    /// A parameter sweep.
    Sweep(Box<Sweep>),
    /// An accuracy study with the comparison of its results.
    AccuracyStudy(Box<StudyDocument>),
}

impl Kind {
    /// Reads a request.
    ///
    /// # Errors
    /// [`Refused`] if it cannot be read.
    pub fn read(self, bytes: &[u8]) -> Result<Request, Refused> {
        match self {
            Self::Sweep => variation::read(bytes).map(Request::Sweep),
            Self::AccuracyStudy => variation::read(bytes).map(Request::AccuracyStudy),
        }
    }

    /// How much of the results [`Kind::document`] uses.
    pub fn document_detail(self) -> BatchDetail {
        match self {
            Self::Sweep => BatchDetail::Statuses,
            Self::AccuracyStudy => BatchDetail::Profiles,
        }
    }

    /// How much of the results [`Kind::table`] uses.
    pub fn table_detail(self) -> BatchDetail {
        match self {
            Self::Sweep => BatchDetail::Summaries,
            Self::AccuracyStudy => BatchDetail::Profiles,
        }
    }

    /// Checks that the evaluation plan of a batch can be read.
    ///
    /// # Errors
    /// [`EvaluateError::Format`] for the plan of another version.
    pub fn check_plan(self, batch: &StoredBatch) -> Result<(), EvaluateError> {
        match self {
            Self::Sweep => Ok(()),
            Self::AccuracyStudy => accuracy::outcomes::check_plan(batch),
        }
    }

    /// Returns a batch, with the part of its jobs that was read, as a document.
    ///
    /// # Errors
    /// [`EvaluateError`] if something stored cannot be read.
    pub fn document(self, batch: StoredBatch, part: BatchPart) -> Result<Document, EvaluateError> {
        match self {
            Self::Sweep => Ok(Document::Sweep(Box::new(sweep::document(batch, part)?))),
            Self::AccuracyStudy => {
                let study = accuracy::outcomes::document(batch)?;
                Ok(Document::AccuracyStudy(Box::new(study)))
            }
        }
    }

    /// Returns the results of a batch as CSV, one line per job after the header.
    ///
    /// # Errors
    /// [`EvaluateError`] if something stored cannot be read, or there is nothing to compare yet.
    pub fn table(self, batch: &StoredBatch) -> Result<Vec<u8>, EvaluateError> {
        match self {
            Self::Sweep => sweep::table::csv(batch),
            Self::AccuracyStudy => accuracy::outcomes::table(batch),
        }
    }
}

impl Request {
    /// Returns the jobs to be queued: all of them, accepted, or none; of a large sweep, the first of them and the request for the
    /// others.
    ///
    /// # Errors
    /// [`ExpandError`] with the faults of the request, or of the jobs it would make.
    pub fn expand(
        &self,
        machine: Option<&MachineFigures>,
        accept: &Accept<'_>,
    ) -> Result<NewBatch, ExpandError> {
        let (name, base, first, plan, expansion) = match self {
            Self::Sweep(request) => {
                let expanded = sweep::expand(request, accept)?;
                let expansion = expansion(request, &expanded, machine)?;
                (
                    &request.name,
                    &request.base,
                    expanded.first,
                    None,
                    expansion,
                )
            }
            Self::AccuracyStudy(request) => {
                let machine = machine.ok_or(ExpandError::Unmeasured)?;
                let (variations, plan) = accuracy::request::expand(request, machine, accept)?;
                (&request.name, &request.base, variations, Some(plan), None)
            }
        };
        Ok(NewBatch {
            name: name.clone(),
            base: base.to_string(),
            jobs: (0..)
                .zip(first)
                .map(|(position, variation)| job(position, variation, machine))
                .collect(),
            plan,
            expansion,
        })
    }
}

/// Returns the estimate of a sweep, by some of its jobs.
///
/// # Errors
/// [`Refused`] if it cannot be read, is too large, or has faults in these jobs.
pub fn plan_sweep(request: &[u8], machine: Option<&MachineFigures>) -> Result<SweepPlan, Refused> {
    let request = variation::read(request)?;
    let (jobs, sample) = sweep::sampled(&request)?;
    let mean = ExpectedTime::mean(&sample, machine);
    Ok(SweepPlan {
        jobs,
        estimates: mean.map_or_else(BTreeMap::new, |mean| mean.times(jobs).estimates()),
    })
}

/// Returns further rows of the table of a sweep as CSV.
///
/// # Errors
/// [`EvaluateError::Write`] if the writer fails.
pub fn rows(jobs: &[BatchJob]) -> Result<Vec<u8>, EvaluateError> {
    sweep::table::rows(jobs)
}

/// Request that the jobs of a batch that are queued later are generated from.
#[derive(Debug)]
pub struct Expandable {
    batch: Uuid,
    request: SweepRequest,
}

impl Expandable {
    /// Reads the request that a batch has stored.
    ///
    /// # Errors
    /// [`ExpandError`] if it cannot be read.
    pub fn read(batch: Uuid, request: &str) -> Result<Self, ExpandError> {
        let request = serde_json::from_str(request)?;
        Ok(Self { batch, request })
    }

    /// Returns the jobs at these positions.
    pub fn portion(
        &self,
        positions: Range<u64>,
        machine: Option<&MachineFigures>,
        accept: &Accept<'_>,
    ) -> Portion {
        let (jobs, refused) = sweep::portion::jobs(&self.request, positions.clone(), accept);
        let jobs = jobs.into_iter();
        Portion {
            batch: self.batch,
            positions,
            jobs: jobs
                .map(|(position, variation)| job(position, variation, machine))
                .collect(),
            refused,
        }
    }
}

/// The jobs of a sweep after the first ones.
fn expansion(
    request: &SweepRequest,
    expanded: &Expanded,
    machine: Option<&MachineFigures>,
) -> Result<Option<NewExpansion>, ExpandError> {
    let Expanded {
        first,
        sample,
        jobs,
    } = expanded;
    let next = u64::try_from(first.len()).unwrap_or(u64::MAX);
    if next >= *jobs {
        return Ok(None);
    }
    Ok(Some(NewExpansion {
        request: serde_json::to_string(request)?,
        next,
        jobs: *jobs,
        cpu_s: ExpectedTime::mean(sample, machine).map(|mean| mean.likely_s),
    }))
}

fn job(position: u64, variation: Variation, machine: Option<&MachineFigures>) -> NewBatchJob {
    let job = NewJob {
        sent: variation.sent,
        plan: variation.estimate.plan(&variation.resolved, machine),
        spec: variation.resolved.spec,
        options: SubmitOptions {
            priority: queue::batch_priority(position),
            deadline_s: None,
        },
    };
    NewBatchJob {
        position,
        job,
        overrides: variation.overrides,
    }
}
