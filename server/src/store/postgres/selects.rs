//! Queries of job documents, long and short.

use sqlx::{Postgres, QueryBuilder};

/// Cycles after which the first criterion of life was reached.
pub(super) const LIFE_CYCLES: &str = "(SELECT min((criterion ->> 'cycles')::float8) FROM json_array_elements(summary::json -> 'life') AS criterion \
     WHERE criterion ->> 'status' = 'reached')";

/// Columns of job documents.
pub(super) const DOCUMENT: &str = "id, spec, plan, status, status_reason, outcome, created_at, started_at, finished_at, \
     priority, deadline_at, progress, summary, attempts, last_event, version, \
     (SELECT documents FROM result_blocks WHERE job_id = jobs.id) AS packed";

/// Starts a query of job documents.
pub(super) fn select() -> QueryBuilder<Postgres> {
    QueryBuilder::new(format!("SELECT {DOCUMENT} FROM jobs"))
}

/// Starts a query of short documents.
pub(super) fn select_overview() -> QueryBuilder<Postgres> {
    QueryBuilder::new(format!("SELECT {} FROM jobs", overview()))
}

/// Columns of short documents. `->` gives the JSON text of a value, whose digits are those that were stored.
pub(super) fn overview() -> String {
    format!(
        "id, system, (spec::json -> 'name')::text AS name, (spec::json -> 'labels')::text AS labels, status, status_reason, \
         outcome, created_at, started_at, finished_at, priority, deadline_at, progress, attempts, \
         (summary::json #> '{{receptacle,max_depth_mm}}')::text AS receptacle, (summary::json #> '{{slider,max_depth_mm}}')::text AS slider, \
         (summary::json -> 'peak_pressure_mpa')::text AS pressure, \
         (summary::json #> '{{accuracy,estimated_relative_error}}')::text AS error, {LIFE_CYCLES} AS life, revision"
    )
}
