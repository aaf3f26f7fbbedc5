//! Why operators cannot be built.

use crate::linear::FactorError;

/// Why operators cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum OperatorError {
    /// An element is inverted.
    #[error("element {element} of the {body} is inverted")]
    Inverted {
        /// Which body.
        body: &'static str,
        /// Number, columns first.
        element: usize,
    },
    /// The stiffness matrix cannot be factored.
    #[error("{body}: {source}")]
    Factor {
        /// Which body.
        body: &'static str,
        /// Why.
        source: FactorError,
    },
}
