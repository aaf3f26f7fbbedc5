//! Result documents.

mod depth_map;
mod history;
mod life;
mod line;
mod manifest;
mod mission;
mod quantity;
mod resistance;
mod snapshot;
mod summary;

pub use depth_map::{ContactMaps, DepthMap, PressureMap};
pub use history::{Columns, ExposedLayer, Histories, JobHistory, SideSeries, Station, WearHistory};
pub use life::{LifeAtReliability, LifeBand, LifeEntry, LifeStatus, Verdict};
pub use line::{LineProfile, LineProfiles, LineSeries, LineStation, SectionSide};
pub use manifest::{Manifest, ResultFile};
pub use mission::{BlockExtent, BlockSide, BlockSummary};
pub use quantity::{Quantities, Quantity, QuantityDescription, QuantityList};
pub use resistance::{ContactResistance, ResistanceParts};
pub use snapshot::{
    Loop, Pressure, PressurePosition, Profile, SideProfile, SlidePosition, Snapshot,
};
pub use summary::{
    AccuracyReached, Checks, ContactExtent, ContactTemperature, Cost, EffectCalledFor,
    EstimatedError, EstimatedErrors, Initial, SideSummary, Summary,
};
