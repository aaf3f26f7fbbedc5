//! Rows of batches and of their jobs.

use std::collections::BTreeMap;

use api::job::Status;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::batches::{BatchJob, BatchOverview, Expansion, RefusedJob};
use crate::store::document::status_and_reason;
use crate::store::process_state::ProcessState;
use crate::store::rows::{StoredRow, outcome, parsed, summary, timestamp};

/// Returns a batch without its jobs.
pub(in crate::store) fn batch_overview(
    row: &impl StoredRow,
    counts: BTreeMap<String, u64>,
) -> Result<BatchOverview, StoreError> {
    let number = |value: i64| u64::try_from(value).unwrap_or_default();
    Ok(BatchOverview {
        id: row.id("id")?,
        name: row.optional_text("name")?,
        created_at: timestamp(row.integer("created_at")?),
        counts,
        asked: row.optional_integer("asked")?.map(number),
        to_come: number(row.integer("to_come")?),
        never_queued: number(row.integer("never_queued")?),
        refused: number(row.integer("refused")?),
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
        position: row.integer("position")?.try_into().unwrap_or_default(),
        overrides: parsed(id, "overrides", &row.text("overrides")?)?,
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
) -> Result<RefusedJob, StoreError> {
    Ok(RefusedJob {
        position: row.integer("position")?.try_into().unwrap_or_default(),
        overrides: parsed(batch, "overrides", &row.text("overrides")?)?,
        reason: row.text("reason")?,
    })
}

/// Returns a batch with jobs that are to be queued.
pub(in crate::store) fn expansion(row: &impl StoredRow) -> Result<Expansion, StoreError> {
    let number = |column| {
        let value = row.integer(column)?;
        Ok::<_, StoreError>(value.try_into().unwrap_or_default())
    };
    Ok(Expansion {
        batch: row.id("sweep_id")?,
        next: number("next")?,
        jobs: number("jobs")?,
        waiting: number("waiting")?,
    })
}

/// Zero for every status.
pub(in crate::store) fn no_jobs() -> BTreeMap<String, u64> {
    let all = Status::ALL.iter();
    all.map(|status| (status.as_str().to_owned(), 0)).collect()
}
