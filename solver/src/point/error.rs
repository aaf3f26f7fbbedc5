//! Errors of a run of a point contact.

use crate::contact::area::{AreaError, TangentialError};

/// Why a run failed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PointError {
    /// The scene has another dimension.
    #[error("the scene is no point contact")]
    Dimension,
    /// The force is outside of its range.
    #[error("normal force in N is {0}, must be positive")]
    ForceRange(f64),
    /// A curvature is outside of its range.
    #[error("curvature along the sliding direction in 1/mm is {0}, must be positive")]
    CurvatureAlongRange(f64),
    /// The other curvature is outside of its range.
    #[error("curvature across the sliding direction in 1/mm is {0}, must be positive")]
    CurvatureAcrossRange(f64),
    /// The contact modulus is outside of its range.
    #[error("contact modulus in MPa is {0}, must be positive")]
    ModulusRange(f64),
    /// The tolerance is outside of its range.
    #[error("tolerance is {0}, must be positive")]
    ToleranceRange(f64),
    /// The number of cells is outside of its range.
    #[error("cells along a half-length is {0}, must be positive")]
    CellsRange(f64),
    /// The step is outside of its range.
    #[error("step over half-length is {0}, must be positive")]
    StepRange(f64),
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
