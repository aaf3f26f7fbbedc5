//! Rows of `jobs` as short documents: only what they contain is read and parsed.

use api::job::{JobOverview, KeyFigures};
use sqlx::sqlite::SqliteRow;
use sqlx::{QueryBuilder, Row, Sqlite};
use uuid::Uuid;

use crate::store::sqlite::document::{deadline, links, status_and_reason, time, timestamp};
use crate::store::sqlite::queries::{self, outcome, parsed};
use crate::store::{DataDisk, StoreError};

/// Cycles after which the first criterion of life was reached.
pub(super) const LIFE_CYCLES: &str = "(SELECT min(value ->> '$.cycles') FROM json_each(summary, '$.life') WHERE value ->> '$.status' = 'reached')";

/// Starts a query of short documents. `->` gives the JSON text of a value, whose digits are those that were stored.
pub(super) fn select_overview() -> QueryBuilder<Sqlite> {
    QueryBuilder::new(format!(
        "SELECT id, system, spec -> '$.name' AS name, spec -> '$.labels' AS labels, status, status_reason, outcome, \
         created_at, started_at, finished_at, priority, deadline_at, progress, attempts, \
         summary -> '$.receptacle.max_depth_mm' AS receptacle, summary -> '$.slider.max_depth_mm' AS slider, \
         summary -> '$.peak_pressure_mpa' AS pressure, \
         summary -> '$.accuracy.estimated_relative_error' AS error, {LIFE_CYCLES} AS life, revision FROM jobs"
    ))
}

/// Returns the short document of a selected row.
pub(super) fn overview(disk: &DataDisk, row: &SqliteRow) -> Result<JobOverview, StoreError> {
    let id = queries::id(row, "id")?;
    let (status, status_reason) = status_and_reason(disk, id, row)?;
    let name: Option<&str> = row.try_get("name")?;
    let labels: Option<&str> = row.try_get("labels")?;
    Ok(JobOverview {
        id,
        name: name.map_or(Ok(None), |name| parsed(id, "name", name))?,
        system: row.try_get("system")?,
        labels: labels.map_or_else(
            || Ok(std::collections::BTreeMap::new()),
            |labels| parsed(id, "labels", labels),
        )?,
        status,
        status_reason,
        outcome: outcome(row)?,
        priority: row.try_get("priority")?,
        deadline_at: deadline(row)?,
        created_at: timestamp(row.try_get("created_at")?),
        started_at: time(row, "started_at")?,
        finished_at: time(row, "finished_at")?,
        progress: parsed(id, "progress", row.try_get("progress")?)?,
        attempts: row.try_get("attempts")?,
        key_figures: key_figures(id, row)?,
        links: links(id),
    })
}

fn key_figures(id: Uuid, row: &SqliteRow) -> Result<Option<KeyFigures>, StoreError> {
    let figure = |column: &str| -> Result<Option<f64>, StoreError> {
        let text: Option<&str> = row.try_get(column)?;
        text.map(|text| parsed(id, "summary", text)).transpose()
    };
    let (Some(receptacle), Some(slider), Some(pressure), Some(error)) = (
        figure("receptacle")?,
        figure("slider")?,
        figure("pressure")?,
        figure("error")?,
    ) else {
        return Ok(None);
    };
    Ok(Some(KeyFigures {
        receptacle_max_depth_mm: receptacle,
        slider_max_depth_mm: slider,
        peak_pressure_mpa: pressure,
        estimated_relative_error: error,
        life_cycles: row.try_get("life")?,
    }))
}
