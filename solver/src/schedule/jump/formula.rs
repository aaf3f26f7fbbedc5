//! Formulas of jumps.

use serde::{Deserialize, Serialize};

/// Formula of a jump.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Formula {
    /// A computed cycle that wears the whole jump.
    #[default]
    ComputedCycle,
    /// Euler's, implicit in the shapes.
    ImplicitEuler,
    /// Backward differentiation over two jumps, implicit in the shapes.
    TwoSteps,
}
