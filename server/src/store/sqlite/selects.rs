//! Queries of job documents, long and short.

use sqlx::{QueryBuilder, Sqlite};

/// Cycles after which the first criterion of life was reached.
pub(super) const LIFE_CYCLES: &str = "(SELECT min(value ->> '$.cycles') FROM json_each(summary, '$.life') WHERE value ->> '$.status' = 'reached')";

/// Columns of job documents.
pub(super) const DOCUMENT: &str = "id, spec, plan, status, status_reason, outcome, created_at, started_at, finished_at, \
     priority, deadline_at, progress, summary, attempts, last_event, version, \
     (SELECT documents FROM result_blocks WHERE job_id = jobs.id) AS packed";

/// Starts a query of job documents.
pub(super) fn select() -> QueryBuilder<Sqlite> {
    QueryBuilder::new(format!("SELECT {DOCUMENT} FROM jobs"))
}

/// Starts a query of short documents.
pub(super) fn select_overview() -> QueryBuilder<Sqlite> {
    QueryBuilder::new(format!("SELECT {} FROM jobs", overview()))
}

/// Columns of short documents. `->` gives the JSON text of a value, whose digits are those that were stored.
pub(super) fn overview() -> String {
    format!(
        "id, system, spec -> '$.name' AS name, spec -> '$.labels' AS labels, status, status_reason, outcome, \
         created_at, started_at, finished_at, priority, deadline_at, progress, attempts, \
         summary -> '$.receptacle.max_depth_mm' AS receptacle, summary -> '$.slider.max_depth_mm' AS slider, \
         summary -> '$.peak_pressure_mpa' AS pressure, \
         summary -> '$.accuracy.estimated_relative_error' AS error, {LIFE_CYCLES} AS life, revision"
    )
}
