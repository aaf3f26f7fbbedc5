//! What can end a run of a point contact without a result.

use crate::contact::area::AreaError;

/// Why a run failed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PointError {
    /// A value of the scene is outside of its range.
    #[error("{name} is {value}, must be positive")]
    Value {
        /// Its name and unit.
        name: &'static str,
        /// It.
        value: f64,
    },
    /// Wear that depends on more than the dose.
    #[error("the wear law of the {side} depends on more than the dose of a place")]
    Law {
        /// The body.
        side: &'static str,
    },
    /// A contact has no solution.
    #[error("cycle {cycle}: {error}")]
    Contact {
        /// Cycles done.
        cycle: u64,
        /// Why.
        error: AreaError,
    },
    /// The contact has outgrown the largest window.
    #[error("the contact needs a window of {cells} cells, at most {most} are solved for")]
    Window {
        /// Cells that it needs.
        cells: usize,
        /// Most cells.
        most: usize,
    },
}
