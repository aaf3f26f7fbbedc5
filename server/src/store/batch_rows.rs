//! Rows of batches and of their jobs.

use std::collections::BTreeMap;

use api::job::Status;

use crate::store::StoreError;
use crate::store::batches::{BatchJob, BatchOverview};
use crate::store::document::status_and_reason;
use crate::store::local::Local;
use crate::store::rows::{StoredRow, outcome, parsed, summary, timestamp};

/// Returns a batch without its jobs.
pub(in crate::store) fn batch_overview(
    row: &impl StoredRow,
    counts: BTreeMap<String, u64>,
) -> Result<BatchOverview, StoreError> {
    Ok(BatchOverview {
        id: row.id("id")?,
        name: row.optional_text("name")?,
        created_at: timestamp(row.integer("created_at")?),
        counts,
    })
}

/// Returns a job of a batch, without its profile.
pub(in crate::store) fn batch_job(
    local: &Local,
    row: &impl StoredRow,
) -> Result<BatchJob, StoreError> {
    let id = row.id("job_id")?;
    let (status, status_reason) = status_and_reason(local, id, row)?;
    Ok(BatchJob {
        id,
        overrides: parsed(id, "overrides", &row.text("overrides")?)?,
        status,
        status_reason,
        outcome: outcome(row)?,
        summary: summary(id, row)?,
        profile: None,
    })
}

/// Zero for every status.
pub(in crate::store) fn no_jobs() -> BTreeMap<String, u64> {
    let all = Status::ALL.iter();
    all.map(|status| (status.as_str().to_owned(), 0)).collect()
}
