//! Queries of job documents, long and short.

use sqlx::QueryBuilder;

use super::dialect::{Engine, LIFE_CYCLES, json};

/// Columns of job documents.
pub(super) const DOCUMENT: &str = "id, spec, plan, status, status_reason, outcome, created_at, started_at, finished_at, \
     priority, deadline_at, progress, summary, attempts, last_event, version, \
     (SELECT documents FROM result_blocks WHERE job_id = jobs.id) AS packed";

/// Starts a query of job documents.
pub(super) fn select() -> QueryBuilder<Engine> {
    QueryBuilder::new(format!("SELECT {DOCUMENT} FROM jobs"))
}

/// Starts a query of short documents.
pub(in super::super) fn select_overview() -> QueryBuilder<Engine> {
    QueryBuilder::new(format!("SELECT {} FROM jobs", overview()))
}

/// Columns of short documents. Values of documents are JSON texts, whose digits are those that were stored.
pub(super) fn overview() -> String {
    format!(
        "id, system, {} AS name, {} AS labels, status, status_reason, outcome, \
         created_at, started_at, finished_at, priority, deadline_at, progress, attempts, \
         {} AS receptacle, {} AS slider, {} AS pressure, {} AS error, {LIFE_CYCLES} AS life, revision",
        json("spec", "name"),
        json("spec", "labels"),
        json("summary", "receptacle.max_depth_mm"),
        json("summary", "slider.max_depth_mm"),
        json("summary", "peak_pressure_mpa"),
        json("summary", "accuracy.estimated_relative_error"),
    )
}
