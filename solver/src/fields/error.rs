//! Errors of fields inside the bodies.

use crate::condensation::OperatorError;
use crate::mesh::MeshError;

/// Why fields could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FieldsError {
    /// A present surface would invert an element.
    #[error("mesh: {0}")]
    Mesh(#[from] MeshError),
    /// A mesh cannot be factored.
    #[error("operators: {0}")]
    Operators(#[from] OperatorError),
}
