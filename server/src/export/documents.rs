//! Result documents of a run: the same for `solve --out` and for a job of the service.

use api::results::{Snapshot, Summary};
use api::spec::Spec;
use solver::record::{CycleReport, Record};

use crate::export::csv;
use crate::export::csv::CsvError;
use crate::export::parquet;
use crate::export::parquet::ParquetError;
use crate::export::pictures;
use crate::export::pictures::{Picture, PlotError};
use crate::spec::scatter::FollowsProduct;

/// Media type of JSON.
pub const JSON: &str = "application/json";
/// Media type of CSV tables.
pub const CSV: &str = "text/csv; charset=utf-8";
/// Media type of Apache Parquet tables.
pub const PARQUET: &str = "application/vnd.apache.parquet";
/// Media type of vector pictures.
pub const SVG: &str = "image/svg+xml";
/// Media type of fields inside the bodies: VTK XML, for which no type is registered.
pub const VTU: &str = "application/xml";

/// A named document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    /// Name.
    pub name: String,
    /// The cycle it belongs to; `None` for the whole run.
    pub cycle: Option<u64>,
    /// Media type.
    pub media_type: &'static str,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Results of a run.
#[derive(Debug, Clone, Copy)]
pub struct Results<'a> {
    /// The resolved specification.
    pub spec: &'a Spec,
    /// The summary, if the run ended with one.
    pub summary: Option<&'a Summary>,
    /// The reports of the computed cycles.
    pub rows: &'a [CycleReport],
    /// The snapshots.
    pub snapshots: &'a [Snapshot],
}

/// Why a document could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum DocumentError {
    /// As JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// As CSV.
    #[error(transparent)]
    Csv(#[from] CsvError),
    /// As Parquet.
    #[error(transparent)]
    Parquet(#[from] ParquetError),
    /// As a picture.
    #[error(transparent)]
    Plot(#[from] PlotError),
}

/// All documents of a run except its fields, which are large and written during the run.
///
/// # Errors
/// [`DocumentError`] if one cannot be rendered.
pub fn all(results: &Results<'_>) -> Result<Vec<Document>, DocumentError> {
    let mut documents = Vec::new();
    let mut add = |name: String, cycle, media_type, bytes| {
        documents.push(Document {
            name,
            cycle,
            media_type,
            bytes,
        });
    };
    let spec = serde_json::to_vec_pretty(results.spec)?;
    add("spec.resolved.json".to_owned(), None, JSON, spec);
    if let Some(summary) = results.summary {
        let summary = serde_json::to_vec_pretty(summary)?;
        add("summary.json".to_owned(), None, JSON, summary);
    }
    let stations = results.spec.output.stations_mm.as_deref();
    let record = Record::new(results.rows, stations.unwrap_or_default());
    let (text, table) = (csv::wear_history(&record)?, parquet::wear_history(&record)?);
    add("wear-history.csv".to_owned(), None, CSV, text);
    add("wear-history.parquet".to_owned(), None, PARQUET, table);
    for snapshot in results.snapshots {
        let cycle = snapshot.profile.cycle;
        let parts = [
            ("profile", csv::profile(&snapshot.profile)?),
            ("pressure", csv::pressure(&snapshot.pressure)?),
            ("loop", csv::friction_loop(&snapshot.friction_loop)?),
        ];
        for (part, bytes) in parts {
            add(format!("{part}-{cycle}.csv"), Some(cycle), CSV, bytes);
        }
    }
    let name = results.spec.name.as_deref().unwrap_or_default();
    let drawn = pictures::run::pictures(name, &record, results.snapshots);
    let life = life(name, results.spec, &record);
    for (picture, drawn) in drawn.into_iter().chain(life) {
        let drawing = pictures::svg(&drawn)?;
        add(format!("{picture}.svg"), None, SVG, drawing.into_bytes());
    }
    Ok(documents)
}

/// The picture of the life, with its file name.
fn life(name: &str, spec: &Spec, record: &Record) -> Option<(&'static str, Picture)> {
    let follows = FollowsProduct::of(&spec.interface);
    let is_continuous = spec.cycles.is_none();
    let drawn = pictures::life::picture(name, &spec.life, is_continuous, follows, record)?;
    Some(("life", drawn))
}
