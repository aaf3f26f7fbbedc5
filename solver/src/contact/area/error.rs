//! Errors of a normal contact.

/// Why a contact has no solution.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum AreaError {
    /// The iteration did not converge.
    #[error(
        "no contact pressure after {iterations} iterations: residual {residual:.2e}, tolerance {tolerance:.2e}"
    )]
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Residual of the last one.
        residual: f64,
        /// Largest residual.
        tolerance: f64,
    },
    /// The contact is larger than the grid.
    #[error("the contact reaches the edge of its window of {along_x} x {along_z} cells")]
    ReachesEdge {
        /// Cells along x.
        along_x: usize,
        /// Cells along z.
        along_z: usize,
    },
    /// The force does not press the bodies together.
    #[error("normal force is {force_n} N, must be positive")]
    Force {
        /// Normal force, N.
        force_n: f64,
    },
}
