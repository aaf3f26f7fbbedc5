//! Rows of `jobs` as job documents.

use std::collections::BTreeMap;

use api::job::{Job, Status};
use jiff::Timestamp;
use sqlx::sqlite::SqliteRow;
use sqlx::{QueryBuilder, Row, Sqlite};
use uuid::Uuid;

use crate::clock::Now;
use crate::store::sqlite::packed::unpack;
use crate::store::sqlite::queries::{self, outcome, parsed, status, summary};
use crate::store::{DataDisk, StoreError};

/// Starts a query of job documents.
pub(super) fn select() -> QueryBuilder<Sqlite> {
    QueryBuilder::new(
        "SELECT id, spec, plan, status, status_reason, outcome, created_at, started_at, finished_at, \
         priority, deadline_at, progress, summary, attempts, last_event, version, \
         (SELECT documents FROM result_blocks WHERE job_id = jobs.id) AS packed FROM jobs",
    )
}

/// Returns the document of a selected row.
pub(super) fn document(disk: &DataDisk, row: &SqliteRow) -> Result<Job, StoreError> {
    let id = queries::id(row, "id")?;
    let time = |column| time(row, column);
    let (status, reason) = status_and_reason(disk, id, row)?;
    let packed: Option<&[u8]> = row.try_get("packed")?;
    let (spec, plan) = match packed {
        Some(packed) => unpack(id, packed)?,
        None => (
            parsed(id, "specification", row.try_get("spec")?)?,
            parsed(id, "plan", row.try_get("plan")?)?,
        ),
    };
    Ok(Job {
        id,
        status,
        status_reason: reason,
        outcome: outcome(row)?,
        priority: row.try_get("priority")?,
        deadline_at: deadline(row)?,
        created_at: timestamp(row.try_get("created_at")?),
        started_at: time("started_at")?,
        finished_at: time("finished_at")?,
        progress: parsed(id, "progress", row.try_get("progress")?)?,
        attempts: row.try_get("attempts")?,
        spec,
        plan: Some(plan),
        summary: summary(id, row)?,
        links: links(id),
    })
}

/// Returns the status of a selected row and the reason for it: what is stored, unless the job waits for disk space.
pub(super) fn status_and_reason(
    disk: &DataDisk,
    id: Uuid,
    row: &SqliteRow,
) -> Result<(Status, Option<String>), StoreError> {
    let (status, stored) = (status(id, row)?, row.try_get("status_reason")?);
    Ok((status, disk.status_reason(status).or(stored)))
}

/// Returns a time of a selected row.
pub(super) fn time(row: &SqliteRow, column: &str) -> Result<Option<String>, sqlx::Error> {
    Ok(row.try_get::<Option<i64>, _>(column)?.map(timestamp))
}

/// Returns the deadline of a selected row by the system's clock, by which it is stored once the job has ended.
pub(super) fn deadline(row: &SqliteRow) -> Result<Option<String>, sqlx::Error> {
    let (at, finished): (Option<i64>, Option<i64>) =
        (row.try_get("deadline_at")?, row.try_get("finished_at")?);
    let step_ms = finished.map_or_else(|| Now::read().stepped_ms(), |_| 0);
    Ok(at.map(|at| timestamp(at.saturating_add(step_ms))))
}

/// Returns the links of a job.
pub(super) fn links(id: Uuid) -> BTreeMap<String, String> {
    let own = format!("/v1/jobs/{id}");
    let relations = [
        ("self", ""),
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

/// Formats milliseconds since 1970 as RFC 3339.
pub(super) fn timestamp(milliseconds: i64) -> String {
    Timestamp::from_millisecond(milliseconds)
        .map_or_else(|_| milliseconds.to_string(), |time| time.to_string())
}
