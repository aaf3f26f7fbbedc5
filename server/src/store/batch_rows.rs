//! Rows of batches and of their jobs.

use std::collections::BTreeMap;

use api::job::Status;
use api::sweep::RefusedChanges;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::batches::{BatchJob, BatchOverview, Expansion};
use crate::store::document::status_and_reason;
use crate::store::process_state::ProcessState;
use crate::store::rows::{StoredRow, outcome, parsed, summary, timestamp, unsigned};

/// Returns a batch without its jobs.
pub(in crate::store) fn batch_overview(
    row: &impl StoredRow,
    counts: BTreeMap<String, u64>,
) -> Result<BatchOverview, StoreError> {
    let asked: Option<i64> = row.value("asked")?;
    Ok(BatchOverview {
        id: row.id("id")?,
        name: row.value("name")?,
        created_at: timestamp(row.value("created_at")?),
        counts,
        asked: asked.map(|asked| asked.try_into().unwrap_or_default()),
        to_come: unsigned(row, "to_come")?,
        never_queued: unsigned(row, "never_queued")?,
        refused: unsigned(row, "refused")?,
    })
}

/// Returns a job of a batch, without its profile.
pub(in crate::store) fn batch_job(
    process: &ProcessState,
    row: &impl StoredRow,
) -> Result<BatchJob, StoreError> {
    let id = row.id("job_id")?;
    let (status, status_reason) = status_and_reason(process, id, row)?;
    Ok(BatchJob {
        id,
        position: unsigned(row, "position")?,
        overrides: parsed(id, "overrides", &row.value::<String>("overrides")?)?,
        status,
        status_reason,
        outcome: outcome(row)?,
        summary: summary(id, row)?,
        profile: None,
    })
}

/// Returns a combination of changes of a batch that makes no valid job.
pub(in crate::store) fn refused_job(
    batch: Uuid,
    row: &impl StoredRow,
) -> Result<RefusedChanges, StoreError> {
    Ok(RefusedChanges {
        position: unsigned(row, "position")?,
        overrides: parsed(batch, "overrides", &row.value::<String>("overrides")?)?,
        reason: row.value("reason")?,
    })
}

/// Returns a batch with jobs that are to be queued.
pub(in crate::store) fn expansion(row: &impl StoredRow) -> Result<Expansion, StoreError> {
    Ok(Expansion {
        batch: row.id("sweep_id")?,
        next: unsigned(row, "next")?,
        jobs: unsigned(row, "jobs")?,
        waiting: unsigned(row, "waiting")?,
    })
}

/// Zero for every status.
pub(in crate::store) fn no_jobs() -> BTreeMap<String, u64> {
    let all = Status::ALL.iter();
    all.map(|status| (status.as_str().to_owned(), 0)).collect()
}
