//! Rows of `jobs` as job documents.

use std::collections::BTreeMap;

use api::job::{Job, Status};
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::packed::unpack;
use crate::store::process_state::ProcessState;
use crate::store::rows::{StoredRow, outcome, parsed, status, summary, time, timestamp, unsigned};

/// Returns the document of a selected row.
pub(in crate::store) fn document(
    process: &ProcessState,
    row: &impl StoredRow,
) -> Result<Job, StoreError> {
    let id = row.id("id")?;
    let (status, reason) = status_and_reason(process, id, row)?;
    let (spec, plan) = match row.value::<Option<Vec<u8>>>("packed")? {
        Some(packed) => unpack(id, &packed)?,
        None => (
            parsed(id, "specification", &row.value::<String>("spec")?)?,
            parsed(id, "plan", &row.value::<String>("plan")?)?,
        ),
    };
    Ok(Job {
        id,
        status,
        status_reason: reason,
        outcome: outcome(row)?,
        priority: unsigned(row, "priority")?,
        deadline_at: deadline(process, row)?,
        created_at: timestamp(row.value("created_at")?),
        started_at: time(row, "started_at")?,
        finished_at: time(row, "finished_at")?,
        progress: parsed(id, "progress", &row.value::<String>("progress")?)?,
        attempts: unsigned(row, "attempts")?,
        spec,
        plan: Some(plan),
        summary: summary(id, row)?,
        links: links(id),
    })
}

/// Returns the status of a selected row and the reason for it: what is stored, unless the job waits for disk space.
pub(in crate::store) fn status_and_reason(
    process: &ProcessState,
    id: Uuid,
    row: &impl StoredRow,
) -> Result<(Status, Option<String>), StoreError> {
    let (status, stored) = (status(id, row)?, row.value("status_reason")?);
    Ok((status, process.disk.status_reason(status).or(stored)))
}

/// Returns the deadline of a selected row by the system's clock, by which it is stored once the job has ended.
pub(in crate::store) fn deadline(
    process: &ProcessState,
    row: &impl StoredRow,
) -> Result<Option<String>, StoreError> {
    let at: Option<i64> = row.value("deadline_at")?;
    let finished: Option<i64> = row.value("finished_at")?;
    let step_ms = finished.map_or_else(|| process.clock.stepped_ms(), |_| 0);
    Ok(at.map(|at| timestamp(at.saturating_add(step_ms))))
}

/// Returns the links of a job.
pub(in crate::store) fn links(id: Uuid) -> BTreeMap<String, String> {
    let own = format!("/v1/jobs/{id}");
    let relations = [
        ("self", ""),
        ("spec", "/spec"),
        ("events", "/events"),
        ("cancel", "/cancel"),
        ("retry", "/retry"),
        ("results", "/results"),
        ("wear_history", "/results/wear-history"),
        ("profile", "/results/profile"),
        ("pressure", "/results/pressure"),
        ("loop", "/results/loop"),
    ];
    let links = relations.map(|(relation, path)| (relation.to_owned(), format!("{own}{path}")));
    links.into()
}
