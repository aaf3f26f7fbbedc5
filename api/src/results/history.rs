//! The wear history as columns. Which columns there are beyond the cycles, the engine's channels decide; this crate
//! does not know them, and the service adds them to the OpenAPI document.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use uuid::Uuid;

use crate::results::LineSeries;

/// Columns by name, in order, one value a computed cycle.
pub type Columns = IndexMap<String, Vec<f64>>;

/// Worn depth at a station.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Station {
    /// The side: `receptacle`.
    pub side: String,
    /// Position along the surface, mm.
    pub x_mm: f64,
    /// Worn depth, mm, one value per row.
    pub depth_mm: Vec<f64>,
}

/// Length on which a layer, or a deeper one, is exposed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ExposedLayer {
    /// The side, `slider` or `receptacle`.
    pub side: String,
    /// The layer, the outermost one being 1; null for the base metal.
    pub layer: Option<u64>,
    /// Exposed length along the surface, mm, one value per row.
    pub length_mm: Vec<f64>,
}

/// One side's wear over the cycles.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SideSeries {
    /// The side's channels.
    #[serde(flatten)]
    #[schema(ignore)]
    pub columns: Columns,
}

/// The wear history as columns of equal length.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WearHistory {
    /// Physical cycles done.
    pub cycle: Vec<u64>,
    /// Physical cycles that the computed cycle represents.
    pub jump: Vec<u64>,
    /// Accumulated imposed sliding distance, mm.
    pub sliding_distance_mm: Vec<f64>,
    /// Worn depth at the stations.
    pub stations: Vec<Station>,
    /// Exposed layers of platings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exposed: Vec<ExposedLayer>,
    /// The sections along a line, in their order; absent of another contact.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub line_stations: Vec<LineSeries>,
    /// The receptacle's wear.
    pub receptacle: SideSeries,
    /// The slider's wear.
    pub slider: SideSeries,
    /// The contact's channels.
    #[serde(flatten)]
    #[schema(ignore)]
    pub contact: Columns,
}

/// Columns of the histories of several jobs.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Histories {
    /// The histories, in the order in which the jobs were named; jobs that do not exist have none.
    pub histories: Vec<JobHistory>,
}

/// Columns of the history of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct JobHistory {
    /// Identifier of the job.
    pub job: Uuid,
    /// The columns by name, of equal length, one value a computed cycle; those that the history does not have are left out.
    #[schema(value_type = std::collections::BTreeMap<String, Vec<f64>>)]
    pub columns: Columns,
}
