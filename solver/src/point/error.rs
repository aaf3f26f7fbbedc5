//! Errors of a run of a point contact.

use crate::contact::area::{AreaError, TangentialError};

/// Why a run failed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PointError {
    /// The scene has another dimension.
    #[error("the scene is no point contact")]
    Dimension,
    /// A value of the scene is outside of its range.
    #[error("{name} is {value}, must be positive")]
    Value {
        /// Name and unit.
        name: &'static str,
        /// The value.
        value: f64,
    },
    /// A contact of which a part may stick moves too far.
    #[error(
        "amplitude is {amplitude_mm} mm, at most {most_mm:.3e} mm where a part of the contact may stick"
    )]
    Amplitude {
        /// Amplitude, mm.
        amplitude_mm: f64,
        /// The largest one, mm.
        most_mm: f64,
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
    /// Stick and slip have no solution.
    #[error("cycle {cycle}: {error}")]
    Friction {
        /// Cycles done.
        cycle: u64,
        /// Why.
        error: TangentialError,
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

impl PointError {
    /// The error with the cycles done before it.
    pub(super) fn at(self, cycle: u64) -> Self {
        match self {
            Self::Contact { error, .. } => Self::Contact { cycle, error },
            Self::Friction { error, .. } => Self::Friction { cycle, error },
            other => other,
        }
    }
}
