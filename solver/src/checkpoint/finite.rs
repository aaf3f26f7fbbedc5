//! Checkpoints of the run of a contact of finite width: what is computed from its state, operators among it,
//! is computed again.

use serde::{Deserialize, Serialize};

use super::earlier::EarlierRuns;
use crate::effects::Crossing;
use crate::electrical::ElectricalState;
use crate::extruded::ExtrudedState;
use crate::point::PointState;
use crate::record::{Compared, Initial, Life};
use crate::station::LineState;

/// A run of a contact of finite width between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FiniteRun<S> {
    pub(crate) state: S,
    pub(crate) initial: Initial,
    /// Skipped effects that the run has required.
    pub(crate) crossings: Vec<Crossing>,
    /// Histories that the run's error is estimated by.
    pub(crate) compared: Compared,
    /// Life by the criteria of the scene.
    pub(crate) life: Life,
    /// Resistance of the contact, and what the next one depends on.
    pub(crate) electrical: ElectricalState,
    /// Earlier runs of this scene, for error control.
    pub(crate) earlier: EarlierRuns,
}

/// A run of a point contact.
pub type PointRun = FiniteRun<PointState>;

/// A run of a contact along a line.
pub type LineRun = FiniteRun<LineState>;

/// A run of extruded bodies.
pub type ExtrudedRun = FiniteRun<ExtrudedState>;
