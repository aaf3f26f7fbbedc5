//! Results of a run, append only: the report of every computed cycle, snapshots, the summary.
//!
//! A report consists of named scalars, its [`Channel`]s; the reports of a run give the columns of its wear history, a
//! [`Record`]. Documents, tables, pictures and the description of the interface iterate over the channels, so a new
//! scalar is one line of the tables in `record/report.rs` and nothing else.

mod channel;
mod compared;
mod errors;
mod exposure;
mod history;
mod life;
mod report;
mod scar;
mod snapshot;
mod summary;
mod warning;
mod worn_area;

pub use crate::cycle::{Checks, FrictionLoop};
pub use crate::fields::{LineFields, PlacedFields};
pub use crate::schedule::increments::Position;
pub use crate::schedule::mission_state::BlockWear;
pub use crate::schedule::stops::Outcome;
pub use crate::sides::Side;
pub use channel::{Channel, Channels};
pub use compared::{Compared, Quantity};
pub use errors::{ErrorParts, Errors, Excess};
pub(crate) use exposure::{Exposed, WornSurface};
pub use history::{Column, Layer, LineColumns, Record};
pub use life::{CriterionState, Life};
pub(crate) use life::{CycleRange, unreached};
pub use report::{
    CycleReport, ExtentReport, ResistanceReport, SideReport, TemperatureReport, report,
};
pub(crate) use report::{LineEnd, PointEnd, line_report, point_report, worn_surface};
pub(crate) use snapshot::tractions;
pub use snapshot::{
    AreaMaps, DepthProfile, PressureMap, Snapshot, StationSnapshot, TractionField, snapshot,
};
pub(crate) use summary::worn_area_residual;
pub use summary::{Initial, Resolution, Summary};
pub use warning::Warning;
pub(crate) use worn_area::WornArea;
