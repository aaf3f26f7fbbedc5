//! Errors of a solve: one variant a stage.

use crate::checkpoint::CheckpointMismatch;
use crate::condensation::OperatorError;
use crate::cycle::CycleError;
use crate::extruded::ExtrudedError;
use crate::fields::FieldsError;
use crate::mesh::MeshError;
use crate::point::PointError;
use crate::station::StationError;

/// Why a solve failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The mesh cannot be built or moved.
    #[error("mesh: {0}")]
    Mesh(#[from] MeshError),
    /// The condensed operators cannot be built.
    #[error("operators: {0}")]
    Operators(#[from] OperatorError),
    /// A cycle could not be integrated.
    #[error("cycle: {0}")]
    Cycle(#[from] CycleError),
    /// A point contact could not be integrated.
    #[error("point contact: {0}")]
    Point(#[from] PointError),
    /// A contact along a line could not be integrated.
    #[error("line: {0}")]
    Line(#[from] StationError),
    /// Extruded bodies could not be integrated.
    #[error("extruded: {0}")]
    Extruded(#[from] ExtrudedError),
    /// A checkpoint is not one of this scene.
    #[error("checkpoint: {0}")]
    Checkpoint(#[from] CheckpointMismatch),
}

impl SolveError {
    /// Returns `true` if wider zones of fine elements would help.
    pub(crate) fn needs_wider_zones(&self) -> bool {
        matches!(self, Self::Cycle(error) if error.needs_wider_zones())
    }

    /// Returns `true` if the contact may have a solution with effects that were skipped.
    pub(crate) fn may_need_effects(&self) -> bool {
        matches!(self, Self::Cycle(CycleError::Increment { .. }))
    }
}

impl From<FieldsError> for SolveError {
    fn from(error: FieldsError) -> Self {
        match error {
            FieldsError::Mesh(error) => Self::Mesh(error),
            FieldsError::Operators(error) => Self::Operators(error),
        }
    }
}
