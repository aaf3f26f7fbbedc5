//! Results as files in a folder.

use std::path::{Path, PathBuf};

use api::results::{CycleRow, Snapshot, Summary};
use api::spec::Spec;

use crate::solve::FieldsFile;
use crate::translate::csv::{self, CsvError};
use crate::translate::history;

/// What a run left.
#[derive(Debug, Clone, Copy)]
pub struct Results<'a> {
    /// The resolved specification.
    pub spec: &'a Spec,
    /// The result in short, if the run had one.
    pub summary: Option<&'a Summary>,
    /// The wear history.
    pub rows: &'a [CycleRow],
    /// The snapshots.
    pub snapshots: &'a [Snapshot],
    /// Fields inside the bodies, as files.
    pub fields: &'a [FieldsFile],
}

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
pub enum FilesError {
    /// The system refused.
    #[error("{}: {cause}", .path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// A document could not be made.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// A table could not be made.
    #[error(transparent)]
    Csv(#[from] CsvError),
}

/// Writes all results into a folder, which is made if it is missing.
///
/// # Errors
/// [`FilesError`] naming the file.
pub fn write(folder: &Path, results: &Results<'_>) -> Result<(), FilesError> {
    std::fs::create_dir_all(folder).map_err(|cause| FilesError::Write {
        path: folder.to_owned(),
        cause,
    })?;
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|cause| FilesError::Write { path, cause })
    };
    file(
        "spec.resolved.json",
        &serde_json::to_vec_pretty(results.spec)?,
    )?;
    if let Some(summary) = results.summary {
        file("summary.json", &serde_json::to_vec_pretty(summary)?)?;
    }
    let stations = results
        .spec
        .output
        .stations_mm
        .as_deref()
        .unwrap_or_default();
    file(
        "wear-history.csv",
        &csv::wear_history(&history::columns(results.rows, stations))?,
    )?;
    for Snapshot {
        profile,
        pressure,
        friction_loop,
    } in results.snapshots
    {
        let cycle = profile.cycle;
        file(&format!("profile-{cycle}.csv"), &csv::profile(profile)?)?;
        file(&format!("pressure-{cycle}.csv"), &csv::pressure(pressure)?)?;
        file(
            &format!("loop-{cycle}.csv"),
            &csv::friction_loop(friction_loop)?,
        )?;
    }
    for fields in results.fields {
        file(&fields.name, &fields.bytes)?;
    }
    Ok(())
}
