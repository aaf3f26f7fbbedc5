//! Batches: many jobs of one question.
//!
//! A batch is expanded (a request into the specifications of its jobs), run (as ordinary jobs of the queue) and
//! evaluated (the stored jobs into a document and a table). Parameter sweeps and accuracy studies are its two kinds.
//! Does not know HTTP, SQL or the terminal.

pub mod accuracy;
mod error;
mod kind;
mod sweep;
mod variation;

use api::plan::MachineFigures;
use api::study::{StudyDocument, StudyRequest};
use api::sweep::{Changes, Sweep, SweepRequest};
use serde::Serialize;

use crate::queue;
use crate::spec::Refused;
use crate::store::{BatchDetail, NewBatch, NewJob, StoredBatch, SubmitOptions};

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
    Sweep(Sweep),
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

    /// Returns a batch as a document.
    ///
    /// # Errors
    /// [`EvaluateError`] if something stored cannot be read.
    pub fn document(self, batch: StoredBatch) -> Result<Document, EvaluateError> {
        match self {
            Self::Sweep => Ok(Document::Sweep(sweep::document(batch))),
            Self::AccuracyStudy => {
                let study = accuracy::outcomes::document(batch)?;
                Ok(Document::AccuracyStudy(Box::new(study)))
            }
        }
    }

    /// Returns the results of a batch as CSV, one line per job.
    ///
    /// # Errors
    /// [`EvaluateError`] if something stored cannot be read, or there is nothing to compare yet.
    pub fn table(self, batch: &StoredBatch) -> Result<Vec<u8>, EvaluateError> {
        match self {
            Self::Sweep => sweep::table::csv(&batch.jobs),
            Self::AccuracyStudy => accuracy::outcomes::table(batch),
        }
    }
}

impl Request {
    /// Returns the jobs to be queued: all of them, accepted, or none.
    ///
    /// # Errors
    /// [`ExpandError`] with the faults of the request, or of the jobs it would make.
    pub fn expand(
        &self,
        machine: Option<&MachineFigures>,
        accept: &Accept<'_>,
    ) -> Result<NewBatch, ExpandError> {
        let (name, variations, plan) = match self {
            Self::Sweep(request) => (&request.name, sweep::expand(request, accept)?, None),
            Self::AccuracyStudy(request) => {
                let machine = machine.ok_or(ExpandError::Unmeasured)?;
                let (variations, plan) = accuracy::request::expand(request, machine, accept)?;
                (&request.name, variations, Some(plan))
            }
        };
        let jobs = variations.into_iter().enumerate();
        Ok(NewBatch {
            name: name.clone(),
            jobs: jobs
                .map(|(position, variation)| job(position, variation, machine))
                .collect(),
            plan,
        })
    }
}

fn job(
    position: usize,
    variation: Variation,
    machine: Option<&MachineFigures>,
) -> (NewJob, Changes) {
    let job = NewJob {
        plan: variation.estimate.plan(&variation.resolved, machine),
        spec: variation.resolved.spec,
        options: SubmitOptions {
            priority: queue::batch_priority(position),
            deadline_s: None,
        },
    };
    (job, variation.overrides)
}
