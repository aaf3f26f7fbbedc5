//! Doubts about the result of a run.

use serde::{Deserialize, Serialize};

use crate::effects::Decision;
use crate::record::Excess;

/// A doubt about the result of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Warning {
    /// An estimated error is outside of the tolerance.
    Excess(Excess),
    /// A coarse companion has no solution, so that no errors are estimated.
    NoCompanion,
    /// A finer run has no solution, so that the result is that of the first one.
    NoFinerRun,
    /// An effect is beyond its limit and not simulated.
    Missed(Decision),
}
