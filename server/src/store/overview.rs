//! Rows of `jobs` as short documents: only what they contain is read and parsed.

use api::job::{JobOverview, KeyFigures};
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::document::{deadline, links, status_and_reason};
use crate::store::process_state::ProcessState;
use crate::store::rows::{StoredRow, outcome, parsed, time, timestamp, unsigned};

/// Returns the short document of a selected row.
pub(in crate::store) fn overview(
    process: &ProcessState,
    row: &impl StoredRow,
) -> Result<JobOverview, StoreError> {
    let id = row.id("id")?;
    let (status, status_reason) = status_and_reason(process, id, row)?;
    let name: Option<String> = row.value("name")?;
    let labels: Option<String> = row.value("labels")?;
    Ok(JobOverview {
        id,
        name: name.map_or(Ok(None), |name| parsed(id, "name", &name))?,
        system: row.value("system")?,
        labels: labels.map_or_else(
            || Ok(std::collections::BTreeMap::new()),
            |labels| parsed(id, "labels", &labels),
        )?,
        status,
        status_reason,
        outcome: outcome(row)?,
        priority: unsigned(row, "priority")?,
        deadline_at: deadline(process, row)?,
        created_at: timestamp(row.value("created_at")?),
        started_at: time(row, "started_at")?,
        finished_at: time(row, "finished_at")?,
        progress: parsed(id, "progress", &row.value::<String>("progress")?)?,
        attempts: unsigned(row, "attempts")?,
        key_figures: key_figures(id, row)?,
        links: links(id),
    })
}

fn key_figures(id: Uuid, row: &impl StoredRow) -> Result<Option<KeyFigures>, StoreError> {
    let figure = |column: &str| -> Result<Option<f64>, StoreError> {
        let text: Option<String> = row.value(column)?;
        text.map(|text| parsed(id, "summary", &text)).transpose()
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
        life_cycles: row.value("life")?,
    }))
}
